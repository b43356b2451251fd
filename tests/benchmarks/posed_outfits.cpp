// SPDX-License-Identifier: GPL-3.0-or-later

// Poses a dressed body and counts what passes through: `posed_outfits BODY GARMENT WORN [FOLDER]`, in metres. WORN is
// the dressed garment of `garmentfit dress`. Prints one line of JSON; with FOLDER, writes body and garment in each pose.
// Weights of the garment: ours, against those of the nearest point of the skin. Counts of crossings are pairs: [whole
// body, body without covered skin, drawn in under the cloth]; `out` counts pixels of skin that came out of the cloth in
// 1,008 views of the whole body, and `torn` the edges that poses stretch to more than twice their length.
// scripts/measure-outfits makes the table.

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "barycentric.h"
#include "garmentfit/certificate.h"
#include "garmentfit/covered_skin.h"
#include "garmentfit/garment_weights.h"
#include "garmentfit/inset_skin.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"
#include "keyframes.h"
#include "nearest.h"
#include "skin_weights.h"
#include "topology.h"
#include "views.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;

/// What other programs do: the weights of the nearest point of the skin.
SkinWeights nearest_point_weights(const TriangleMesh& body, const SkinWeights& weights, const Positions& worn)
{
    const TriangleTree tree(body);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(worn.rows(), bone_count);
    for (Eigen::Index v = 0; v < worn.rows(); ++v) {
        const auto nearest = tree.nearest_triangle(worn.row(v));
        const Eigen::RowVector3i corners = body.triangles.row(nearest->triangle);
        const auto corner = [&](int k) { return Vec3(body.positions.row(corners[k])); };
        const auto shares = barycentric(nearest->point, corner(0), corner(1), corner(2));
        for (int k = 0; k < 3; ++k)
            for (int slot = 0; slot < 4; ++slot)
                dense(v, weights.bones(corners[k], slot)) += shares[k] * weights.weights(corners[k], slot);
    }
    return strongest_four(dense);
}

struct Outfit {
    TriangleMesh body;
    Rig rig;
    GarmentMesh garment;  // as given
    Positions worn;
};

Outfit read_outfit(char** arguments)
{
    const MeshFile body = MeshFile::read(arguments[1]), garment = MeshFile::read(arguments[2]),
                   worn = MeshFile::read(arguments[3]);
    return { { body.positions(), body.triangles() },
             rig_body(make_body(body.positions(), body.triangles())),
             make_garment(garment.positions(), garment.triangles()),
             worn.positions() };
}

void write_pose(const std::filesystem::path& folder, const std::string& name, const TriangleMesh& mesh)
{
    std::filesystem::create_directories(folder);
    write_ply(folder / (name + ".ply"), mesh.positions, mesh.triangles);
}

constexpr int k_views_of_a_pose = 28, k_pixels = 200;

/// Edges that posing stretches to more than twice their length, of those longer than 1 mm.
long torn_edges(const TriangleMesh& posed, const Positions& worn)
{
    long count = 0;
    const Edges edges = edges_of(posed.triangles);
    for (const auto& edge : edges.rowwise()) {
        const double before = (worn.row(edge[0]) - worn.row(edge[1])).norm();
        const double after = (posed.positions.row(edge[0]) - posed.positions.row(edge[1])).norm();
        count += before > 1e-3 && after > 2 * before;
    }
    return count;
}

/// One of the poses, and the first of its views of all those of the set.
struct Moment {
    const TriangleMesh &body, &shown;  // as it is, and as an outfit without covered skin has it
    int first_view, views;
};

/// Pixels of skin that came out of the cloth.
long pixels_out(const TriangleMesh& cloth, const Moment& moment)
{
    long count = 0;
    for (int view = 0; view < k_views_of_a_pose; ++view) {
        const int number = moment.first_view + view * (moment.views / k_views_of_a_pose);
        count
            += fixtures::skin_before_cloth(moment.body, cloth, fixtures::direction_of(number, moment.views), k_pixels);
    }
    return count;
}

/// One way of giving weights to the garment, and what passes through it in all poses so far.
struct Rival {
    const char* name;
    SkinWeights weights;
    int all = 0, shown = 0;
    long out = 0, torn = 0;

    Json count(const TriangleMesh& cloth, const Moment& moment)
    {
        const int through_all = crossing_count(moment.body, cloth);
        const int through_shown = crossing_count(moment.shown, cloth);
        const long pixels = pixels_out(cloth, moment);
        all += through_all;
        shown += through_shown;
        out += pixels;
        return { { "crossings", { through_all, through_shown } }, { "out", pixels } };
    }
    Json sums() const { return { { "crossings", { all, shown } }, { "out", out }, { "torn", torn } }; }
};

Json measure(const Outfit& outfit, const std::filesystem::path& folder)
{
    const Triangles& cloth = outfit.garment.triangles;
    Rival rivals[] { { "ours", garment_weights(outfit.body, outfit.rig.weights, outfit.garment, outfit.worn) },
                     { "nearest", nearest_point_weights(outfit.body, outfit.rig.weights, outfit.worn) } };
    const TriangleMesh inset { inset_skin(outfit.body, { { outfit.worn, cloth } }), outfit.body.triangles };
    const auto is_covered = find_covered_skin(inset, outfit.rig, { { { outfit.worn, cloth }, rivals[0].weights } });
    const Triangles shown = uncovered_faces(outfit.body.triangles, is_covered);
    Json poses = Json::array();
    const std::vector<Keyframe> keys = keyframes_of(outfit.rig);
    for (const Keyframe& key : keys) {
        const BoneTransforms transforms = bone_transforms(outfit.rig.skeleton, key.pose);
        const TriangleMesh body { blend_linearly(outfit.body.positions, outfit.rig.weights, transforms),
                                  outfit.body.triangles };
        const TriangleMesh shown_skin { blend_linearly(inset.positions, outfit.rig.weights, transforms), shown };
        const Moment moment { body, shown_skin, int(poses.size()), int(keys.size()) * k_views_of_a_pose };
        Json pose { { "pose", key.name } };
        for (Rival& rival : rivals) {
            const TriangleMesh posed { blend_linearly(outfit.worn, rival.weights, transforms), cloth };
            pose[rival.name] = rival.count(posed, moment);
            rival.torn += torn_edges(posed, outfit.worn);
            if (!folder.empty())
                write_pose(folder, key.name + " " + rival.name, posed);
        }
        if (!folder.empty()) {
            write_pose(folder, key.name + " body", body);
            write_pose(folder, key.name + " shown", shown_skin);
        }
        poses.push_back(pose);
    }
    Json result { { "faces", outfit.body.triangles.rows() }, { "shown_faces", shown.rows() } };
    for (const Rival& rival : rivals)
        result[rival.name] = rival.sums();
    result["poses"] = poses;
    return result;
}

}  // namespace

int main(int count, char** arguments)
try {
    if (count != 4 && count != 5) {
        std::cerr << "usage: posed_outfits BODY GARMENT WORN [FOLDER]\n";
        return 2;
    }
    std::cout << measure(read_outfit(arguments), count == 5 ? arguments[4] : "").dump() << "\n";
} catch (const std::exception& error) {
    std::cerr << "posed_outfits: " << error.what() << "\n";
    return 2;
}
