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

TEST(StandIns, AreNotLookedForWhereAGarmentIsOneLayer)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/tshirt.ply");
    Scene scene;
    scene.garments = { { make_garment(file.positions(), file.triangles()) } };
    EXPECT_FALSE(find_stand_ins(scene));
    EXPECT_EQ(lead(scene).garments[0].mesh.positions, scene.garments[0].mesh.positions);
}

}  // namespace
}  // namespace garmentfit
