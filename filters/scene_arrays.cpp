// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/scene_arrays.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"
#include "garmentfit/filters/given_rig.h"
#include "garmentfit/filters/joint_names.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "garmentfit/filters/warnings.h"

namespace garmentfit {
namespace {

// ---- writing --------------------------------------------------------------------------------------------------------

NamedArray numbers(const char* name, const std::vector<double>& values)
{
    return { name, Rows(Eigen::Map<const Rows>(values.data(), Eigen::Index(values.size()), 1)) };
}

NamedArray counts(const char* name, const std::vector<int>& values)
{
    return { name, Counts(Eigen::Map<const Counts>(values.data(), Eigen::Index(values.size()), 1)) };
}

NamedArray frame_array(const char* name, const Frame& frame)
{
    Rows row(1, 4);
    row << frame.metres_per_unit, frame.up.transpose();
    return { name, row };
}

template <class Items, class Get>
auto each(const Items& items, const Get& get)
{
    std::vector<std::decay_t<decltype(get(*items.begin()))>> values;
    for (const auto& item : items)
        values.push_back(get(item));
    return values;
}

Counts garments_of(const std::vector<FitConflict>& conflicts)
{
    Counts pairs(conflicts.size(), 2);
    for (std::size_t i = 0; i < conflicts.size(); ++i)
        pairs.row(Eigen::Index(i)) << conflicts[i].garments[0], conflicts[i].garments[1];
    return pairs;
}

std::vector<TooTight> too_tight_at(const Dressing& dressing, std::size_t garment)
{
    std::vector<TooTight> parts;
    std::copy_if(dressing.too_tight.begin(), dressing.too_tight.end(), std::back_inserter(parts),
                 [garment](const TooTight& part) { return part.garment == int(garment); });
    return parts;
}

std::vector<NamedArray> certificate_arrays(const Certificate& c, double metres_per_unit)
{
    return { counts("BodyCrossings", { c.body_crossings }),
             counts("SelfCrossings", { c.self_crossings }),
             counts("InputSelfCrossings", { c.input_self_crossings }),
             counts("KeptSelfCrossings", { int(c.kept_self_crossings.size()) }),
             counts("ShiftedSelfCrossings", { c.shifted_self_crossings }),
             counts("LayerCrossings", { c.layer_crossings }),
             counts("VerticesInside", { c.vertices_inside }),
             numbers("GarmentMinDistance", { c.min_distance / metres_per_unit }),
             numbers("StrainMedian", { c.strain.median }),
             numbers("StrainP95", { c.strain.p95 }),
             numbers("StrainMax", { c.strain.max }) };
}

int joint_row(Extremity tip) { return 1 + int(bone_count) + int(tip); }

// ---- reading --------------------------------------------------------------------------------------------------------

constexpr const char* k_rig_first = "connect the body that Rig Body made";

/// @param rows  -1 for any number but none
Rows required(const FindArray& find, const char* name, Eigen::Index rows, Eigen::Index columns, const char* remedy)
{
    const std::optional<Rows> found = find(name);
    if (!found)
        throw InvalidInput(ErrorCode::missing_input, std::string("the input has no array ") + name + "; " + remedy);
    const bool right_size = found->cols() == columns && (rows < 0 ? found->rows() > 0 : found->rows() == rows);
    if (!right_size || !found->allFinite())
        throw InvalidInput(right_size ? ErrorCode::not_finite : ErrorCode::count_mismatch,
                           std::string("array ") + name + " of " + std::to_string(found->rows()) + " x "
                               + std::to_string(found->cols())
                               + (right_size ? " has numbers that are not finite; " : " has a wrong size; ") + remedy);
    return *found;
}

Frame frame_from(const Rows& row, const char* name)
{
    const Frame frame { row(0, 0), row.block<1, 3>(0, 1).transpose() };
    if (!(frame.metres_per_unit > 0) || frame.up.cwiseAbs().sum() != 1 || frame.up.cwiseAbs().maxCoeff() != 1)
        throw InvalidInput(ErrorCode::out_of_range,
                           std::string("array ") + name
                               + " is not a unit and an up axis; connect what the filter before made");
    return frame;
}

}  // namespace

MeshArrays arrays_of(const Rig& rig, const Frame& body)
{
    Rows axes(2, 3);
    axes << rig.up.transpose(), rig.front.transpose();
    return { { { "JointIndices", BoneIndices(rig.weights.bones.cast<unsigned short>()) },
               { "JointWeights", Rows(rig.weights.weights) } },
             {},
             { { "RigJoints", rows_of(rig.skeleton) },
               { "RigAxes", axes },
               numbers("RigRadii", { rig.radii.begin(), rig.radii.end() }),
               numbers("RigSideConfidence", { rig.side_confidence }),
               frame_array("BodyFrame", body) } };
}

MeshArrays arrays_of_fits(const Scene& scene)
{
    Rows poses(scene.fits.size(), k_pose_columns);
    for (std::size_t i = 0; i < scene.fits.size(); ++i)
        poses.row(Eigen::Index(i)) = row_of(scene.fits[i].pose);
    MeshArrays made { {}, {}, { { "FitPoses", poses }, counts("FitLayers", each(scene.fits, [](const FitResult& fit) {
                                                                  return fit.layer;
                                                              })) } };
    if (!scene.one_pose)
        return made;
    const auto& conflicts = scene.conflicts;
    made.field.push_back(counts("OnePose", { *scene.one_pose ? 1 : 0 }));
    made.field.push_back(
        { "ConflictBone", each(conflicts, [](const FitConflict& c) { return std::string(bone_name(c.bone)); }) });
    made.field.push_back({ "ConflictGarments", garments_of(conflicts) });
    made.field.push_back(
        numbers("ConflictAngle", each(conflicts, [](const FitConflict& c) { return k_degrees_per_radian * c.angle; })));
    return made;
}

MeshArrays arrays_of(const Dressing& dressing, const Pose& pose, const Texts& names, const Frame& body)
{
    const std::string note = dressing.certified ? std::string() : explain(dressing, names);
    const auto& held = dressing.held_back;
    const auto& overlaps = dressing.overlaps;
    return { {},
             {},
             { { "DressedPose", row_of(pose) },
               counts("Certified", { dressing.certified ? 1 : 0 }),
               numbers("ScaleReached", { dressing.scale_reached }),
               numbers("PoseReached", { dressing.pose_reached }),
               numbers("Speed", { dressing.speed.value_or(NAN) }),
               numbers("Residual",
                       { dressing.residual ? dressing.residual->mean : NAN,
                         dressing.residual ? dressing.residual->percentile_99 : NAN }),
               { "Note", Texts { note } },
               { "Warnings", warnings_about_dressing(dressing, names) },
               { "HeldBackPart", each(held, [](const HeldBack& part) { return part.part; }) },
               numbers("HeldBackDistance",
                       each(held, [&](const HeldBack& part) { return part.distance / body.metres_per_unit; })),
               { "OverlapPart", each(overlaps, [](const Overlap& overlap) { return overlap.part; }) },
               { "OverlapOther", each(overlaps, [](const Overlap& overlap) { return overlap.other; }) },
               numbers("OverlapDepth", each(overlaps, [&](const Overlap& overlap) {
                           return overlap.depth / body.metres_per_unit;
                       })) } };
}

MeshArrays arrays_of(const Frame& garment)
{
    return { {},
             {},
             { frame_array("GarmentFrame", garment), counts("GarmentHasUnit", { garment.has_unit }),
               numbers("GarmentSizeInUnit", { garment.size_in_unit }) } };
}

MeshArrays arrays_of(const FitResult& fit)
{
    return { {},
             {},
             { { "FoundType", Texts { std::string(name_of(fit.type)) } },
               numbers("FoundTypeProbability", { fit.type_probability }) } };
}

/// How it fits, in words and by place.
std::vector<NamedArray> verdict_arrays(const Dressing& dressing, std::size_t garment)
{
    const std::optional<FitVerdict> verdict = fit_verdict(dressing, garment);
    if (!verdict)
        return {};
    const auto& places = verdict->places;
    const std::string fabric
        = verdict->would_do ? std::string(fabric_names()[static_cast<int>(*verdict->would_do)]) : std::string();
    return { { "Verdict", Texts { std::string(name_of(verdict->verdict)) } },
             { "FabricThatWouldDo", Texts { fabric } },
             { "VerdictPlace", each(places, [](const PlaceVerdict& place) { return place.place; }) },
             { "PlaceVerdict",
               each(places, [](const PlaceVerdict& place) { return std::string(name_of(place.verdict)); }) },
             numbers("PlaceStretch", each(places, [](const PlaceVerdict& place) { return place.stretch; })),
             numbers("PlacePressure", each(places, [](const PlaceVerdict& place) { return place.pressure; })) };
}

MeshArrays arrays_of_worn(const Dressing& dressing, std::size_t garment, const Frame& body)
{
    const bool worn = dressing.is_worn(garment);
    MeshArrays made { {}, {}, { counts("Worn", { worn ? 1 : 0 }) } };
    if (!worn)
        return made;
    const double unit = body.metres_per_unit;
    const std::vector<Girth>& girths = dressing.girths[garment];
    const std::vector<TooTight> tight = too_tight_at(dressing, garment);
    const Overstretch& stretch = dressing.overstretches[garment];
    const auto add = [&made](const NamedArray& array) { made.field.push_back(array); };
    for (const NamedArray& array : certificate_arrays(dressing.garments[garment].certificate, unit))
        add(array);
    add({ "GirthPlace", each(girths, [](const Girth& girth) { return girth.place; }) });
    add(numbers("GirthBody", each(girths, [unit](const Girth& girth) { return girth.body / unit; })));
    add(numbers("GirthGarment", each(girths, [unit](const Girth& girth) { return girth.garment / unit; })));
    add(counts("OverstretchedEdges", { stretch.edges }));
    add(numbers("LargestStretch", { stretch.largest }));
    add({ "OverstretchedPart", Texts { stretch.part } });
    for (const NamedArray& array : verdict_arrays(dressing, garment))
        add(array);
    add({ "TooTightPart", each(tight, [](const TooTight& part) { return part.part; }) });
    add(numbers("MissingGirth", each(tight, [unit](const TooTight& part) { return part.missing_girth / unit; })));
    return made;
}

MeshArrays arrays_of(const FitMap& map, const Frame& body)
{
    return { { { "Ease", Rows(map.ease / body.metres_per_unit) },
               { "Strain", Rows(map.strain) },
               { "Pressure", Rows(map.pressure) } },
             {},
             {} };
}

std::vector<std::pair<int, int>> skeleton_lines()
{
    std::vector<std::pair<int, int>> lines;
    for (int b = 0; b < bone_count; ++b)
        lines.emplace_back(1 + parent_of(b), 1 + b);  // the parent of the first ones is -1, the root's row 0
    for (int e = 0; e < extremity_count; ++e)
        lines.emplace_back(1 + bone_before(Extremity(e)), joint_row(Extremity(e)));
    return lines;
}

MeshArrays arrays_of_skeleton()
{
    Texts joints { "root" }, bones;
    std::vector<int> ids(k_joint_rows), parents { -1 }, bone_ids;
    for (int b = 0; b < bone_count; ++b) {
        joints.emplace_back(joint_name(Bone(b)));
        bones.emplace_back(bone_name(b));
        bone_ids.push_back(b);
    }
    for (int e = 0; e < extremity_count; ++e) {
        joints.emplace_back(joint_name(Extremity(e)));
        bones.emplace_back(joint_name(Extremity(e)));
        bone_ids.push_back(-1);
    }
    for (int i = 0; i < k_joint_rows; ++i)
        ids[i] = i;
    for (const auto& [from, to] : skeleton_lines())
        parents.push_back(from);
    return { { { "JointName", joints }, counts("JointId", ids), counts("JointParent", parents) },
             { { "BoneName", bones }, counts("BoneId", bone_ids) },
             {} };
}

Rig rig_from(const FindArray& find, const Positions& own)
{
    Rig rig;
    rig.weights = weights_of(required(find, "JointIndices", -1, 4, k_rig_first),
                             required(find, "JointWeights", -1, 4, k_rig_first));
    rig.skeleton = skeleton_of(required(find, "RigJoints", k_joint_rows, 3, k_rig_first));
    const Rows axes = required(find, "RigAxes", 2, 3, k_rig_first);
    const Rows radii = required(find, "RigRadii", bone_count, 1, k_rig_first);
    rig.up = axes.row(0);
    rig.front = axes.row(1);
    std::copy_n(radii.data(), radii.size(), rig.radii.begin());
    rig.side_confidence = required(find, "RigSideConfidence", 1, 1, k_rig_first)(0, 0);
    return rig_on(std::move(rig), own);
}

Frame body_frame_from(const FindArray& find)
{
    return frame_from(required(find, "BodyFrame", 1, 4, k_rig_first), "BodyFrame");
}

std::vector<FitResult> fits_from(const FindArray& find)
{
    constexpr const char* k_fit_first = "connect the body that Fit Skeleton made";
    const Rows poses = required(find, "FitPoses", -1, k_pose_columns, k_fit_first);
    Rows layers = Rows::Zero(poses.rows(), 1);  // older files have none and list garments from the inside out
    if (find("FitLayers"))
        layers = required(find, "FitLayers", poses.rows(), 1, k_fit_first);
    std::vector<FitResult> fits(poses.rows());
    for (std::size_t i = 0; i < fits.size(); ++i) {
        fits[i].pose = pose_of(poses.row(Eigen::Index(i)));
        fits[i].layer = int(std::clamp(layers(Eigen::Index(i), 0), 0., double(fits.size())));
    }
    return fits;
}

Pose dressed_pose_from(const FindArray& find)
{
    return pose_of(required(find, "DressedPose", 1, k_pose_columns, "connect the body that Drape Garment made"));
}

std::optional<Frame> garment_frame_from(const FindArray& find)
{
    if (!find("GarmentFrame"))
        return {};
    constexpr const char* k_made_first = "connect what the filter before made";
    Frame frame = frame_from(required(find, "GarmentFrame", 1, 4, k_made_first), "GarmentFrame");
    if (find("GarmentHasUnit"))  // older files have none
        frame.has_unit = required(find, "GarmentHasUnit", 1, 1, k_made_first)(0, 0) != 0;
    if (find("GarmentSizeInUnit"))
        frame.size_in_unit = required(find, "GarmentSizeInUnit", 1, 1, k_made_first)(0, 0);
    return frame;
}

}  // namespace garmentfit
