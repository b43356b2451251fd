// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "filters/outcome.h"
#include "filters/rig_file.h"
#include "fit/animated_gltf.h"
#include "fit/io.h"
#include "fit/skinned_gltf.h"

namespace fit::cli {
namespace {

namespace fs = std::filesystem;

constexpr double k_doubt = 0.2;  // guesses with a smaller margin (0 a toss-up, 1 sure) are worth a warning

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
              { "garmentfit: the body in its own pose, joint0..3 are rows of bones in rig.json" });
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
    if (dressing.size_reached < 1)
        text << percent(dressing.size_reached) << "% of its size";
    else
        text << percent(dressing.pose_reached) << "% of the way between two poses";
    return { text.str() };
}

/// The user's own numbers where the body is where it was.
Positions body_in_file(const Session& session, const Positions& in_metres)
{
    return in_metres == session.scene.body->surface.positions ? session.body.file.positions()
                                                              : session.body.frame.frame.to_file(in_metres);
}

void write_garments(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    fs::create_directories(folder);
    for (std::size_t i = 0; i < dressing.garments.size(); ++i)
        session.garments[i].file.write(folder / session.garments[i].name(),
                                       session.body.frame.frame.to_file(dressing.garments[i].positions));
}

void write_body(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    write_ply(folder / "body.ply", body_in_file(session, dressing.body), session.body.triangles, {},
              comments_of(dressing));
}

/// A file may hold fewer digits than we computed with, so what stands in it is what is judged.
void certify_as_written(const Session& session, Dressing& dressing, const fs::path& folder)
{
    std::vector<Positions> written;
    for (std::size_t i = 0; i < dressing.garments.size(); ++i)
        written.push_back(
            session.body.frame.frame.to_metres(MeshFile::read(folder / session.garments[i].name()).positions()));
    certify_as_kept(dressing, session.scene.body->surface.triangles, written);
}

/// Ease in the file's own unit, strain, and pressure in pascal at each vertex of a dressed garment.
void write_maps(const Session& session, const Dressing& dressing, const fs::path& folder)
{
    fs::create_directories(folder);
    const Frame& frame = session.body.frame.frame;
    const auto values = [](const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
    for (std::size_t i = 0; i < dressing.garments.size(); ++i) {
        const FitMap& map = dressing.maps[i];
        const std::string name = session.garments[i].name();
        write_ply((folder / name).replace_extension(".ply"), frame.to_file(dressing.garments[i].positions),
                  dressing.garments[i].rest.triangles,
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
    constexpr double k_seconds = 3;  // that the way takes in the animation
    if (dressing.frames.empty())
        return;
    fs::create_directories(folder);
    const Frame& frame = session.body.frame.frame;
    std::vector<MovingMesh> meshes { { "body", session.body.triangles, {}, { 0.55, 0.35, 0.25 } } };
    for (std::size_t i = 0; i < dressing.garments.size(); ++i)
        meshes.push_back({ session.garments[i].path.stem().string(),
                           dressing.garments[i].rest.triangles,
                           {},
                           { 0.1, 0.3 / double(i + 1), 0.5 } });
    for (const RecoverFrame& state : dressing.frames)
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            meshes[m].frames.push_back(m == 0 ? state.body : state.garments[m - 1]);
            write_ply(folder / numbered(meshes[m].name, meshes[m].frames.size() - 1),
                      frame.to_file(meshes[m].frames.back()), meshes[m].triangles);
        }
    write_animated_glb(folder / "animation.glb", meshes, k_seconds / double(dressing.frames.size()));
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
        for (std::size_t i = 0; i < dressing.garments.size(); ++i)
            fs::remove(folder / session.garments[i].name());
}

/// The rest shapes: as given, or as large as they were made to be put on.
void write_rest_shapes(const Session& session, const fs::path& folder)
{
    fs::create_directories(folder);
    const std::optional<Dressing>& draped = session.scene.draped;
    for (std::size_t i = 0; i < session.garments.size(); ++i) {
        const GarmentFile& garment = session.garments[i];
        const double size = draped && i < draped->garments.size() ? draped->garments[i].size : 1;
        garment.file.write(folder / garment.name(), size * garment.file.positions());
    }
}

void write_fitted_body(const Session& session, const fs::path& folder)
{
    const Rig& rig = *session.scene.rig;
    const Pose& pose = session.scene.fits.back().pose;
    const Positions fitted
        = skin(session.scene.body->surface.positions, rig.weights, bone_transforms(rig.skeleton, pose));
    write_ply(folder / "body.ply", session.body.frame.frame.to_file(fitted), session.body.triangles, {},
              { "garmentfit: the body in the pose fitted to " + session.garments.back().name() });
}

// ---- doubts ----------------------------------------------------------------------------------------------------

void doubt_frame(std::vector<std::string>& warnings, const std::string& file, const FrameGuess& guess,
                 const std::string& flags)
{
    if (guess.unit_margin < k_doubt)
        warnings.push_back("the unit of " + file + " is hardly more than a guess (" + guess.why + "); give --" + flags
                           + "unit");
    if (guess.up_margin < k_doubt)
        warnings.push_back("the up axis of " + file + " is hardly more than a guess (" + guess.why + "); give --"
                           + flags + "up");
}

}  // namespace

void add_doubts(Session& session)
{
    const Scene& scene = session.scene;
    for (std::string& line : explain(scene.conflicts, session.garment_names()))
        session.warnings.push_back(std::move(line));
    doubt_frame(session.warnings, session.body.path.filename().string(), session.body.frame, "");
    if (scene.rig && scene.rig->side_margin < k_doubt)
        session.warnings.emplace_back(
            "left and right of the body are hardly more than a guess; look, and give --swap-sides");
    if (const Dressing* end = final_dressing(scene); end && end->speed >= k_at_rest)
        session.warnings.push_back("the cloth is not at rest yet (" + std::to_string(std::lround(1000 * end->speed))
                                   + " mm/s); give more settling steps");
    for (std::size_t i = 0; i < session.garments.size(); ++i) {
        const std::string name = session.garments[i].name();
        doubt_frame(session.warnings, name, session.garments[i].frame, "garment-");
        if (i < scene.fits.size() && scene.fits[i].type_margin < k_doubt)
            session.warnings.push_back("the type of " + name + " is hardly more than a guess, "
                                       + std::string(name_of(scene.fits[i].type)) + "; give --type");
        if (const Dressing* end = final_dressing(scene); end && i < end->garments.size() && end->garments[i].size > 1)
            session.warnings.push_back(name + " was made "
                                       + std::to_string(std::lround(100 * (end->garments[i].size - 1))) + "% larger");
        if (const Dressing* end = final_dressing(scene); end && i >= end->garments.size())
            session.warnings.push_back(name + " was not put on, for what is under it was not certified");
    }
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
    if (command == "dress" && scene.recovered) {
        write_garments(session, *scene.draped, folder / "fitted");
        write_body(session, *scene.draped, folder / "fitted");
    }
    if (scene.recovered)
        write_last_state(session, *scene.recovered, folder);
    else if (scene.draped)
        write_last_state(session, *scene.draped, folder);
}

}  // namespace fit::cli
