// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_validation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "garmentfit/error.h"
#include "surface_measures.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

constexpr double k_pi = 3.14159265358979323846;
constexpr int k_samples = 5;  // of each bone, ends included
constexpr double k_inside_share = 0.85;  // of all samples: mouth, armpit and crotch come close to bones
constexpr double k_most_compact
    = 0.3;  // isoperimetric quotient: 1 a ball, 0.52 a cube; humans 0.04, curled up fat ones 0.13
constexpr double k_side_tolerance = 0.2;  // between a left length and its right one; humans stay below 0.05

struct Proportion {
    const char* what;
    double value, least, most;
};

std::string text(double value)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2f", value);
    return buffer;
}

void check_inside(const TriangleMesh& closed, const Skeleton& skeleton)
{
    int inside = 0;
    for (int b = 0; b < bone_count; ++b)
        for (int k = 0; k < k_samples; ++k) {
            const double t = double(k) / (k_samples - 1);
            inside += winding_number(closed, (1 - t) * skeleton.head(b) + t * skeleton.tail(b)) > 0.5;
        }
    const double share = double(inside) / (bone_count * k_samples);
    if (share < k_inside_share)
        throw InvalidInput("body: only " + text(share) + " of the skeleton found lies inside it (at least "
                           + text(k_inside_share) + "); give a human body whose limbs are not fused together");
}

void check_sides(const Skeleton& skeleton)
{
    for (const int left : { lfemur, ltibia, lhumerus, lradius }) {
        const double l = skeleton.length(left), r = skeleton.length(mirror_of(left));
        if (std::abs(l - r) > k_side_tolerance * std::max(l, r))
            throw InvalidInput("body: " + std::string(bone_name(left)) + " comes out " + text(l) + " m long and "
                               + std::string(bone_name(mirror_of(left))) + " " + text(r)
                               + " m; give a whole human body whose limbs are not fused together");
    }
}

void check_proportions(const Skeleton& s)
{
    const double arm = s.length(lhumerus) + s.length(lradius), leg = s.length(lfemur) + s.length(ltibia);
    const double trunk = (s.tail(thorax) - s.root).norm();
    for (const Proportion& p :
         { Proportion { "upper arm to forearm", s.length(lhumerus) / s.length(lradius), 0.6, 1.7 },
           Proportion { "thigh to shin", s.length(lfemur) / s.length(ltibia), 0.6, 1.6 },
           Proportion { "arm to leg", arm / leg, 0.4, 0.85 }, Proportion { "trunk to leg", trunk / leg, 0.4, 1.25 },
           Proportion { "hip width to leg", (s.tail(lhipjoint) - s.tail(rhipjoint)).norm() / leg, 0.05, 0.5 },
           Proportion { "shoulder width to leg", (s.tail(lclavicle) - s.tail(rclavicle)).norm() / leg, 0.15, 0.8 },
           Proportion { "collarbone to leg", std::max(s.length(lclavicle), s.length(rclavicle)) / leg, 0.1, 0.65 } })
        if (!(p.value >= p.least && p.value <= p.most))
            throw InvalidInput(std::string("body: ") + p.what + " comes out as " + text(p.value) + ", a human's is "
                               + text(p.least) + " to " + text(p.most) + "; give a human body");
}

}  // namespace

void check_shape(const TriangleMesh& closed)
{
    const double quotient = 36 * k_pi * std::pow(volume(closed), 2) / std::pow(area(closed), 3);
    if (quotient > k_most_compact)
        throw InvalidInput("body: it is as compact as a block, with an isoperimetric quotient of " + text(quotient)
                           + " (a human's is at most " + text(k_most_compact) + "); give a human body");
}

void check_rig(const TriangleMesh& closed, const Skeleton& skeleton)
{
    check_proportions(skeleton);
    check_sides(skeleton);
    check_inside(closed, skeleton);
}

}  // namespace garmentfit
