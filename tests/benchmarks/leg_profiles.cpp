// SPDX-License-Identifier: GPL-3.0-or-later

// Prints the bows of the legs of bodies, one line of JSON for each body whose bones are found: scripts/fit-leg-profile fits
// their weights on them.
//   leg_profiles BODY...

#include <exception>
#include <iostream>

#include <nlohmann/json.hpp>

#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "garmentfit/rig_body.h"
#include "leg_profile.h"
#include "proxy_surface.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;

constexpr double k_longest_side = 1.75;  // unit: m; files are in any unit

Json bows_of(const char* path)
{
    const MeshFile file = MeshFile::read(path);
    Positions positions = file.positions();
    positions *= k_longest_side / (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
    const BodyMesh body = make_body(positions, file.triangles());
    const TriangleMesh proxy = proxy_surface(body.closed, RigOptions().proxy_vertices);
    const CurveSkeleton curves = curve_skeleton(proxy, {});
    const BodyGraph graph = body_graph(curves);
    const BodyJoints joints = label_joints(proxy, curves, graph);
    const Slicer slicer(proxy);
    const Vec3 axis = trunk_axes(joints).front;
    Json bows;
    for (const int leg : { 0, 1 }) {
        const LegBows bow = leg_bows({ proxy, curves, graph }, slicer, joints, leg, axis);
        bows.push_back({ bow.thigh, bow.shin });
    }
    return { { "body", path }, { "axis", { axis.x(), axis.y(), axis.z() } }, { "bows", bows } };
}

}  // namespace

int main(int argc, char** argv)
{
    for (int i = 1; i < argc; ++i)
        try {
            std::cout << bows_of(argv[i]) << std::endl;
        } catch (const std::exception& reason) {
            std::cerr << argv[i] << ": " << reason.what() << std::endl;
        }
}
