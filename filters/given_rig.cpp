// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/given_rig.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "diagonal.h"
#include "garmentfit/error.h"
#include "garmentfit/rig_body.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// unit: directions may be kept with four digits
constexpr double k_rounding_of_directions = 1e-3;
// derived: glTF may keep the four weights with 8 bits each, so their sum is off by up to 4 / (2 * 255) = 0.008; twice
// that
constexpr double k_rounding_of_weights = 0.02;

using Radii = std::array<double, bone_count>;

bool is_known(const Radii& radii)
{
    return std::any_of(radii.begin(), radii.end(), [](double radius) { return radius > 0; });
}

std::string millimetres(double metres) { return std::to_string(std::lround(1000 * metres)) + " mm"; }

void require_same_count(Eigen::Index rigged, Eigen::Index here, const std::string& called)
{
    if (rigged != here)
        throw InvalidInput(ErrorCode::rig_mismatch,
                           called + " belongs to a body of " + std::to_string(rigged) + " vertices, this one has "
                               + std::to_string(here) + "; rig this body");
}

void require_directions(const Rig& rig, const std::string& called)
{
    const bool right = std::abs(rig.up.norm() - 1) < k_rounding_of_directions
        && std::abs(rig.front.norm() - 1) < k_rounding_of_directions
        && std::abs(rig.up.dot(rig.front)) < k_rounding_of_directions;
    if (!right)
        throw InvalidInput(ErrorCode::bad_rig,
                           "up and front of " + called + " are not unit vectors at right angles; rig this body");
}

void require_whole_weights(const SkinWeights& skin, const std::string& called)
{
    for (Eigen::Index v = 0; v < skin.weights.rows(); ++v)
        if (const double sum = skin.weights.row(v).sum(); !(std::abs(sum - 1) < k_rounding_of_weights))
            throw InvalidInput(ErrorCode::bad_rig,
                               "weights of " + called + " at vertex " + std::to_string(v) + " sum to "
                                   + std::to_string(sum) + " instead of 1; rig this body");
}

/// @param same_place  m
void require_same_radii(const Radii& rigged, const Radii& here, double same_place, const std::string& called)
{
    for (int b = 0; b < bone_count; ++b)
        if (std::abs(rigged[b] - here[b]) > k_same_radius * rigged[b] + same_place)
            throw InvalidInput(ErrorCode::rig_mismatch,
                               called + " belongs to another body, or this one was moved since: the skin was "
                                   + millimetres(rigged[b]) + " from bone " + std::string(bone_name(b)) + " and is "
                                   + millimetres(here[b]) + "; rig this body");
}

}  // namespace

Rig rig_on(Rig rig, const Positions& own, const std::string& called)
{
    require_same_count(rig.weights.weights.rows(), own.rows(), called);
    require_directions(rig, called);
    require_whole_weights(rig.weights, called);
    const Radii here = bone_radii(rig.skeleton, rig.weights, own);
    if (is_known(rig.radii))
        require_same_radii(rig.radii, here, k_same_place * std::min(1.0, diagonal_of(own)), called);
    rig.radii = here;
    return rig;
}

std::string doubt_about(const Rig& rig, const BodyMesh& body)
{
    try {
        check_skeleton(body, rig.skeleton, rig.weights);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "";
}

}  // namespace garmentfit
