// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Poses a skeleton so that its bones run through the middle of the garment's parts.
//
// Methods  fast: room in a distance field, limbs as chains (docs/fit.md); the one to use.
//          paper: skeleton-based error metric [wu_2018_garment_fitting], equations (1)-(4), to the letter.
//          tisserand: surface metric [tisserand_2017_garment_positioning], searched in the same way.
// Units    metres, radians. The garment stays where it is; the body comes to it.
// Cost     of n garment and m body vertices: fast O(n log n), paper O(e log n), tisserand O(e (n + m) log m) for e
//          evaluations, some hundred thousand.

#include <array>
#include <string_view>
#include <vector>

#include "garmentfit/garment_type.h"
#include "garmentfit/mesh.h"
#include "garmentfit/progress.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

enum class FitMethod { fast, paper, tisserand };
/// "fast", ... in the order of FitMethod.
GARMENTFIT_API const std::vector<std::string_view>& fit_method_names();

/// How paper and tisserand look for the nearest vertex; the answers are the same.
enum class NearestSearch { kd_tree, scan };
/// "kd_tree", "scan".
GARMENTFIT_API const std::vector<std::string_view>& nearest_search_names();

struct FitOptions {
    GarmentType type = GarmentType::automatic;
    FitMethod method = FitMethod::fast;
    int iterations
        = 6;  ///< of paper and tisserand: rounds of translation, rotation and bones; each halves spacing and extent
    NearestSearch nearest = NearestSearch::kd_tree;
};

struct FitResult {
    Pose pose;  ///< takes the body from its own pose into the garment
    GarmentType type = GarmentType::automatic;  ///< as given, or as found
    double type_margin = 1;  ///< 1 when the type was given
    double front_margin
        = 1;  ///< 0: the body could as well face the other way; 1: it could not. 1 for paper and tisserand, which
    ///< do not ask
    Vec3 up = Vec3::UnitY();  ///< what is up for the garment as it was given
    double up_margin = 1;  ///< 0: another way up is as good; 1 also where the given one leaves no doubt
    std::vector<Bone> covered;
    int layer = 0;  ///< of several garments worn together: 0 for the innermost
    std::array<double, bone_count> scores_before {}, scores {};  ///< E_B of equation (1) by the method's own metric,
        ///< metres, at the start and at the end; 0 for bones that take no part
    std::array<double, bone_count>
        clearance {};  ///< how central a covered bone runs at the end: of the room that its limb needs, the share
        ///< that it has, 0 (at the cloth, or outside) to 1 (no cloth nearer than the skin)
    double score_before = 0, score_after = 0;  ///< E of equation (4)
    long long evaluations = 0, bone_evaluations = 0;  ///< of E and of E_B; paper and tisserand only
};

/// The joints with their tips drawn back to where the extremities no longer pass through the garment. O(log n).
GARMENTFIT_API Skeleton retract_tips(const Skeleton& joints, const GarmentMesh& garment);

/// E_B of the paper's equation (1), by which poses of all methods compare; metres, 0 for bones that are not covered.
GARMENTFIT_API std::array<double, bone_count> paper_scores(const Rig& rig, const Pose& pose, const GarmentMesh& garment,
                                                    const std::vector<Bone>& covered);

/// What nobody could wear is a file read in a wrong unit, and would take all memory there is.
/// @throws InvalidInput when the garment is more than 10 times as long as the body is tall, or less than a hundredth of that. O(n).
GARMENTFIT_API void require_wearable_size(const Rig& rig, const GarmentMesh& garment);

/// @pre    By paper and tisserand: the garment hangs upright (+y up). By the fast method it may be turned in any way.
/// @post   By the fast method: no bone, covered or not, and no head passes through the garment's surface. Hands and feet keep clear where they can:
///         ankles and wrists do not bend, and a trouser leg longer than the leg has no room for a foot across it; there,
///         retract_tips says how far they reach.
/// @throws InvalidInput when no body fits into the garment, or its size is absurd; SolverFailure when no such pose was found, naming bone and place;
///         Cancelled.
GARMENTFIT_API FitResult fit_skeleton(const Rig& rig, const GarmentMesh& garment, const FitOptions& options = {},
                               const Progress& progress = {});

/// The same for any method: tisserand reads the body's surface, whose vertices are those of the rig's weights.
GARMENTFIT_API FitResult fit_skeleton(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment,
                               const FitOptions& options = {}, const Progress& progress = {});

/// A bone that no one pose holds well in each of two garments.
struct FitConflict {
    Bone bone = bone_count;
    std::array<int, 2> garments {};  ///< the first one is where the bone would lack room, or pass through cloth
    double angle = 0;  ///< radians between its directions in their own fits, seen from the root
};

/// Several garments, one body.
struct CommonFit {
    std::vector<FitResult> fits;  ///< one for each garment
    bool one_pose
        = false;  ///< all fits turn the bones alike; only the root may be elsewhere, for garments may be moved as they are
    std::vector<FitConflict> conflicts;  ///< why not, the widest angle first
};

/// Looks for one pose that serves all garments: each bone by all of those that cover it. Where there is none, the fits come back as they
/// were, with what stands in the way.
/// @param fits  by the fast method, of each garment by itself
/// @throws Cancelled
GARMENTFIT_API CommonFit common_fit(const Rig& rig, const std::vector<GarmentMesh>& garments,
                             const std::vector<FitResult>& fits, const Progress& progress = {});

}  // namespace garmentfit
