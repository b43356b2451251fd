// SPDX-License-Identifier: GPL-3.0-or-later
#include "near_origin.h"

#include <algorithm>
#include <cmath>

#include "diagonal.h"
#include "moved_scene.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// derived: the grid of origins, 1/1024 of a body's box, is a power of two. Coordinates on it and those of a mesh far
// away are multiples of the mesh's last digit, and so is their difference, which is shorter: it is exact.
constexpr int k_grid_exponent = -10;

/// On the floor in the middle.
Vec3 foot_of(const Positions& positions)
{
    Vec3 foot = (positions.colwise().minCoeff() + positions.colwise().maxCoeff()) / 2;
    foot.y() = positions.col(1).minCoeff();
    return foot;
}

/// @param size  of the body's box, m
Vec3 origin_at(const Vec3& foot, double size)
{
    const double grid = std::exp2(std::floor(std::log2(size)) + k_grid_exponent);
    const auto along
        = [&](double x) { return size > 0 && std::abs(x) > k_far * size ? std::round(x / grid) * grid : 0; };
    return { along(foot.x()), along(foot.y()), along(foot.z()) };
}

/// The body's origin for what lies near the body.
Vec3 origin_beside(const Positions& positions, const Vec3& body, double size)
{
    if (positions.rows() == 0)
        return body;
    const Vec3 foot = foot_of(positions);
    return (foot - body).cwiseAbs().maxCoeff() > k_far * size ? origin_at(foot, size) : body;
}

void move(Positions& positions, const Vec3& by) { positions.rowwise() += by.transpose(); }

void move(Rig& rig, const Vec3& by)
{
    rig.skeleton.root += by;
    for (Vec3& tail : rig.skeleton.tails)
        tail += by;
    for (Vec3& tip : rig.skeleton.tips)
        tip += by;
}

/// @param by    of the garments on it, and of the body in its pose
/// @param rest  of the body's input pose
/// @param garments  of the garments' rest shapes
void move(Dressing& dressing, const Vec3& by, const Vec3& rest, const std::vector<Vec3>& garments)
{
    dressing.pose.root_translation += by - rest;
    move(dressing.body, by);
    for (const std::size_t i : dressing.worn()) {
        move(dressing.garments[i].rest.positions, garments[i]);
        move(dressing.garments[i].positions, by);
        if (auto& stand_in = dressing.garments[i].stand_in) {
            move(stand_in->rest.positions, garments[i]);
            move(stand_in->positions, by);
        }
    }
}

/// Frames lie on the way from the place of the draped garments to that of the body.
void move(RecoverFrame& frame, const Vec3& draped, const Vec3& body)
{
    const Vec3 by = body + (1 - frame.share) * (draped - body);
    move(frame.body, by);
    for (Positions& garment : frame.garments)
        if (garment.rows() > 0)
            move(garment, by);
}

/// By the origins, times `sign`.
Scene moved(Scene scene, const Origins& origins, double sign)
{
    const Vec3 body = sign * origins.body, draped = sign * origins.draped;
    std::vector<Vec3> garments;
    for (const Vec3& origin : origins.garments)
        garments.push_back(sign * origin);
    move(scene.body->surface.positions, body);
    move(scene.body->closed.positions, body);
    for (std::size_t i = 0; i < scene.garments.size(); ++i) {
        move(scene.garments[i].mesh.positions, garments[i]);
        if (scene.garments[i].stand_in && *scene.garments[i].stand_in)
            move((*scene.garments[i].stand_in)->mesh.positions, garments[i]);
    }
    if (scene.rig)
        move(*scene.rig, body);
    for (std::size_t i = 0; i < std::min(scene.fits.size(), garments.size()); ++i)
        scene.fits[i].pose.root_translation += garments[i] - body;
    if (scene.draped)
        move(*scene.draped, draped, body, garments);
    if (scene.recovered) {
        move(*scene.recovered, body, body, garments);
        for (RecoverFrame& frame : scene.recovered->frames)
            move(frame, draped, body);
    }
    return scene;
}

}  // namespace

Vec3 origin_of(const Positions& body)
{
    return body.rows() == 0 ? Vec3(Vec3::Zero()) : origin_at(foot_of(body), diagonal_of(body));
}

bool Origins::all_zero() const
{
    return body.isZero(0) && draped.isZero(0)
        && std::all_of(garments.begin(), garments.end(), [](const Vec3& origin) { return origin.isZero(0); });
}

Origins origins_of(const Scene& scene)
{
    const Positions& body = scene.body->surface.positions;
    const double size = diagonal_of(body);
    Origins origins;
    origins.body = origin_of(body);
    for (const GarmentInput& garment : scene.garments)
        origins.garments.push_back(origin_beside(garment.mesh.positions, origins.body, size));
    origins.draped = scene.draped ? origin_beside(scene.draped->body, origins.body, size) : origins.body;
    return origins;
}

Scene move_to_origin(Scene scene, const Origins& origins) { return moved(std::move(scene), origins, -1); }

GivenJoints move_to_origin(GivenJoints joints, const Origins& origins)
{
    const auto move_one = [&](std::optional<Vec3>& joint) {
        if (joint)
            *joint -= origins.body;
    };
    move_one(joints.root);
    std::for_each(joints.tails.begin(), joints.tails.end(), move_one);
    std::for_each(joints.tips.begin(), joints.tips.end(), move_one);
    return joints;
}

void move_back(Scene& scene, const Scene& near_origin, const Origins& origins, const std::vector<Data>& outputs)
{
    Origins of_made = origins;
    const bool draped_anew = std::find(outputs.begin(), outputs.end(), Data::draped) != outputs.end();
    if (draped_anew && near_origin.draped)
        of_made.draped = origins.garments[near_origin.draped->outermost];
    take_outputs(scene, moved(near_origin, of_made, 1), near_origin, outputs);
}

}  // namespace garmentfit
