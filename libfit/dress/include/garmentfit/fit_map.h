// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measures how a garment sits: vertex by vertex, and by the tape measure.

#include <string>
#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// One value for each vertex of the garment. A vertex without a face has the values of the vertex with a face that is
/// nearest at rest.
struct FitMap {
    Eigen::VectorXd ease;  ///< m; gap to the skin
    Eigen::VectorXd strain;  ///< mean of l / l0 - 1 over the edges at the vertex; positive where stretched
    Eigen::VectorXd pressure;  ///< Pa; on skin that the cloth touches, by its tension and weight
};

/// For a garment at rest on a body (both in metres, y up, in one pose). Pressure is the force of springs, hinges and
/// gravity that is left towards the skin, by area. Where the cloth is not at rest, the map is not smooth. Cost O((n +
/// m) log m).
GARMENTFIT_API FitMap fit_map(const TriangleMesh& body, const WornGarment& worn, const ClothOptions& cloth = {});

/// An edge stretched by more than this share of its length is overstretched: caught somewhere, or drawn round more body
/// than the garment has girth for. Strain limiting begins below (docs/drape.md).
/// fitted: guess, on the house pairs that dress/tuning.h names. It stands here because warnings state it.
constexpr double k_overstretched = 0.5;

/// How a garment goes round a part of the body.
struct PartLoad {
    std::string part;  ///< as in TooTight
    double girth;  ///< m, of the cloth as worn
    double stretch;  ///< mean of l / l0 - 1 over the edges that run round the part; negative where the cloth is slack
    double pressure;  ///< Pa, on the mean: the tension of this stretch over the radius [kirk_1966_extensibility]
};

/// Where the edges of a garment go round the body, the stretch there and the pressure that follows. The pressure is that
/// of the stiffness that the solver uses, which is soft for woven fabrics (docs/fabrics.md): a lower bound there.
/// @param skeleton  in the pose of body and garment
/// @param body      the vertices of the weights, metres, in the pose in which the garment is worn. Cost O(n log n + m).
GARMENTFIT_API std::vector<PartLoad> part_loads(const Skeleton& skeleton, const SkinWeights& weights,
                                                const Positions& body, const WornGarment& worn,
                                                const ClothOptions& cloth = {});

/// How many edges are overstretched, and where the worst is.
struct Overstretch {
    int edges = 0;  ///< those that are overstretched
    double largest = 0;  ///< l / l0 - 1 of the edge that is stretched most
    std::string part;  ///< of the body, next to that edge, as in TooTight; empty where nothing is overstretched
    double limit = k_overstretched;  ///< l / l0 - 1 beyond which an edge counts
    double longer = 0;  ///< m, the most by which an edge is longer than at rest
    double gained = 0;  ///< area gained by triangles that more than doubled, as a share of all cloth at rest
};

/// @param body   the vertices of the weights, in the pose in which the garment is worn. Cost O(n log n + m).
/// @param limit  l / l0 - 1; what is stretched further counts
GARMENTFIT_API Overstretch overstretch(const SkinWeights& weights, const Positions& body, const WornGarment& worn,
                                       double limit = k_overstretched);

/// Edges of a dressed body that are much longer than the pose makes them: cloth holds some of its vertices far from the
/// others. Of a body below its full size, too. Nothing where `dressed` has no body of its own. Cost O(m).
GARMENTFIT_API Overstretch find_spikes(const Rig& rig, const BodyMesh& body, const DressedBody& dressed);

/// Girths of body and garment in one place, by a tape drawn tight round the cut of a plane across the bone.
struct Girth {
    std::string place;  ///< "neck", "chest", "waist", "hips", "left thigh", "left upper arm", ...
    double body, garment;  ///< m
    double ease() const { return garment - body; }
};

/// Girths in the places that the garment goes round, from the neck down. The chest is measured where the trunk is
/// widest above the waist, the waist where it is narrowest, the hips where it is widest below. Limbs never count into
/// the trunk.
/// @param skeleton  in the pose of body and garment
GARMENTFIT_API std::vector<Girth> girths(const Skeleton& skeleton, const SkinWeights& weights, const TriangleMesh& body,
                                         const WornGarment& worn);

}  // namespace garmentfit
