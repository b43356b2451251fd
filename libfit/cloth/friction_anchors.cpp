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

void FrictionAnchors::set_active_contacts(std::vector<ActiveContact> contacts, const Positions& x)
{
    std::vector<Vec3> before(anchors_.size(), Vec3::Zero());
    for (const ActiveContact& contact : contacts_)
        before[index_of(contact)] = contact.force;
    contacts_ = std::move(contacts);
    for (ActiveContact& contact : contacts_) {
        if (const Vec3& force = before[index_of(contact)]; !force.isZero(0))
            contact.force += k_kept_normal_force * (force - contact.force);
        std::optional<Anchor>& anchor = anchors_[index_of(contact)];
        if (anchor)
            continue;
        anchor = { contact.corners, contact.weights, Vec3::Zero() };
        anchor->place = offset(contact.vertex, *anchor, x);
    }
}

std::vector<SoftConstraint> FrictionAnchors::constraints(const Positions& x, double share) const
{
    std::vector<SoftConstraint> result;
    for (const ActiveContact& contact : contacts_) {
        const Anchor& anchor = *anchors_[index_of(contact)];
        const double pressing = contact.force.norm(), most = share * contact.friction * pressing;
        const Vec3 normal = contact.force / pressing, here = offset(contact.vertex, anchor, x),
                   slip = across(here - anchor.place, normal);
        SoftConstraint constraint { { contact.vertex, anchor.corners[0], anchor.corners[1], anchor.corners[2] },
                                    { 1, -anchor.weights[0], -anchor.weights[1], -anchor.weights[2] },
                                    anchor.place,
                                    normal,
                                    0,
                                    contact.stiffness };
        if (const double pull = contact.stiffness * slip.norm(); pull > most) {
            // the tangent of a pull of constant length: across the slip it turns along, along the slip it is 0
            constraint.normal = normal.cross(slip).normalized();
            constraint.normal_stiffness = most / slip.norm();
            constraint.tangent_stiffness = k_sliding_stiffness * constraint.normal_stiffness;
            constraint.target = here - slip / k_sliding_stiffness;
        }
        result.push_back(constraint);
    }
    return result;
}

void FrictionAnchors::follow(const Positions& x, double share)
{
    std::vector<std::optional<Anchor>> kept(anchors_.size());
    for (const ActiveContact& contact : contacts_) {
        const Anchor& anchor = *anchors_[index_of(contact)];
        const double pressing = contact.force.norm(), most = contact.friction * pressing;
        const Vec3 slip = across(offset(contact.vertex, anchor, x) - anchor.place, contact.force / pressing);
        const double pull = contact.stiffness * slip.norm();
        std::optional<Anchor>& next = kept[index_of(contact)];
        next = anchor;
        if (pull <= share * most)
            continue;
        next = { contact.corners, contact.weights, Vec3::Zero() };
        next->place = offset(contact.vertex, *next, x) - k_kinetic_friction * most / pull * slip;
    }
    anchors_ = std::move(kept);
}

}  // namespace garmentfit
