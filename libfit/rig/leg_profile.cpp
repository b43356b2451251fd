// SPDX-License-Identifier: GPL-3.0-or-later
#include "leg_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

/// One bone of a leg with the skin round it.
class ProfiledBone {
public:
    /// @param curve  as in BodyGraph::curve. @param front  need not be square to the bone
    ProfiledBone(const LabelledSurface& surface, const Slicer& slicer, int curve, const Vec3& from, const Vec3& to,
                 const Vec3& front) :
        slicer_(slicer),
        is_foreign_(surface.foreign_to(curve)), from_(from), to_(to), axis_((to - from).normalized()),
        forward_((front - front.dot(axis_) * axis_).normalized())
    {
    }

    /// Mean over some places of the middle between the foremost and the rearmost skin: its distance before the bone, a
    /// share of the bone's length. Not a number where the skin does not show.
    double middle(std::span<const double> places) const
    {
        double sum = 0;
        for (const double place : places)
            sum += middle_at(from_ + place * (to_ - from_));
        return sum / double(places.size()) / (to_ - from_).norm();
    }

private:
    double middle_at(const Vec3& point) const
    {
        const std::optional<CrossSection> cut = slicer_.cut(point, axis_);
        int own = 0;
        double foremost = -std::numeric_limits<double>::max(), rearmost = -foremost;
        for (std::size_t i = 0; cut && i < cut->outline.size(); ++i)
            if (!is_foreign_(cut->vertices[i])) {
                const double forward = (cut->outline[i] - point).dot(forward_);
                foremost = std::max(foremost, forward);
                rearmost = std::min(rearmost, forward);
                ++own;
            }
        return own < k_fewest_in_profile ? std::numeric_limits<double>::quiet_NaN() : 0.5 * (foremost + rearmost);
    }

    const Slicer& slicer_;
    IsForeign is_foreign_;
    Vec3 from_, to_, axis_, forward_;
};

/// 1 for a straight joint, 0 for one that is bent much. Both directions are unit.
double straightness(const Vec3& above, const Vec3& below)
{
    return std::clamp((above.dot(below) - k_bent_profile) / (1 - k_bent_profile), 0.0, 1.0);
}

double zero_if_unseen(double bow) { return std::isfinite(bow) ? bow : 0; }

}  // namespace

LegBows leg_bows(const LabelledSurface& surface, const Slicer& slicer, const BodyJoints& joints, int leg,
                 const Vec3& front)
{
    const LimbJoints& limb = joints.legs[std::size_t(leg)];
    const Vec3 down = (joints.pelvis - joints.neck_base).normalized(), thigh = (limb.middle - limb.root).normalized(),
               shin = (limb.end - limb.middle).normalized();
    const Vec3 of_thigh = Eigen::Quaterniond::FromTwoVectors(down, thigh) * front;
    const Vec3 of_shin = Eigen::Quaterniond::FromTwoVectors(thigh, shin) * of_thigh;
    const ProfiledBone upper(surface, slicer, 2 + leg, limb.root, limb.middle, of_thigh),
        lower(surface, slicer, 2 + leg, limb.middle, limb.end, of_shin);
    const double thigh_bow = upper.middle(k_thigh_places) - upper.middle(k_buttock_places);
    const double shin_bow
        = lower.middle(k_calf_places) - 0.5 * (lower.middle(k_below_knee_places) + lower.middle(k_ankle_places));
    return { straightness(down, thigh) * zero_if_unseen(thigh_bow),
             straightness(thigh, shin) * zero_if_unseen(shin_bow) };
}

double certainty_of_front(const std::array<LegBows, 2>& bows)
{
    double log_odds = 0;
    for (const LegBows& leg : bows)
        log_odds += 0.5 * (k_thigh_bow * leg.thigh + k_shin_bow * leg.shin);
    return std::tanh(0.5 * log_odds);  // derived: 2 / (1 + exp(-log_odds)) - 1
}

Vec3 front_of_legs(const LabelledSurface& surface, const Slicer& slicer, const BodyJoints& joints)
{
    const Vec3 front = trunk_axes(joints).front;
    return certainty_of_front(
               { leg_bows(surface, slicer, joints, 0, front), leg_bows(surface, slicer, joints, 1, front) })
        * front;
}

}  // namespace garmentfit
