// SPDX-License-Identifier: GPL-3.0-or-later
#include "dressed_folder.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/number_text.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/units.h"

namespace garmentfit::picture {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json read_json(const fs::path& path)
{
    std::ifstream file(path);
    if (!file)
        throw InvalidInput(ErrorCode::unreadable_file,
                           path.string() + ": cannot be read; give a folder that garmentfit dress, fit or rig wrote");
    return Json::parse(file);
}

Vec3 vector_of(const Json& json)
{
    return { json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>() };
}

Frame frame_of(const Json& json) { return { json.at("metres_per_unit").get<double>(), vector_of(json.at("up")) }; }

TriangleMesh read_mesh(const fs::path& path, const Frame& frame)
{
    const MeshFile file = MeshFile::read(path);
    return { frame.to_metres(file.positions()), file.triangles() };
}

State read_state(const fs::path& folder, const Frame& frame, const Json& rig, const Vec3& front)
{
    const bool pressed = fs::exists(folder / "pressed_body.ply");
    State state { read_mesh(folder / (pressed ? "pressed_body.ply" : "body.ply"), frame), {}, front };
    for (const Json& garment : rig.at("garments"))
        if (const fs::path path = folder / garment.at("file").get<std::string>(); fs::exists(path))
            state.garments.push_back(read_mesh(path, frame));
    return state;
}

/// Where the chest faces in the pose of a garment.
Vec3 fitted_front(const Json& rig, const Json& garment, const Frame& frame)
{
    const Json q = garment.at("pose").at("root_rotation");
    const Eigen::Quaterniond turn(q.at(0).get<double>(), q.at(1).get<double>(), q.at(2).get<double>(),
                                  q.at(3).get<double>());
    return frame.rotation() * (turn * vector_of(rig.at("front")));
}

std::string verdict_of(const Json& report, const Frame& frame)
{
    if (!report.at("certified").get<bool>())
        return "NOT certified: " + report.value("note", "");
    double gap = 1, strain = 0;
    for (const Json& garment : report.at("garments")) {
        gap = std::min(gap, garment.at("min_distance").get<double>() * frame.metres_per_unit);
        strain = std::max(strain, garment.at("strain").at("p95").get<double>());
    }
    return "certified: no crossing, minimum distance " + rounded_text(1000 * gap, 2) + " mm, strain "
        + rounded_text(100 * strain, 2) + "% at the 95th percentile";
}

/// Neighbouring bones get colours far apart.
Eigen::RowVector3d colour_of(int bone)
{
    const double hue = std::fmod(bone * 0.381966, 1) * 6;  // the golden section of the circle
    const auto channel
        = [&](double shift) { return 0.3 + 0.65 * std::clamp(std::abs(std::fmod(hue + shift, 6) - 3) - 1, 0.0, 1.0); };
    return { channel(0), channel(4), channel(2) };
}

Positions colours_of(const fs::path& rigged)
{
    std::map<std::string, std::vector<double>> columns;
    for (VertexProperty& property : read_ply_properties(rigged))
        columns[property.name] = std::move(property.values);
    Positions colours = Positions::Zero(Eigen::Index(columns["weight0"].size()), 3);
    for (int k = 0; k < 4; ++k)
        for (Eigen::Index v = 0; v < colours.rows(); ++v)
            colours.row(v) += columns.at("weight" + std::to_string(k)).at(std::size_t(v))
                * colour_of(int(columns.at("joint" + std::to_string(k)).at(std::size_t(v))));
    return colours;
}

ShownBone bone_between(const Json& ends, const Frame& frame)
{
    const auto place
        = [&](const Json& json) { return Vec3(frame.to_metres(Positions(vector_of(json).transpose())).row(0)); };
    return { place(ends.at("head")), place(ends.at("tail")) };
}

std::vector<ShownBone> bones_of(const Json& rig, const Frame& frame)
{
    std::vector<ShownBone> bones;
    for (const Json& bone : rig.at("bones")) {
        const int b = bone_of(bone.at("name").get<std::string>());
        bones.push_back(bone_between(bone, frame));
        bones.back().side = b < 0 || mirror_of(b) == b ? 0 : bone_name(b)[0] == 'l' ? 1 : 2;
    }
    return bones;
}

/// @param scores  of the covered bones, by their names
std::vector<ShownBone> fitted_bones(const Json& joints, const Json& scores, const Frame& frame)
{
    std::vector<ShownBone> bones;
    for (const auto& [name, ends] : joints.items()) {
        bones.push_back(bone_between(ends, frame));
        if (scores.contains(name))
            bones.back().value = 100 * scores.at(name).at("clearance").get<double>();
    }
    return bones;
}

std::vector<double> column_of(const fs::path& path, const std::string& name)
{
    for (VertexProperty& property : read_ply_properties(path))
        if (property.name == name)
            return std::move(property.values);
    throw InvalidInput(ErrorCode::missing_input,
                       path.string() + ": no property \"" + name + "\"; there are ease, strain and pressure");
}

struct Shown {
    std::string title;
    double factor;  // from the file's numbers
    bool both_ways;  // has values below zero
};

Shown shown_as(const std::string& map, double metres_per_unit)
{
    if (map == "ease")
        return { "ease, cm", 100 * metres_per_unit, false };
    if (map == "strain")
        return { "strain, %", 100, true };
    return { map + ", Pa", 1, false };
}

/// Ends at the 95th percentile of the values, so that a few large ones do not take all the colours.
Scale scale_of(const std::vector<Eigen::VectorXd>& values, const Shown& shown)
{
    std::vector<double> all;
    for (const Eigen::VectorXd& of_garment : values)
        for (const double value : of_garment)
            all.push_back(std::abs(value));
    std::sort(all.begin(), all.end());
    const double high = all.empty() ? 1 : std::max(all[all.size() * 19 / 20], 1e-9);
    return { shown.title, shown.both_ways ? -high : 0, high };
}

}  // namespace

State read_map(const fs::path& folder, const std::string& map)
{
    const Json rig = read_json(folder / "rig.json");
    const Frame frame = frame_of(rig);
    const Shown shown = shown_as(map, frame.metres_per_unit);
    State state { read_mesh(folder / "body.ply", frame), {}, frame.rotation() * vector_of(rig.at("front")) };
    for (const Json& garment : rig.at("garments")) {
        const fs::path path = (folder / "maps" / garment.at("file").get<std::string>()).replace_extension(".ply");
        state.garments.push_back(read_mesh(path, frame));
        const std::vector<double> column = column_of(path, map);
        state.values.push_back(shown.factor
                               * Eigen::Map<const Eigen::VectorXd>(column.data(), Eigen::Index(column.size())));
    }
    state.scale = scale_of(state.values, shown);
    return state;
}

bool is_rig_folder(const fs::path& folder) { return !read_json(folder / "rig.json").contains("garments"); }

State read_rig_folder(const fs::path& folder)
{
    const Json rig = read_json(folder / "rig.json");
    const Frame frame = frame_of(rig);
    return { read_mesh(folder / "rigged.ply", frame),
             {},
             frame.rotation() * vector_of(rig.at("front")),
             bones_of(rig, frame),
             colours_of(folder / "rigged.ply") };
}

bool is_fit_folder(const fs::path& folder)
{
    return !is_rig_folder(folder) && read_json(folder / "report.json").at("command") == "fit";
}

/// @param garments  of rig.json; without layers they are in order from the inside out
const Json& outermost(const Json& garments)
{
    const Json* result = &garments.at(0);
    for (const Json& garment : garments)
        if (garment.value("layer", 0) >= result->value("layer", 0))
            result = &garment;
    return *result;
}

std::vector<FittedGarment> read_fit_folder(const fs::path& folder)
{
    const Json rig = read_json(folder / "rig.json"), report = read_json(folder / "report.json");
    const Frame frame = frame_of(rig);
    std::vector<FittedGarment> fitted;
    for (std::size_t i = 0; i < rig.at("garments").size(); ++i) {
        const Json &garment = rig.at("garments").at(i), &score = report.at("garments").at(i).at("score");
        const std::string name = garment.at("file").get<std::string>();
        State state { {}, { read_mesh(folder / name, frame_of(garment)) }, fitted_front(rig, garment, frame) };
        state.bones = fitted_bones(garment.at("fitted"), score.at("bones"), frame);
        state.scale = { "clearance, %", 0, 100, true };
        fitted.push_back({ name, state, frame.metres_per_unit * score.at("before").get<double>(),
                           frame.metres_per_unit * score.at("after").get<double>() });
    }
    return fitted;
}

DressedFolder read_dressed_folder(const fs::path& folder)
{
    const Json rig = read_json(folder / "rig.json"), report = read_json(folder / "report.json");
    const Frame frame = frame_of(rig);
    const Vec3 front = frame.rotation() * vector_of(rig.at("front"));

    DressedFolder read;
    read.input = { read_mesh(folder / "rigged.ply", frame), {}, front };
    read.given.front = fitted_front(rig, outermost(rig.at("garments")), frame);
    for (const Json& garment : rig.at("garments"))
        read.given.garments.push_back(
            read_mesh(folder / "rest" / garment.at("file").get<std::string>(), frame_of(garment)));
    const bool whole_way = fs::exists(folder / "fitted");
    if (whole_way)
        read.fitted = read_state(folder / "fitted", frame, rig, read.given.front);
    read.dressed = read_state(folder, frame, rig, whole_way ? front : read.given.front);
    read.verdict = verdict_of(report, frame);
    return read;
}

}  // namespace garmentfit::picture
