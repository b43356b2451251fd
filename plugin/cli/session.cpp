// SPDX-License-Identifier: GPL-3.0-or-later
#include "session.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"
#include "garmentfit/filters/avatar_file.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/given_rig.h"
#include "garmentfit/filters/rig_file.h"
#include "garmentfit/filters/snapshot.h"
#include "garmentfit/filters/warnings.h"
#include "garmentfit/reconstruct.h"
#include "garmentfit/rig_body.h"
#include "garmentfit/skinned_gltf.h"
#include "garmentfit/stopwatch.h"

namespace garmentfit::cli {
namespace {

namespace fs = std::filesystem;

// ---- reading ---------------------------------------------------------------------------------------------------

FrameGuess known(const Frame& frame) { return { frame, 1, 1, "as written in rig.json" }; }

bool same(const Frame& a, const Frame& b)
{
    constexpr double k_rounding = 1e-12;  // unit: a scale was multiplied and divided
    return std::abs(a.metres_per_unit - b.metres_per_unit) <= k_rounding * b.metres_per_unit && a.up == b.up;
}

void warn_of_file(Session& session, const MeshFile& file)
{
    for (const std::string& warning : file.warnings())
        session.warnings.push_back(file.path().filename().string() + ": " + warning);
}

/// What the dressed garment will lack.
void warn_of_losses(Session& session, const MeshFile& file)
{
    const std::string name = file.path().filename().string();
    for (const std::string& loss : file.lost_companions())
        session.warnings.push_back(name + ": " + loss);
    for (const std::string& warning : warnings_about_left_behind(file))
        session.warnings.push_back(warning);
}

void make_scene_body(Session& session)
{
    put_body(session.scene, session.body.frame.frame, session.body.file.positions(), session.body.triangles);
    if (session.scene.body->repaired)
        session.warnings.push_back(session.body.path.filename().string()
                                   + " is not one closed surface; a repaired copy is used where one is needed");
}

void leave_out_others(Session& session, BodyFile& body, Wears wears)
{
    body.only_body = find_body(body.file, wears);
    if (!body.only_body)
        return;
    body.triangles = triangles_of(body.file, *body.only_body);
    for (const std::string& note : notes_on(*body.only_body))
        session.warnings.push_back(body.path.filename().string() + ": " + note);
}

bool is_gltf(const MeshFile& file) { return file.format() == "glb" || file.format() == "gltf"; }

/// FBX and COLLADA are read as if they were glTF; their axes and units are what their programs had.
bool is_own_gltf(const MeshFile& file) { return is_gltf(file) && file.written_name() == file.path().filename(); }

std::optional<Vec3> usual_up(const MeshFile& file)
{
    return is_own_gltf(file) ? std::optional<Vec3>(Vec3::UnitY()) : std::nullopt;
}

std::optional<double> usual_unit(const MeshFile& file) { return is_own_gltf(file) ? std::optional(1.0) : std::nullopt; }

OwnRig read_own_rig(const BodyFile& body)
{
    if (!is_gltf(body.file) || !has_skeleton(body.file.path()))
        return {};
    try {
        return { read_skinned_gltf(body.path), "" };
    } catch (const InvalidInput& error) {
        return { {}, error.what() };
    }
}

/// Dressed garments are written beside body.ply and the other results.
void require_own_name(const Session& session, const std::string& name)
{
    for (const char* taken : { k_body, k_pressed_body, "rigged.ply", "rigged.glb", "rig.json", "report.json", "fitted",
                               "frames", "maps", "rest" })
        if (name == taken)
            throw InvalidInput(ErrorCode::wrong_call,
                               name + ": a garment may not have the name of a result file; rename it");
    for (const GarmentFile& garment : session.garments)
        if (garment.name() == name)
            throw InvalidInput(ErrorCode::wrong_call,
                               name + ": two garments have this name, and results are named after them; rename one");
}

void add_garment_file(Session& session, GarmentFile garment, GarmentType type)
{
    require_own_name(session, garment.name());
    warn_of_file(session, garment.file);
    warn_of_losses(session, garment.file);
    const GarmentChoice choice = garment.choice.value_or(GarmentChoice());
    const Positions positions = garment.frame.frame.to_metres(garment.file.positions());
    session.scene.garments.push_back({ make_garment(positions, garment.file.triangles(), garment.file.corner_uvs()),
                                       type, garment.name(), front_of_garment(garment.frame.frame, choice.front),
                                       choice.as_placed });
    session.scene.garments.back().has_unit = garment.frame.frame.has_unit;
    session.scene.garments.back().size_in_unit = garment.frame.frame.size_in_unit;
    Frame unscaled = garment.frame.frame;
    unscaled.metres_per_unit /= choice.scale;
    if (!same(unscaled, session.body.frame.frame))
        session.warnings.push_back(
            garment.name() + " has other units or axes than the body; the dressed garment is written in the body's ("
            + garment.frame.why + ")");
    session.garments.push_back(std::move(garment));
}

/// The units and axes in which the mesh of a rig coincides with the body.
Frame frame_of_rig(const Session& session, const fs::path& glb)
{
    const Positions body = session.scene.body->surface.positions, mesh = MeshFile::read(glb).positions();
    if (const std::optional<Frame> frame = frame_on_body(mesh, body, session.body.frame.frame))
        return *frame;
    throw InvalidInput(ErrorCode::rig_mismatch,
                       glb.string() + ": its " + std::to_string(mesh.rows()) + " vertices do not lie where the "
                           + std::to_string(body.rows()) + " of " + session.body.path.string()
                           + " do; give the rig of this very mesh in its bind pose");
}

/// @param foreign  the rig in that file
Rig take_skinned(Session& session, const fs::path& glb, const ForeignRig& foreign)
{
    const Frame frame = frame_of_rig(session, glb);
    if (foreign.loose_vertices > 0)
        session.warnings.push_back(glb.filename().string() + ": " + std::to_string(foreign.loose_vertices)
                                   + " vertices hang on no joint; they follow the nearest vertex that does");
    if (foreign.unnormalized_vertices > 0)
        session.warnings.push_back(glb.filename().string() + ": the weights of "
                                   + std::to_string(foreign.unnormalized_vertices)
                                   + " vertices do not sum to 1, or are negative or no numbers; they are scaled to 1");
    const auto in_metres = [&](const Vec3& p) { return Vec3(frame.to_metres(Positions(p.transpose())).row(0)); };
    Rig rig { foreign.skeleton, foreign.weights };
    rig.skeleton.root = in_metres(rig.skeleton.root);
    std::transform(rig.skeleton.tails.begin(), rig.skeleton.tails.end(), rig.skeleton.tails.begin(), in_metres);
    std::transform(rig.skeleton.tips.begin(), rig.skeleton.tips.end(), rig.skeleton.tips.begin(), in_metres);
    rig.up = (rig.skeleton.tail(thorax) - rig.skeleton.root).normalized();
    rig.front = (rig.skeleton.tail(lhipjoint) - rig.skeleton.tail(rhipjoint)).cross(rig.up).normalized();
    rig.side_confidence = 1;
    return rig_on(std::move(rig), session.scene.body->surface.positions, glb.string());
}

void take_given(Session& session, Rig rig, const fs::path& path)
{
    for (const std::string& line :
         warnings_about_given_rig(rig, *session.scene.body, "the skeleton in " + path.filename().string()))
        session.warnings.push_back(line);
    session.scene.rig = std::move(rig);
    session.skeleton = "given";
}

/// Body, rig and fits as `fit` and `drape` write them; the garments as given are in `rest`.
void read_continued(Session& session, const fs::path& folder, const fs::path& rest)
{
    const RigFile contents = read_whole_rig(folder / "rig.json");
    session.scene.rig = contents.rig;
    session.body.path = folder / "rigged.ply";
    session.body.file = MeshFile::read(session.body.path);
    session.body.triangles = session.body.file.triangles();
    session.body.frame = known(contents.frame);
    make_scene_body(session);
    if (contents.garments.empty())
        throw InvalidInput(ErrorCode::missing_input,
                           (folder / "rig.json").string() + ": no garment; give a folder that garmentfit fit wrote");
    for (const FittedGarment& garment : contents.garments) {
        const fs::path path = rest / fs::path(garment.file).filename();
        add_garment_file(session, { path, MeshFile::read(path), known(garment.frame) }, garment.fit.type);
        session.scene.fits.push_back(garment.fit);
    }
}

/// Metres, of a mesh that draping writes where it reaches a certified state.
Positions read_left(const Session& session, const fs::path& path)
{
    if (!fs::exists(path))
        throw InvalidInput(ErrorCode::missing_input,
                           path.string() + ": missing, as draping ended without it; report.json beside it says why. "
                               + "Change garment or options, and drape again");
    return session.body.frame.frame.to_metres(MeshFile::read(path).positions());
}

Appearance look_of(Session& session, const std::filesystem::path& path, const MeshFile& file)
{
    Appearance look = file.appearance();
    for (const std::string& warning : look.warnings)
        session.warnings.push_back(path.filename().string() + ": " + warning);
    return look;
}

}  // namespace

std::vector<std::string> Session::garment_names() const
{
    std::vector<std::string> names;
    for (const GarmentFile& garment : garments)
        names.push_back(garment.name());
    return names;
}

void read_body(Session& session, const fs::path& path, const BodyChoice& choice, const BodyParts& parts)
{
    const Stopwatch watch(session.read_seconds);
    BodyFile body { path, parts.reconstruct ? MeshFile::read_points(path) : MeshFile::read(path), {}, {} };
    body.triangles = body.file.triangles();
    if (body.triangles.rows() == 0) {
        body.triangles = reconstruct_surface(body.file.positions());
        session.warnings.push_back(path.filename().string() + " is a point cloud; a surface was built from its "
                                   + std::to_string(body.file.positions().rows()) + " points");
    }
    warn_of_file(session, body.file);
    leave_out_others(session, body, parts.wears);
    body.own = read_own_rig(body);
    BodyChoice standing = choice;
    if (body.own.rig)
        standing.trunk = body.own.rig->skeleton.tail(thorax) - body.own.rig->skeleton.root;
    standing.usual_up = usual_up(body.file);
    body.frame = body_frame(body.file.positions(), body.triangles, standing);
    session.body = std::move(body);
    make_scene_body(session);
}

void add_garment(Session& session, const fs::path& path, GarmentType type, const GarmentChoice& choice)
{
    const Stopwatch watch(session.read_seconds);
    GarmentFile garment { path, MeshFile::read(path), {} };
    garment.choice = choice;
    garment.choice->usual_unit = usual_unit(garment.file);
    require_no_body(garment.file);
    try {
        garment.frame = garment_frame(garment.file.positions(), garment.file.triangles(), session.body.frame.frame,
                                      *garment.choice, stature_of(*session.scene.body), session.scene.body->surface);
    } catch (const InvalidInput& error) {
        throw InvalidInput(error.code(), garment.name() + ": " + error.what());
    }
    add_garment_file(session, std::move(garment), type);
}

bool read_rig(Session& session, const fs::path& rig)
{
    const Stopwatch watch(session.read_seconds);
    if (rig.extension() != ".json") {
        take_given(session, take_skinned(session, rig, read_skinned_gltf(rig)), rig);
        return true;
    }
    if (!fs::exists(rig.parent_path() / "rigged.ply") && !read_rig_file(rig).has_weights())
        return false;
    const RigFile contents = read_whole_rig(rig);
    if (!same(contents.frame, session.body.frame.frame))
        throw InvalidInput(ErrorCode::rig_mismatch,
                           rig.string() + ": other units or axes than those of " + session.body.path.string()
                               + "; give the same --unit, --up and --height as to garmentfit rig");
    take_given(session, rig_on(contents.rig, session.scene.body->surface.positions, rig.string()), rig);
    return true;
}

void read_own_skeleton(Session& session)
{
    const Stopwatch watch(session.read_seconds);
    session.skeleton_refusal = session.body.own.refusal;
    if (session.body.own.rig)
        try {
            const Rig rig = take_skinned(session, session.body.path, *session.body.own.rig);
            check_skeleton(*session.scene.body, rig.skeleton, rig.weights);
            session.scene.rig = rig;
            session.skeleton = "file";
        } catch (const InvalidInput& error) {
            session.skeleton_refusal = error.what();
        }
    if (!session.skeleton_refusal.empty())
        session.warnings.push_back("the skeleton in the body's file is not used, the shape decides: "
                                   + session.skeleton_refusal);
}

void read_fitted(Session& session, const fs::path& folder)
{
    const Stopwatch watch(session.read_seconds);
    read_continued(session, folder, folder);
}

void read_draped(Session& session, const fs::path& folder)
{
    const Stopwatch watch(session.read_seconds);
    if (!fs::is_directory(folder / "rest"))
        throw InvalidInput(ErrorCode::missing_input,
                           folder.string() + ": no folder rest in it; give a folder that garmentfit drape wrote");
    read_continued(session, folder, folder / "rest");

    std::vector<Positions> worn;
    for (const GarmentFile& garment : session.garments)
        worn.push_back(read_left(session, folder / garment.name()));
    session.scene.draped = dressing_from(session.scene, session.scene.fits[outermost(session.scene.fits)].pose,
                                         read_left(session, folder / k_body), worn, session.garment_names());
}

void read_body_look(Session& session)
{
    session.body.look = look_of(session, session.body.path, session.body.file);
    if (session.body.only_body)
        session.body.look = appearance_of(std::move(session.body.look), *session.body.only_body);
}

void read_garment_looks(Session& session)
{
    for (GarmentFile& garment : session.garments)
        garment.look = look_of(session, garment.path, garment.file);
}

}  // namespace garmentfit::cli
