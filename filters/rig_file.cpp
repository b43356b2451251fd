// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/rig_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "garmentfit/error.h"
#include "garmentfit/filters/joint_names.h"
#include "garmentfit/io.h"

namespace garmentfit {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* k_format = "garmentfit-rig";
constexpr int k_version = 2;  // 1 had margins in place of probabilities and confidences

// ---- values in the file's units and axes -----------------------------------------------------------------------

Json json_of(const Vec3& v) { return Json { v.x(), v.y(), v.z() }; }

Vec3 vector_of(const Json& json)
{
    return { json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>() };
}

Json point(const Frame& frame, const Vec3& in_metres)
{
    return json_of(frame.to_file(Positions(in_metres.transpose())).row(0));
}

Vec3 point(const Frame& frame, const Json& json)
{
    return frame.to_metres(Positions(vector_of(json).transpose())).row(0);
}

Json direction(const Frame& frame, const Vec3& d) { return json_of(frame.rotation().transpose() * d); }
Vec3 direction(const Frame& frame, const Json& json) { return frame.rotation() * vector_of(json); }

Json displacement(const Frame& frame, const Vec3& d) { return direction(frame, Vec3(d / frame.metres_per_unit)); }
Vec3 displacement(const Frame& frame, const Json& json) { return direction(frame, json) * frame.metres_per_unit; }

/// (w, x, y, z), about an axis in the file's axes.
Json quaternion(const Frame& frame, const Eigen::Quaterniond& q)
{
    const Vec3 axis = frame.rotation().transpose() * q.vec();
    return Json { q.w(), axis.x(), axis.y(), axis.z() };
}

Eigen::Quaterniond quaternion(const Frame& frame, const Json& json)
{
    const Vec3 axis
        = frame.rotation() * Vec3(json.at(1).get<double>(), json.at(2).get<double>(), json.at(3).get<double>());
    const Eigen::Quaterniond q(json.at(0).get<double>(), axis.x(), axis.y(), axis.z());
    constexpr double k_rounding = 1e-6;  // unit: text files keep six digits at least
    if (!(std::abs(q.norm() - 1) < k_rounding))  // not normalised: a pose that is written and read keeps its bits
        throw InvalidInput(ErrorCode::bad_rig, "a rotation is not a unit quaternion");
    return q;
}

void put_frame(Json& json, const Frame& frame)
{
    json["metres_per_unit"] = frame.metres_per_unit;
    json["up"] = json_of(frame.up);
    if (!frame.has_unit)
        json["has_unit"] = false;
}

Frame frame_of(const Json& json)
{
    const Frame frame { json.at("metres_per_unit").get<double>(), vector_of(json.at("up")),
                        json.value("has_unit", true) };
    if (!(frame.metres_per_unit > 0))
        throw InvalidInput(ErrorCode::out_of_range, "metres_per_unit is not positive");
    if (frame.up.cwiseAbs() != Vec3::UnitX() && frame.up.cwiseAbs() != Vec3::UnitY()
        && frame.up.cwiseAbs() != Vec3::UnitZ())
        throw InvalidInput(ErrorCode::out_of_range, "up is not one of the six axis directions");
    return frame;
}

// ---- the parts of the file ---------------------------------------------------------------------------------------

Json ends(const Frame& frame, const Skeleton& skeleton, int bone)
{
    return { { "head", point(frame, skeleton.head(bone)) }, { "tail", point(frame, skeleton.tail(bone)) } };
}

Json bones_of(const Frame& frame, const Rig& rig)
{
    Json bones = Json::array();
    for (int b = 0; b < bone_count; ++b) {
        Json bone { { "name", bone_name(b) }, { "parent", parent_of(b) < 0 ? "root" : bone_name(parent_of(b)) } };
        bone.update(ends(frame, rig.skeleton, b));
        bone["radius"] = rig.radii[b] / frame.metres_per_unit;
        bones.push_back(bone);
    }
    return bones;
}

Json tips_of(const Frame& frame, const Skeleton& skeleton)
{
    Json tips;
    for (int e = 0; e < extremity_count; ++e)
        tips[std::string(joint_name(Extremity(e)))] = point(frame, skeleton.tips[e]);
    return tips;
}

Json fitted_joints(const Frame& frame, const Skeleton& skeleton)
{
    Json joints;
    for (int b = 0; b < bone_count; ++b)
        joints[std::string(bone_name(b))] = ends(frame, skeleton, b);
    return joints;
}

Json pose_of(const Frame& frame, const Pose& pose)
{
    Json json { { "root_translation", displacement(frame, pose.root_translation) },
                { "root_rotation", quaternion(frame, pose.root_rotation) } };
    for (int b = 0; b < bone_count; ++b)
        json["rotations"][std::string(bone_name(b))] = quaternion(frame, pose.rotations[b]);
    return json;
}

/// For people, not read back: the angle of each bone from the input pose, degrees.
Json angles_of(const Pose& pose)
{
    const auto angle = [](const Eigen::Quaterniond& q) {
        return k_degrees_per_radian * q.angularDistance(Eigen::Quaterniond::Identity());
    };
    Json json { { "root", angle(pose.root_rotation) } };
    for (int b = 0; b < bone_count; ++b)
        json[std::string(bone_name(b))] = angle(pose.rotations[b]);
    return json;
}

Pose pose_of(const Frame& frame, const Json& json)
{
    Pose pose;
    pose.root_translation = displacement(frame, json.at("root_translation"));
    pose.root_rotation = quaternion(frame, json.at("root_rotation"));
    for (int b = 0; b < bone_count; ++b)
        pose.rotations[b] = quaternion(frame, json.at("rotations").at(std::string(bone_name(b))));
    return pose;
}

Json garment_of(const Frame& body_frame, const Skeleton& own, const FittedGarment& garment)
{
    Json json { { "file", garment.file },
                { "type", name_of(garment.fit.type) },
                { "type_probability", garment.fit.type_probability },
                { "layer", garment.fit.layer } };
    put_frame(json, garment.frame);
    json["covered"] = Json::array();
    for (const Bone bone : garment.fit.covered)
        json["covered"].push_back(bone_name(bone));
    json["pose"] = pose_of(body_frame, garment.fit.pose);
    json["angles"] = angles_of(garment.fit.pose);
    json["fitted"] = fitted_joints(body_frame, pose_skeleton(own, garment.fit.pose));
    return json;
}

/// @param place  among the garments. Older files have no layers and list the garments from the inside out.
FittedGarment garment_of(const Frame& body_frame, const Json& json, int place)
{
    FittedGarment garment { json.at("file").get<std::string>(), frame_of(json), {} };
    garment.fit.type = garment_type_of(json.at("type").get<std::string>());
    garment.fit.type_probability = json.at("type_probability").get<double>();
    garment.fit.layer = json.value("layer", place);
    garment.fit.pose = pose_of(body_frame, json.at("pose"));
    for (const Json& name : json.at("covered"))
        if (const int bone = bone_of(name.get<std::string>()); bone >= 0)
            garment.fit.covered.push_back(static_cast<Bone>(bone));
    return garment;
}

Skeleton skeleton_of(const Frame& frame, const Json& json)
{
    Skeleton skeleton;
    skeleton.root = point(frame, json.at("root"));
    for (const Json& bone : json.at("bones")) {
        const auto name = bone.at("name").get<std::string>();
        if (bone_of(name) < 0)
            throw InvalidInput(ErrorCode::unknown_name, "unknown bone \"" + name + "\"");
        skeleton.tails[bone_of(name)] = point(frame, bone.at("tail"));
    }
    if (json.at("bones").size() != bone_count)
        throw InvalidInput(ErrorCode::count_mismatch,
                           std::to_string(json.at("bones").size()) + " bones instead of " + std::to_string(bone_count));
    for (int e = 0; e < extremity_count; ++e)
        skeleton.tips[e] = point(frame, json.at("tips").at(std::string(joint_name(Extremity(e)))));
    return skeleton;
}

/// n x 4 bones and weights, row after row.
Json weights_of(const SkinWeights& skin)
{
    return { { "bones", std::vector<int>(skin.bones.data(), skin.bones.data() + skin.bones.size()) },
             { "values", std::vector<double>(skin.weights.data(), skin.weights.data() + skin.weights.size()) } };
}

/// 0, which means unknown, in files that have no radii.
std::array<double, bone_count> radii_of(const Frame& frame, const Json& json)
{
    std::array<double, bone_count> radii {};
    for (const Json& bone : json.at("bones"))
        radii[bone_of(bone.at("name").get<std::string>())] = bone.value("radius", 0.0) * frame.metres_per_unit;
    return radii;
}

SkinWeights weights_of(const Json& json)
{
    const auto bones = json.at("bones").get<std::vector<int>>();
    const auto values = json.at("values").get<std::vector<double>>();
    if (bones.size() != values.size() || bones.size() % 4 != 0)
        throw InvalidInput(ErrorCode::count_mismatch,
                           std::to_string(bones.size()) + " bones for " + std::to_string(values.size())
                               + " weights, four of each belong to a vertex");
    SkinWeights skin;
    skin.bones.resize(Eigen::Index(bones.size() / 4), 4);
    skin.weights.resize(skin.bones.rows(), 4);
    for (std::size_t i = 0; i < bones.size(); ++i) {
        if (!(bones[i] >= 0 && bones[i] < bone_count && values[i] >= 0 && values[i] <= 1))
            throw InvalidInput(ErrorCode::bad_rig,
                               "vertex " + std::to_string(i / 4) + " has a bone or a weight out of range");
        skin.bones.data()[i] = bones[i];
        skin.weights.data()[i] = values[i];
    }
    return skin;
}

RigFile rig_file_of(const Json& json)
{
    if (json.at("format") != k_format)
        throw InvalidInput(ErrorCode::unreadable_file, "its format is not " + std::string(k_format));
    if (const int version = json.at("version").get<int>(); version != k_version)
        throw InvalidInput(ErrorCode::unreadable_file,
                           "it has version " + std::to_string(version) + ", and this program reads version "
                               + std::to_string(k_version));
    RigFile contents;
    contents.frame = frame_of(json);
    contents.rig.skeleton = skeleton_of(contents.frame, json);
    contents.rig.radii = radii_of(contents.frame, json);
    contents.rig.up = direction(contents.frame, json.at("trunk_up"));
    contents.rig.front = direction(contents.frame, json.at("front"));
    contents.rig.side_confidence = json.at("side_confidence").get<double>();
    if (json.contains("weights"))
        contents.rig.weights = weights_of(json.at("weights"));
    for (const Json& garment : json.value("garments", Json::array()))
        contents.garments.push_back(garment_of(contents.frame, garment, int(contents.garments.size())));
    return contents;
}

const FittedGarment& outermost(const std::vector<FittedGarment>& garments)
{
    return *std::max_element(garments.rbegin(), garments.rend(),
                             [](const FittedGarment& a, const FittedGarment& b) { return a.fit.layer < b.fit.layer; });
}

GivenJoints all_joints(const Skeleton& skeleton)
{
    GivenJoints joints { skeleton.root, {}, {} };
    for (int b = 0; b < bone_count; ++b)
        joints.tails[b] = skeleton.tails[b];
    for (int e = 0; e < extremity_count; ++e)
        joints.tips[e] = skeleton.tips[e];
    return joints;
}

GivenJoints joints_of(const Frame& frame, const Json& json)
{
    if (json.contains("bones"))
        return all_joints(skeleton_of(frame_of(json), json));
    GivenJoints joints;
    for (const auto& [name, position] : json.at("joints").items())
        joint_of(joints, name) = point(frame, position);
    return joints;
}

/// What the JSON library says, without the name and number of its exception.
std::string reason_of(const Json::exception& error)
{
    const std::string text = error.what();
    const std::size_t end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

/// @throws InvalidInput naming the file, whatever is wrong in it.
template <class Read>
auto read_json(const std::filesystem::path& path, const char* remedy, const Read& read)
{
    std::ifstream file(path);
    if (!file)
        throw InvalidInput(ErrorCode::unreadable_file, path.string() + ": cannot be read; " + remedy);
    try {
        return read(Json::parse(file));
    } catch (const Json::exception& error) {
        throw InvalidInput(ErrorCode::unreadable_file, path.string() + ": " + reason_of(error) + "; " + remedy);
    } catch (const InvalidInput& error) {
        throw InvalidInput(error.code(), path.string() + ": " + error.what() + "; " + remedy);
    }
}

SkinWeights read_weights(const std::filesystem::path& rigged)
{
    const std::vector<VertexProperty> properties = read_ply_properties(rigged);
    const auto column = [&](const std::string& name) -> const std::vector<double>& {
        for (const VertexProperty& property : properties)
            if (property.name == name)
                return property.values;
        throw InvalidInput(ErrorCode::bad_rig,
                           rigged.string() + ": no vertex property " + name + "; write it again with garmentfit rig");
    };
    const std::size_t n = column("weight0").size();
    SkinWeights weights;
    weights.bones.resize(n, 4);
    weights.weights.resize(n, 4);
    for (int k = 0; k < 4; ++k) {
        const auto& bone = column("joint" + std::to_string(k));
        const auto& weight = column("weight" + std::to_string(k));
        for (std::size_t v = 0; v < n; ++v) {
            if (!(bone[v] >= 0 && bone[v] < int(bone_count) && weight[v] >= 0 && weight[v] <= 1))
                throw InvalidInput(ErrorCode::bad_rig,
                                   rigged.string() + ": vertex " + std::to_string(v)
                                       + " has a bone or a weight out of range; write it again with garmentfit rig");
            weights.bones(v, k) = static_cast<int>(bone[v]);
            weights.weights(v, k) = weight[v];
        }
    }
    return weights;
}

}  // namespace

void write_rig_file(const std::filesystem::path& path, const RigFile& contents)
{
    const Skeleton& skeleton = contents.rig.skeleton;
    Json json { { "format", k_format }, { "version", k_version } };
    put_frame(json, contents.frame);
    json["front"] = direction(contents.frame, contents.rig.front);
    json["trunk_up"] = direction(contents.frame, contents.rig.up);
    json["side_confidence"] = contents.rig.side_confidence;
    json["root"] = point(contents.frame, skeleton.root);
    json["bones"] = bones_of(contents.frame, contents.rig);
    json["tips"] = tips_of(contents.frame, skeleton);
    if (!contents.garments.empty())
        json["fitted"] = fitted_joints(contents.frame, pose_skeleton(skeleton, outermost(contents.garments).fit.pose));
    for (const FittedGarment& garment : contents.garments)
        json["garments"].push_back(garment_of(contents.frame, skeleton, garment));
    if (contents.has_weights())
        json["weights"] = weights_of(contents.rig.weights);
    const int indent = contents.has_weights() ? -1 : 1;  // weights are tens of thousands of numbers: on one line
    write_file(path, json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n');
}

GivenJoints read_joints(const std::filesystem::path& path, const Frame& frame)
{
    return read_json(path, "give {\"joints\": {\"lelbow\": [x, y, z], ...}}, or a rig.json",
                     [&](const Json& json) { return joints_of(frame, json); });
}

RigFile read_rig_file(const std::filesystem::path& path)
{
    return read_json(path, "write it again: garmentfit rig or fit, or Save Rig in MeshLab", rig_file_of);
}

RigFile read_whole_rig(const std::filesystem::path& path)
{
    RigFile contents = read_rig_file(path);
    if (!contents.has_weights())
        contents.rig.weights = read_weights(path.parent_path() / "rigged.ply");
    return contents;
}

}  // namespace garmentfit
