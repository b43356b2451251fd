// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Poses a skeleton so that its bones run through the middle of the garment's parts.
//
// Methods  fast: clearance in a distance field, limbs as chains (docs/fit.md). Use this one.
//          paper: skeleton-based error metric [wu_2018_garment_fitting], equations (1)-(4), without changes.
//          tisserand: surface metric [tisserand_2017_garment_positioning], with the same search.
// Units    metres, radians. The garment stays where it is; the body is posed.
// Cost     of n garment and m body vertices: fast O(n log n), paper O(e log n), tisserand O(e (n + m) log m) for some
//          100,000 evaluations e.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/closed_ends.h"
#include "garmentfit/garment_type.h"
#include "garmentfit/mesh.h"
#include "garmentfit/progress.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

enum class FitMethod { fast, paper, tisserand };
/// "fast", ... in the order of FitMethod.
GARMENTFIT_API const std::vector<std::string_view>& fit_method_names();

/// How paper and tisserand find the nearest vertex; the results are the same.
enum class NearestSearch { kd_tree, scan };
/// "kd_tree", "scan".
GARMENTFIT_API const std::vector<std::string_view>& nearest_search_names();

struct FitOptions {
    GarmentType type = GarmentType::automatic;
    FitMethod method = FitMethod::fast;
    int iterations = 6;  ///< of paper and tisserand: rounds, each of which halves spacing and extent of the grids
    NearestSearch nearest = NearestSearch::kd_tree;
    /// Where the garment's front faces, as it is given: a unit vector in libfit's frame (metres, +y up). Empty: to be
    /// found. Read by the fast method, like the next two.
    std::optional<Vec3> front = {};
    /// Body and garment come from one scene, and the garment lies round the body already: it is worn there.
    bool as_placed = false;
    int skipped = 0;  ///< takes the next probable way of wearing after so many in which the body fits
};

/// A way of wearing a garment in which the body does not fit.
struct Rejected {
    GarmentType type = GarmentType::automatic;
    Vec3 up, front;  ///< unit, in the garment as it was given
    double probability = 0;  ///< before it was tried
    std::string reason;
};

struct FitResult {
    Pose pose;  ///< from the input pose of the body into the garment
    GarmentType type = GarmentType::automatic;  ///< as given, or as found
    /// Probabilities that the type, the side that is the front, and the upward direction are right, given how the
    /// body fits; 1 where there was no choice, and for paper and tisserand.
    double type_probability = 1, front_probability = 1, up_probability = 1;
    double probability = 1;  ///< of this way of wearing the garment, among all
    Vec3 up = Vec3::UnitY(), front = Vec3::UnitZ();  ///< where the garment's top and front point, as it was given
    std::optional<Vec3> front_given = {};  ///< FitOptions::front: the front is known, not found
    std::vector<Rejected> rejected;  ///< what was more probable at first
    std::vector<Bone> covered;
    int closed_ends = 0;  ///< of the garment: what the fit takes for openings
    LeftOut left_out = {};  ///< of the garment: pieces that are no cloth
    int layer = 0;  ///< of several garments worn together: 0 for the innermost
    /// E_B of equation (1) by the method's own metric, m, at the start and at the end; 0 for uncovered bones.
    std::array<double, bone_count> scores_before {}, scores {};
    /// Of the clearance that a covered bone's limb needs, the share that it has at the end: 0 (at the cloth, or
    /// outside) to 1 (no cloth nearer than the skin).
    std::array<double, bone_count> clearance {};
    double score_before = 0, score_after = 0;  ///< E of equation (4)
    long long evaluations = 0, bone_evaluations = 0;  ///< of E and of E_B; paper and tisserand only
};

/// The joints with head, hands and feet shortened until they no longer pass through the garment. O(log n).
GARMENTFIT_API Skeleton retract_tips(const Skeleton& joints, const GarmentMesh& garment);

/// E_B of equation (1) [wu_2018_garment_fitting], by which the poses of all methods compare; m, 0 for uncovered bones.
GARMENTFIT_API std::array<double, bone_count> paper_scores(const Rig& rig, const Pose& pose, const GarmentMesh& garment,
                                                           const std::vector<Bone>& covered);

/// Rejects garments that were read in a wrong unit: they would need too much memory.
/// @throws InvalidInput when the garment's longest side exceeds 10 times the body's height, or is below a hundredth of
/// it. O(n).
GARMENTFIT_API void require_wearable_size(const Rig& rig, const GarmentMesh& garment);

/// @pre    paper and tisserand: the garment is upright (+y up). fast: in any orientation.
/// @post   fast: no bone, covered or not, and no head passes through the garment's surface. Hands and feet may: ankles
///         and wrists do not bend, and a trouser leg longer than the leg is too narrow for a foot. retract_tips
///         shortens them.
/// @throws InvalidInput when no body fits into the garment, or its size is not wearable; SolverFailure when no such
///         pose was found, with bone and place; Cancelled.
GARMENTFIT_API FitResult fit_skeleton(const Rig& rig, const GarmentMesh& garment, const FitOptions& options = {},
                                      const Progress& progress = {});

/// The same for any method. The body's surface, whose vertices are those of the rig's weights, tells whether the
/// garment lies round it already; tisserand cannot do without.
GARMENTFIT_API FitResult fit_skeleton(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment,
                                      const FitOptions& options = {}, const Progress& progress = {});

/// A bone whose directions in two garments are too different for one pose.
struct FitConflict {
    Bone bone = bone_count;
    std::array<int, 2> garments {};  ///< in the first one, the bone would lack clearance or pass through cloth
    double angle = 0;  ///< rad, between its directions in their own fits, seen from the root
};

/// Several garments, one body.
struct CommonFit {
    std::vector<FitResult> fits;  ///< one for each garment
    bool one_pose
        = false;  ///< all fits have the same bone rotations; roots may differ: garments may be moved as a whole
    std::vector<FitConflict> conflicts;  ///< reasons against one pose, the widest angle first
};

/// Searches one pose for all garments: each bone by the garments that cover it. Without such a pose, the result has the
/// given fits and the conflicts.
/// @param fits  by the fast method, of each garment by itself
/// @throws InvalidInput when there is not one fit for each garment; Cancelled.
GARMENTFIT_API CommonFit fit_common_pose(const Rig& rig, const std::vector<GarmentMesh>& garments,
                                         const std::vector<FitResult>& fits, const Progress& progress = {});

}  // namespace garmentfit
