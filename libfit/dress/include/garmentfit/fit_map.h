// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a garment sits: vertex by vertex, and by the tape measure.

#include <string>
#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// One value for each vertex of the garment; one that is of no face has those of the nearest vertex at rest that is.
struct FitMap {
    Eigen::VectorXd ease;  ///< m; gap to the skin
    Eigen::VectorXd strain;  ///< mean of l / l0 - 1 over the edges at the vertex; positive where stretched
    Eigen::VectorXd pressure;  ///< Pa; what the cloth presses on skin that it touches, by its tension and weight
};

/// For a garment at rest on a body (both in metres, y up, in one pose). Cost O((n + m) log m). Pressure is the force that
/// springs, hinges and gravity leave to the skin, so it is as smooth as the cloth is at rest.
GARMENTFIT_API FitMap fit_map(const TriangleMesh& body, const WornGarment& worn, const ClothOptions& cloth = {});

/// An edge stretched by more than this share of its length is overstretched: threads lock before (docs/drape.md), so it is caught
/// somewhere, or the garment has no room.
constexpr double k_overstretched = 0.5;

/// Where cloth is stretched most, and how much of it by more than it may be.
struct Overstretch {
    int edges = 0;  ///< those that are overstretched
    double largest = 0;  ///< l / l0 - 1 of the edge that is stretched most
    std::string part;  ///< of the body, next to that edge, as in TooTight; empty where nothing is overstretched
};

/// @param body  the vertices of the weights, in the pose in which the garment is worn. Cost O(n log n + m).
GARMENTFIT_API Overstretch overstretch(const SkinWeights& weights, const Positions& body, const WornGarment& worn);

/// Girths in one place, by a tape drawn tight round what is cut by a plane across the bone.
struct Girth {
    std::string place;  ///< "neck", "chest", "waist", "hips", "left thigh", "left upper arm", ...
    double body, garment;  ///< m
    double ease() const { return garment - body; }
};

/// Where the garment goes round the body, from the neck down. The chest is measured where the trunk is widest above the
/// waist, the waist where it is narrowest, the hips where it is widest below; limbs never count into the trunk.
/// @param skeleton  in the pose of body and garment
GARMENTFIT_API std::vector<Girth> girths(const Skeleton& skeleton, const SkinWeights& weights, const TriangleMesh& body,
                                         const WornGarment& worn);

}  // namespace garmentfit
