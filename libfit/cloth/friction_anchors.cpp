// SPDX-License-Identifier: GPL-3.0-or-later
#include "friction_anchors.h"

#include <utility>

#include "tuning.h"

namespace garmentfit {
namespace {

Vec3 across(const Vec3& way, const Vec3& normal) { return way - way.dot(normal) * normal; }

}  // namespace

// Of a vertex from the point that its anchor hangs on.
Vec3 FrictionAnchors::offset(int vertex, const Anchor& anchor, const Positions& x)
{
    Vec3 result = x.row(vertex).transpose();
    for (int k = 0; k < 3; ++k)
        if (anchor.corners[k] >= 0)
            result -= anchor.weights[k] * x.row(anchor.corners[k]).transpose();
    return result;
}

void FrictionAnchors::set_touches(std::vector<Touch> touches, const Positions& x)
{
    touches_ = std::move(touches);
    for (const Touch& touch : touches_) {
        std::optional<Anchor>& anchor = anchors_[index_of(touch)];
        if (anchor)
            continue;
        anchor = { touch.corners, touch.weights, Vec3::Zero() };
        anchor->place = offset(touch.vertex, *anchor, x);
    }
}

std::vector<SoftConstraint> FrictionAnchors::constraints(const Positions& x, double share) const
{
    std::vector<SoftConstraint> result;
    for (const Touch& touch : touches_) {
        const Anchor& anchor = *anchors_[index_of(touch)];
        const double pressing = touch.force.norm(), most = share * touch.friction * pressing;
        const Vec3 normal = touch.force / pressing, here = offset(touch.vertex, anchor, x),
                   slip = across(here - anchor.place, normal);
        SoftConstraint constraint { { touch.vertex, anchor.corners[0], anchor.corners[1], anchor.corners[2] },
                                    { 1, -anchor.weights[0], -anchor.weights[1], -anchor.weights[2] },
                                    anchor.place,
                                    normal,
                                    0,
                                    touch.stiffness };
        if (const double pull = touch.stiffness * slip.norm(); pull > most) {
            constraint.tangent_stiffness *= k_sliding_stiffness * most / pull;
            constraint.target = here - slip / k_sliding_stiffness;
        }
        result.push_back(constraint);
    }
    return result;
}

void FrictionAnchors::follow(const Positions& x, double share)
{
    std::vector<std::optional<Anchor>> kept(anchors_.size());
    for (const Touch& touch : touches_) {
        const Anchor& anchor = *anchors_[index_of(touch)];
        const double pressing = touch.force.norm(), most = touch.friction * pressing;
        const Vec3 slip = across(offset(touch.vertex, anchor, x) - anchor.place, touch.force / pressing);
        const double pull = touch.stiffness * slip.norm();
        std::optional<Anchor>& next = kept[index_of(touch)];
        next = anchor;
        if (pull <= share * most)
            continue;
        next = { touch.corners, touch.weights, Vec3::Zero() };
        next->place = offset(touch.vertex, *next, x) - k_kinetic_friction * most / pull * slip;
    }
    anchors_ = std::move(kept);
}

}  // namespace garmentfit
