// SPDX-License-Identifier: GPL-3.0-or-later

// Bends limbs of bodies through their range, to be looked at: `bends FOLDER` writes one PLY for each joint and angle,
// with a comment that says where the joint is. draw_rig.py makes one picture of them.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;

struct Range {
    const char* joint;
    int bone;
    Vec3 axis;  ///< of the body: left, up, front
    double degrees[4];
};

// Away from T, the pose in which the body is given.
const Range k_ranges[] = {
    { "shoulder raised", lhumerus, Vec3::UnitZ(), { -75, -40, 40, 75 } },
    { "shoulder forward", lhumerus, -Vec3::UnitY(), { -30, 30, 60, 90 } },
    { "elbow", lradius, -Vec3::UnitY(), { 35, 70, 105, 140 } },
    { "hip", lfemur, -Vec3::UnitX(), { -20, 40, 80, 110 } },
    { "hip spread", lfemur, Vec3::UnitZ(), { -10, 15, 30, 45 } },
    { "knee", ltibia, Vec3::UnitX(), { 35, 70, 105, 140 } },
};

Pose bent(const Rig& rig, const Range& range, double degrees)
{
    const Vec3 left = rig.up.cross(rig.front);
    const Vec3 axis = range.axis.x() * left + range.axis.y() * rig.up + range.axis.z() * rig.front;
    Pose pose;
    pose.rotations[std::size_t(range.bone)] = Eigen::AngleAxisd(degrees * std::acos(-1) / 180, axis.normalized());
    return pose;
}

void write_bends(const std::string& folder)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_BODIES "/woman_t_pose.ply");
    const Rig rig = rig_body(make_body(file.positions(), file.triangles()));
    for (const Range& range : k_ranges)
        for (const double degrees : range.degrees) {
            const Positions posed
                = skin(file.positions(), rig.weights, bone_transforms(rig.skeleton, bent(rig, range, degrees)));
            std::ostringstream name, joint;
            name << &range - k_ranges << ' ' << range.joint << ' ' << degrees;
            joint << "joint " << rig.skeleton.head(range.bone).transpose();
            write_ply(std::filesystem::path(folder) / (name.str() + ".ply"), posed, file.triangles(), {},
                      { joint.str() });
        }
}

}  // namespace

int main(int count, char** arguments)
try {
    if (count != 2) {
        std::cerr << "usage: bends FOLDER\n";
        return 2;
    }
    std::filesystem::create_directories(arguments[1]);
    write_bends(arguments[1]);
} catch (const InvalidInput& error) {
    std::cerr << "bends: " << error.what() << "\n";
    return 2;
}
