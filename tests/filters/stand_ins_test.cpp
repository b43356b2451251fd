// SPDX-License-Identifier: GPL-3.0-or-later
#include "stand_ins.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/io.h"

namespace garmentfit {
namespace {

/// A sample T-shirt as programs for patterns write it: panels that are closed slabs, 1 mm thick, with gaps between
/// them.
GarmentMesh tshirt_of_panels()
{
    constexpr double panel = 0.25, thickness = 1e-3, share = 0.96;
    const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/tshirt.ply");
    const Positions inwards = -thickness * vertex_normals(file.positions(), file.triangles());
    const Vec3 middle = file.positions().colwise().mean();
    std::map<std::array<int, 3>, std::vector<int>> faces;
    for (int f = 0; f < int(file.triangles().rows()); ++f) {
        const Vec3 place = file.positions()(file.triangles().row(f), Eigen::all).colwise().mean();
        const Vec3 cell = ((place - middle) / panel).array().floor();
        faces[{ int(cell.x()), int(cell.y()), place.z() > middle.z() }].push_back(f);
    }
    TriangleMesh all { Positions(0, 3), Triangles(0, 3) };
    for (const auto& [cell, rows] : faces) {
        std::map<int, int> row_of;
        std::vector<int> used;
        const Triangles triangles = file.triangles()(rows, Eigen::all).unaryExpr([&](int v) {
            const auto [found, is_new] = row_of.try_emplace(v, int(used.size()));
            if (is_new)
                used.push_back(v);
            return found->second;
        });
        TriangleMesh sheet { file.positions()(used, Eigen::all), triangles };
        const Eigen::RowVector3d centre = sheet.positions.colwise().mean();
        sheet.positions = (share * (sheet.positions.rowwise() - centre)).rowwise() + centre;
        all = fixtures::joined(all, fixtures::thickened(sheet, inwards(used, Eigen::all)));
    }
    return make_garment(all.positions, all.triangles);
}

Scene scene_of_panels()
{
    const MeshFile body = MeshFile::read(GARMENTFIT_SAMPLES "/walking_woman.ply");
    Scene scene;
    scene.body = make_body(body.positions(), body.triangles());
    scene.garments = { { tshirt_of_panels(), GarmentType::automatic, "panels.ply" } };
    return scene;
}

void expect_worn(const Dressing& dressing, const GarmentMesh& given)
{
    ASSERT_TRUE(dressing.certified) << explain(dressing, { "panels.ply" });
    const WornGarment& worn = dressing.garments[0];
    ASSERT_EQ(worn.positions.rows(), given.positions.rows());
    EXPECT_EQ(worn.rest.triangles, given.triangles);
    EXPECT_GT(worn.pieces.count, 8);
    EXPECT_EQ(worn.pieces.free, 0);
    EXPECT_LT(worn.piece_shift, 0.02);
    EXPECT_LT(worn.certificate.strain.median, 0.1);
    EXPECT_EQ(dressing.maps[0].ease.rows(), given.positions.rows());
}

TEST(StandIns, DressABodyInPanelsThatAreClosedSlabs)
{
    Scene scene = scene_of_panels();
    Parameters parameters;
    parameters.recover.quality = Quality::draft;
    parameters.recover.frames = 3;
    filter_of("dress").run(scene, parameters);
    ASSERT_TRUE(scene.recovered) << explain(*scene.draped, { "panels.ply" });
    expect_worn(*scene.recovered, scene.garments[0].mesh);
    for (const RecoverFrame& frame : scene.recovered->frames)
        EXPECT_EQ(frame.garments[0].rows(), scene.garments[0].mesh.positions.rows());

    // where only the positions of the draped garment were kept, in files, say
    Dressing& draped = *scene.draped;
    ASSERT_TRUE(draped.garments[0].stand_in);
    draped.garments[0].stand_in.reset();
    scene.recovered.reset();
    filter_of("recover").run(scene, parameters);
    expect_worn(*scene.recovered, scene.garments[0].mesh);
}

/// A sample shirt of 8,219 vertices, and a body.
Scene scene_of_shirt()
{
    const MeshFile body = MeshFile::read(GARMENTFIT_SAMPLES "/walking_woman.ply"),
                   shirt = MeshFile::read(GARMENTFIT_SAMPLES "/shirt.ply");
    Scene scene;
    scene.body = make_body(body.positions(), body.triangles());
    scene.garments = { { make_garment(shirt.positions(), shirt.triangles()), GarmentType::automatic, "shirt.ply" } };
    return scene;
}

TEST(StandIns, ThatAreRoughLeadNearARestOfTheGarmentsOwn)
{
    Scene scene = scene_of_shirt();
    Parameters parameters;
    parameters.recover.frames = 2;
    filter_of("dress").run(scene, parameters);
    ASSERT_TRUE(scene.recovered);
    const Dressing& end = *scene.recovered;
    ASSERT_TRUE(end.certified) << explain(end, { "shirt.ply" });
    ASSERT_TRUE(scene.garments[0].stand_in.value()) << "it was led";
    EXPECT_TRUE(scene.garments[0].stand_in.value()->is_rough);
    EXPECT_FALSE(end.garments[0].stand_in) << "and went on as it is";
    EXPECT_EQ(end.garments[0].positions.rows(), scene.garments[0].mesh.positions.rows());
    ASSERT_TRUE(end.residual);
    EXPECT_TRUE(end.residual->is_at_rest());
    ASSERT_FALSE(end.frames.empty());
    EXPECT_EQ(end.frames.back().garments[0], end.garments[0].positions);
}

TEST(StandIns, ThatAreRoughAreFollowedByDrapingAlone)
{
    Scene scene = scene_of_shirt();
    for (const char* filter : { "rig", "fit", "drape" })
        filter_of(filter).run(scene, Parameters());
    ASSERT_TRUE(scene.draped->certified) << explain(*scene.draped, { "shirt.ply" });
    ASSERT_TRUE(scene.garments[0].stand_in.value());
    EXPECT_FALSE(scene.draped->garments[0].stand_in);
    EXPECT_LT(scene.draped->garments[0].certificate.strain.median, 0.02);
}

TEST(StandIns, AreNotLookedForWhereAGarmentIsOneLayer)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/tshirt.ply");
    Scene scene;
    scene.garments = { { make_garment(file.positions(), file.triangles()) } };
    EXPECT_FALSE(find_stand_ins(scene));
    EXPECT_EQ(lead(scene).garments[0].mesh.positions, scene.garments[0].mesh.positions);
}

/// A body, and beside it a garment of two triangles that followed a stand-in of the same shape.
Scene scene_that_followed(bool needed, const Positions& worn)
{
    Scene scene;
    const TriangleMesh person = fixtures::capsule_person().mesh;
    scene.body = make_body(person.positions, person.triangles);
    GarmentMesh sheet { Positions(4, 3), Triangles(2, 3) };
    sheet.positions << 5, 0, 0, 6, 0, 0, 6, 1, 0, 5, 1, 0;
    sheet.triangles << 0, 1, 2, 0, 2, 3;
    scene.garments = { { sheet } };
    scene.garments[0].stand_in = StandIn { sheet, needed };
    scene.recovered.emplace();
    Dressing& end = *scene.recovered;
    end.body = person.positions;
    end.certified = true;
    WornGarment garment { sheet, worn };
    garment.stand_in = WornStandIn { sheet, sheet.positions };
    garment.certificate = certify(person, sheet, worn);
    end.garments = { garment };
    return scene;
}

TEST(StandIns, AreGivenUpWhereTheyAreNotNeededAndFollowedBadly)
{
    Positions good(4, 3), strained(4, 3);
    good << 5, 0, 0, 6, 0, 0, 6, 1, 0, 5, 1, 0;
    strained = 1.3 * good;
    const auto gives_up = [](Scene scene) {
        const bool given_up = give_up_stand_ins(scene);
        EXPECT_EQ(given_up, !scene.garments[0].stand_in->has_value());
        return given_up;
    };
    EXPECT_FALSE(gives_up(scene_that_followed(false, good)));
    EXPECT_TRUE(gives_up(scene_that_followed(false, strained)));
    EXPECT_FALSE(gives_up(scene_that_followed(true, strained)));
    Scene crossing = scene_that_followed(false, good);
    crossing.recovered->certified = false;
    EXPECT_TRUE(gives_up(crossing));
    Scene too_small = crossing;
    too_small.recovered->scale_reached = 0.9;
    EXPECT_FALSE(gives_up(too_small)) << "it is so in any triangles";
}

TEST(StandIns, ThatAreRoughAreGivenUpWhereNoRestIsFoundAfterThem)
{
    const Positions place = scene_that_followed(false, Positions::Zero(4, 3)).garments[0].mesh.positions;
    Scene scene = scene_that_followed(false, place);
    scene.garments[0].stand_in.value()->is_rough = true;
    Scene as_followed = scene;
    EXPECT_TRUE(give_up_stand_ins(as_followed));
    scene.recovered->garments[0].stand_in.reset();
    EXPECT_FALSE(give_up_stand_ins(scene)) << "it found one";
    scene.recovered->certified = false;
    scene.recovered->scale_reached = 0.9;
    EXPECT_FALSE(give_up_stand_ins(scene)) << "too small in its own triangles";
    scene.recovered->garments[0] = as_followed.recovered->garments[0];
    EXPECT_TRUE(give_up_stand_ins(scene)) << "what is too small in rough triangles may fit in its own";
}

TEST(StandIns, AreNotRoughBesideOthers)
{
    Scene scene = scene_that_followed(true, Positions::Zero(4, 3));
    scene.garments.push_back(scene.garments[0]);
    scene.garments[1].stand_in.value()->is_needed = false;
    scene.garments[1].stand_in.value()->is_rough = true;
    ASSERT_TRUE(find_stand_ins(scene));
    EXPECT_TRUE(scene.garments[0].stand_in.value());
    EXPECT_FALSE(scene.garments[1].stand_in.value());
}

// Apart by less than the digits of a file of single precision.
TEST(StandIns, AreGivenUpWhereAFileWouldHoldNewCrossings)
{
    Scene scene = scene_that_followed(false, Positions::Zero(4, 3));
    GarmentMesh sheets { Positions(6, 3), Triangles(2, 3) };
    sheets.positions << 5, 0, 0, 6, 0, 0, 5, 1, 0, 5.2, 0.2, 0.01, 5.4, 0.2, 0.01, 5.2, 0.4, 0.5;
    sheets.triangles << 0, 1, 2, 3, 4, 5;
    Positions worn = sheets.positions;  // an edge of the second triangle passes the first one by 1e-9 m
    worn.col(2) << 0.3, 0.3, 0.3, 0.3 + 1e-9, 0.3 + 1e-9, 0.5;
    scene.garments[0].mesh = sheets;
    WornGarment& garment = scene.recovered->garments[0];
    garment.rest = sheets;
    garment.positions = worn;
    garment.stand_in = WornStandIn { sheets, worn };
    garment.certificate = certify({ scene.recovered->body, scene.body->surface.triangles }, sheets, worn);
    ASSERT_TRUE(garment.certificate.clean());
    EXPECT_TRUE(give_up_stand_ins(scene));
}

TEST(StandIns, AreLookedForWhereAGarmentMovedAsItIsInVain)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/tshirt.ply");
    Scene scene;
    scene.garments = { { make_garment(file.positions(), file.triangles()) } };
    EXPECT_FALSE(find_stand_ins(scene));
    scene.recovered.emplace();
    scene.recovered->certified = true;
    EXPECT_FALSE(find_linings(scene));
    scene.recovered->certified = false;
    Scene too_small = scene;
    too_small.recovered->scale_reached = 0.9;
    EXPECT_FALSE(find_linings(too_small));
    too_small.recovered->garments.emplace_back();
    EXPECT_FALSE(find_linings(too_small)) << "its cloth crosses itself nowhere";
    too_small.recovered->garments[0].certificate.kept_self_crossings = { { 0, 1 } };
    EXPECT_TRUE(find_linings(too_small)) << "folds in each other may hold it";
    EXPECT_TRUE(find_linings(scene));
    ASSERT_TRUE(scene.garments[0].stand_in.value());
    EXPECT_FALSE(scene.garments[0].stand_in.value()->is_needed);
    EXPECT_FALSE(find_linings(scene)) << "tried";
}

}  // namespace
}  // namespace garmentfit
