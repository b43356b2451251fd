// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

#include "garmentfit/filters/animation.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/rig_file.h"
#include "garmentfit/filters/warnings.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"

namespace garmentfit::cli {
namespace {

namespace fs = std::filesystem;

// ---- writing ---------------------------------------------------------------------------------------------------

void write_rigged(const Session& session, const fs::path& path)
{
    const SkinWeights& weights = session.scene.rig->weights;
    std::vector<VertexProperty> properties;
    for (int k = 0; k < 4; ++k) {
        const Eigen::VectorXd bones = weights.bones.col(k).cast<double>(), values = weights.weights.col(k);
        properties.push_back({ "joint" + std::to_string(k), { bones.begin(), bones.end() }, true });
        properties.push_back({ "weight" + std::to_string(k), { values.begin(), values.end() }, false });
    }
    write_ply(path, session.body.file.positions(), session.body.triangles, properties,
              { "garmentfit: the body in its input pose, joint0..3 are rows of bones in rig.json" });
}

RigFile rig_file_of(const Session& session)
{
    RigFile contents { session.body.frame.frame, *session.scene.rig, {} };
    contents.rig.weights = {};  // they are in rigged.ply
    for (std::size_t i = 0; i < session.scene.fits.size(); ++i)
        contents.garments.push_back(
            { session.garments[i].name(), session.garments[i].frame.frame, session.scene.fits[i] });
    return contents;
}

std::vector<std::string> comments_of(const Dressing& dressing)
{
    if (dressing.certified)
        return { "garmentfit: certified" };
    std::ostringstream text;
    text << "garmentfit: NOT certified; last certified state, body at ";
    if (dressing.scale_reached < 1)
        text << percent(dressing.scale_reached) << "% of its size";
    else if (dressing.pose_reached < 1)
        text << percent(dressing.pose_reached) << "% of the path between two poses";
    else
        text << "its pose, but for parts that cloth holds back";
    return { text.str() };
}

/// The numbers of the input file where the body is as in the input.
Positions body_in_file(const Session& session, const Positions& in_metres)
{
    const Positions &given = session.scene.body->surface.positions, &numbers = session.body.file.positions();
    Positions result = session.body.frame.frame.to_file(in_metres);
    for (Eigen::Index v = 0; v < result.rows(); ++v)
        if (in_metres.row(v) == given.row(v))
            result.row(v) = numbers.row(v);
    return result;
}

void write_garments(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    fs::create_directories(folder);
    for (const std::size_t i : dressing.worn())
        session.garments[i].file.write_with_companions(
            folder / session.garments[i].name(), session.body.frame.frame.to_file(dressing.garments[i].positions));
}

void write_body(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    const auto write = [&](const char* name, const Positions& in_file, const std::vector<std::string>& comments) {
        write_ply(folder / name, in_file, session.body.triangles, {}, comments);
    };
    const bool pressed = is_pressed(dressing);
    write(pressed ? k_pressed_body : k_body, body_in_file(session, dressing.body), comments_of(dressing));
    if (pressed)
        write(k_body, session.body.file.positions(),
              { std::string("garmentfit: as given; the garments are certified on ") + k_pressed_body });
}

/// A file may hold fewer digits than the computation had, so the file is judged.
void certify_as_written(const Session& session, Dressing& dressing, const fs::path& folder)
{
    std::vector<Positions> written(session.garments.size());
    for (const std::size_t i : dressing.worn())
        written[i]
            = session.body.frame.frame.to_metres(MeshFile::read(folder / session.garments[i].name()).positions());
    certify_as_kept(dressing, session.scene.body->surface.triangles, written);
}

/// Ease in the unit of the file, strain, and pressure in pascal at each vertex of a dressed garment.
void write_maps(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    fs::create_directories(folder);
    const Frame& frame = session.body.frame.frame;
    const auto values = [](const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
    for (const std::size_t i : dressing.worn()) {
        const FitMap& map = dressing.maps[i];
        const std::string name = session.garments[i].name();
        write_ply((folder / name).replace_extension(".ply"), frame.to_file(dressing.garments[i].positions),
                  session.scene.garments[i].mesh.triangles,
                  { { "ease", values(map.ease / frame.metres_per_unit) },
                    { "strain", values(map.strain) },
                    { "pressure", values(map.pressure) } },
                  { "garmentfit: how " + name + " sits: ease in its unit, strain, pressure in Pa" });
    }
}

std::string numbered(const std::string& stem, std::size_t frame)
{
    std::ostringstream name;
    name << stem << '_' << std::setw(3) << std::setfill('0') << frame << ".ply";
    return name.str();
}

/// A series of PLY files for each mesh, and all of them as one animation.
void write_frames(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    if (dressing.frames.empty())
        return;
    fs::create_directories(folder);
    const Frame& frame = session.body.frame.frame;
    const std::vector<std::size_t> worn = dressing.worn();
    std::vector<std::string> names;
    for (const GarmentFile& garment : session.garments)
        names.push_back(garment.path.stem().string());
    for (std::size_t f = 0; f < dressing.frames.size(); ++f) {
        const RecoverFrame& state = dressing.frames[f];
        write_ply(folder / numbered("body", f), frame.to_file(state.body), session.body.triangles);
        for (const std::size_t i : worn)
            write_ply(folder / numbered(names[i], f), frame.to_file(state.garments[i]),
                      session.scene.garments[i].mesh.triangles);
    }
    write_animation(session.scene, dressing, names, folder / "animation.glb");
}

/// Only certified garments stay.
void write_last_state(const Session& session, Dressing& dressing, const fs::path& folder)
{
    if (!all_clean(dressing.garments))
        return;
    write_garments(session, dressing, folder);
    certify_as_written(session, dressing, folder);
    if (all_clean(dressing.garments)) {
        write_body(session, dressing, folder);
        write_maps(session, dressing, folder / "maps");
        write_frames(session, dressing, folder / "frames");
    } else
        for (const std::size_t i : dressing.worn())
            fs::remove(folder / session.garments[i].name());
}

/// The rest shapes: as given, or as large as they were made to be put on.
void write_rest_shapes(const Session& session, const fs::path& folder)
{
    fs::create_directories(folder);
    const std::optional<Dressing>& draped = session.scene.draped;
    for (std::size_t i = 0; i < session.garments.size(); ++i) {
        const GarmentFile& garment = session.garments[i];
        const double size = draped && draped->is_worn(i) ? draped->garments[i].size : 1;
        garment.file.write_with_companions(folder / garment.name(), size * garment.file.positions());
    }
}

void write_fitted_body(const Session& session, const fs::path& folder)
{
    const Rig& rig = *session.scene.rig;
    const std::size_t outer = outermost(session.scene.fits);
    const Pose& pose = session.scene.fits[outer].pose;
    const Positions fitted
        = skin(session.scene.body->surface.positions, rig.weights, bone_transforms(rig.skeleton, pose));
    write_ply(folder / k_body, session.body.frame.frame.to_file(fitted), session.body.triangles, {},
              { "garmentfit: the body in the pose fitted to " + session.garments[outer].name() });
}

// ---- what earlier runs wrote ---------------------------------------------------------------------------------------

bool is_result(const fs::path& folder)
{
    std::ifstream file(folder / "report.json");
    const auto report = nlohmann::json::parse(file, nullptr, false);
    return report.is_object() && report.contains("command") && report.contains("stages");
}

bool was_read(const Session& session, const fs::path& path)
{
    std::error_code none;
    const auto is = [&](const fs::path& input) { return fs::equivalent(input, path, none); };
    return is(session.body.path)
        || std::any_of(session.garments.begin(), session.garments.end(), [&](const auto& g) { return is(g.path); });
}

// ---- warnings ----------------------------------------------------------------------------------------------------

/// "give --swap-sides" for "swap_sides".
std::string give_flag(std::string_view parameter)
{
    std::string flag(parameter);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return "give --" + flag;
}

}  // namespace

void add_warnings(Session& session)
{
    const auto add = [&](const std::vector<std::string>& warnings) {
        session.warnings.insert(session.warnings.end(), warnings.begin(), warnings.end());
    };
    add(warnings_about_frame(session.body.path.filename().string(), session.body.frame, "", give_flag));
    for (const GarmentFile& garment : session.garments)
        add(warnings_about_frame(garment.name(), garment.frame, "garment_", give_flag));
    add(warnings_about_scene(session.scene, session.garment_names(), give_flag));
}

std::vector<std::string> outdated_results(const Session& session, std::string_view command, const fs::path& folder)
{
    if (command == "rig" || command == "fit" || !is_result(folder))
        return {};  // those two write all their results, or nothing
    std::vector<std::string> names { k_body, k_pressed_body, "maps" };
    if (command != "drape")
        names.emplace_back("frames");
    if (command == "dress")
        names.emplace_back("fitted");
    for (const GarmentFile& garment : session.garments)
        names.push_back(garment.name());
    names.erase(std::remove_if(names.begin(), names.end(),
                               [&](const std::string& name) { return was_read(session, folder / name); }),
                names.end());
    return names;
}

void write_results(Session& session, std::string_view command, const fs::path& folder)
{
    Scene& scene = session.scene;
    write_rig_file(folder / "rig.json", rig_file_of(session));
    write_rigged(session, folder / "rigged.ply");
    if (command == "rig")
        write_skinned_glb(folder / "rigged.glb", scene.body->surface, *scene.rig);
    if (command == "fit") {
        write_rest_shapes(session, folder);
        write_fitted_body(session, folder);
    }
    if (command == "dress" || command == "drape")
        write_rest_shapes(session, folder / "rest");
    if (command == "dress" && scene.recovered && all_clean(scene.draped->garments)) {
        write_garments(session, *scene.draped, folder / "fitted");
        write_body(session, *scene.draped, folder / "fitted");
    }
    if (scene.recovered)
        write_last_state(session, *scene.recovered, folder);
    else if (scene.draped)
        write_last_state(session, *scene.draped, folder);
}

void write_outfit(const Session& session, const OutfitRequest& request)
{
    std::vector<OutfitPart> garments;
    for (const GarmentFile& garment : session.garments)
        garments.push_back({ garment.path.stem().string(), garment.look });
    write_outfit(session.scene, { "body", session.body.look }, garments, request);
}

}  // namespace garmentfit::cli
