// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parts of a scene as named arrays, for hosts that pass arrays from filter to filter, keep them in files and show them.
// The names are the same in all hosts. Rigs, poses and frames are in metres with +y up, so that a rig that is written
// and read keeps its bits; arrays for users are in the body's unit.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/rig_arrays.h"
#include "garmentfit/filters/snapshot.h"
#include "garmentfit/units.h"

namespace garmentfit {

using Counts = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using BoneIndices
    = Eigen::Matrix<unsigned short, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  ///< as glTF has them
using Texts = std::vector<std::string>;

/// One row for each vertex, cell or entry.
struct NamedArray {
    std::string name;
    std::variant<Rows, Counts, BoneIndices, Texts> values;
};

struct MeshArrays {
    std::vector<NamedArray> points, cells, field;
};

// ---- written --------------------------------------------------------------------------------------------------------

/// Of the body: JointIndices, JointWeights; RigJoints, RigAxes, RigRadii, RigSideConfidence, BodyFrame.
MeshArrays arrays_of(const Rig& rig, const Frame& body);
/// Of the body: FitPoses, FitLayers, and where several garments were asked for one pose: OnePose, ConflictBone,
/// ConflictGarments, ConflictAngle (degrees).
MeshArrays arrays_of_fits(const Scene& scene);
/// Of the body: DressedPose, Certified, ScaleReached, PoseReached, Speed, Note, HeldBackPart, HeldBackDistance.
MeshArrays arrays_of(const Dressing& dressing, const Pose& pose, const Texts& names, const Frame& body);

/// Of a garment: GarmentFrame.
MeshArrays arrays_of(const Frame& garment);
/// Of a garment: FoundType, FoundTypeProbability.
MeshArrays arrays_of(const FitResult& fit);
/// Of a garment: Worn; and if it is, the certificate, girths and where it is too tight.
MeshArrays arrays_of_worn(const Dressing& dressing, std::size_t garment, const Frame& body);
/// Of a garment: Ease, Strain, Pressure.
MeshArrays arrays_of(const FitMap& map, const Frame& body);

/// Of the skeleton's joints: JointName, JointId, JointParent; of its lines: BoneName, BoneId (-1: a tip).
MeshArrays arrays_of_skeleton();
/// Bones and tips as lines between the rows that rows_of(skeleton) has for its joints; in the order of the cell arrays.
std::vector<std::pair<int, int>> skeleton_lines();

// ---- read back ------------------------------------------------------------------------------------------------------

/// The array of that name, if there is one, as numbers.
using FindArray = std::function<std::optional<Rows>(const char* name)>;

/// @throws InvalidInput naming the array that is missing or wrong and the filter that makes it, or both numbers of
///         vertices where the rig is another body's. The other functions likewise.
/// @param own  the body's positions in its input pose, metres
Rig rig_from(const FindArray& find, const Positions& own);
Frame body_frame_from(const FindArray& find);
std::vector<FitResult> fits_from(const FindArray& find);
Pose dressed_pose_from(const FindArray& find);
/// Empty where no filter has read the garment.
std::optional<Frame> garment_frame_from(const FindArray& find);

}  // namespace garmentfit
