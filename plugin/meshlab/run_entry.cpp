// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_entry.h"

#include <chrono>

#include "choice.h"
#include "garmentfit/certificate.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/outfit.h"
#include "garmentfit/filters/rig_file.h"
#include "garmentfit/fit_map.h"
#include "garmentfit/io.h"
#include "inputs.h"
#include "layers.h"
#include "results.h"

namespace garmentfit::meshlab {
namespace {

constexpr auto k_between_reports = std::chrono::milliseconds(100);  // unit: eyes see no more often

Positions in_layer(const Fitting& fitting, const Positions& in_metres)
{
    return as_kept(fitting.body_frame.to_file(in_metres));
}

/// @throws SolverFailure for a garment that is too small, or not certified in the digits of a layer.
void require_certified(Fitting& fitting)
{
    Scene& scene = fitting.scene;
    if (!scene.draped)
        return;
    Dressing& end = scene.recovered ? *scene.recovered : *scene.draped;
    std::vector<Positions> kept;
    for (const WornGarment& garment : end.garments)
        kept.push_back(fitting.body_frame.to_metres(in_layer(fitting, garment.positions)));
    certify_as_kept(end, scene.body->surface.triangles, kept);
    if (!end.certified)
        throw SolverFailure(explain(end, fitting.garment_names));
}

Report run_stages(const MenuEntry& entry, Choice& choice, MeshDocument& document, const Progress& progress)
{
    Report report;
    Fitting fitting = inputs_of(entry, choice, document, report);
    put_lengths_in_metres(entry, choice.parameters, fitting.body_frame.metres_per_unit);
    choice.parameters.rig.front = front_of_body(fitting.body_frame, choice.front);
    entry.filter->run(fitting.scene, choice.parameters, progress);
    require_certified(fitting);
    report_scene(report, fitting);

    add_results(document, choice, std::move(fitting), entry.filter->outputs);
    return report;
}

Report save_rig(const MenuEntry& entry, const Choice& choice, const MeshDocument& document)
{
    Report report;
    const Fitting fitting = inputs_of(entry, choice, document, report);
    write_rig_file(choice.file, rig_file_of(fitting));
    report.lines.push_back("wrote the rig of " + fitting.body_name + " and " + std::to_string(fitting.scene.fits.size())
                           + " fitted poses to " + choice.file.string());
    return report;
}

Report load_rig(const Choice& choice, MeshDocument& document)
{
    Report report;
    Fitting fitting = with_name(*choice.body, [&] { return fitting_from_file(choice.file, *choice.body, report); });
    report.lines.push_back("read the rig of " + fitting.body_name + " from " + choice.file.string());
    add_results(document, choice, std::move(fitting), { Data::rig });
    return report;
}

/// What a file says of the look of a layer that was opened from it and still has its triangles.
Appearance look_of_file(const std::filesystem::path& path, const Triangles& triangles, Report& report)
{
    if (path.empty() || !std::filesystem::exists(path))
        return {};
    try {
        const MeshFile file = MeshFile::read(path);
        if (file.triangles() != triangles) {
            report.lines.push_back(path.filename().string()
                                   + " has other triangles than its layer, so its UVs and textures are left out");
            return {};
        }
        const Appearance look = file.appearance();
        report.warn(look.warnings);
        return look;
    } catch (const InvalidInput& error) {  // MeshLab reads more formats
        report.lines.push_back("without UVs and textures of " + path.filename().string() + ": " + error.what());
        return {};
    }
}

/// The body's file, whose skeleton the outfit keeps. Where it has none, the log says so.
/// @throws InvalidInput where the user named a file that is not the body's.
std::optional<AvatarFile> avatar_of(const Choice& choice, const Fitting& fitting, Report& report)
{
    if (choice.outfit_bones)
        return {};
    const bool is_named = !choice.body_file.empty();
    const std::filesystem::path of_layer = choice.body->fullName().toStdString();
    const std::filesystem::path& file = is_named ? choice.body_file : of_layer;
    std::string why = "its layer was opened from no file";
    try {
        if (is_named || std::filesystem::exists(file)) {
            if (auto avatar = avatar_of_body(file, fitting.scene.body->surface.positions, fitting.body_frame))
                return avatar;
            why = file.filename().string() + " has no skin";
        }
    } catch (const InvalidInput& error) {
        if (is_named)
            throw;
        why = error.what();
    }
    (is_named ? report.warnings : report.lines)
        .push_back("the outfit of " + fitting.body_name + " has the joints of garmentfit: " + why
                   + ". Choose the avatar's glTF, GLB or VRM as Body file to keep its skeleton");
    return {};
}

Report save_outfit(const Choice& choice, const MeshDocument& document)
{
    const TriangleMesh body = mesh_of(*choice.body);
    const SharedFitting fitting = find_fitting(
        document, [&](const Fitting& one) { return one.scene.recovered.has_value() && one.is_of_body(body); });
    if (!fitting)
        throw InvalidInput(
            ErrorCode::missing_input,
            name_of(*choice.body)
                + " wears nothing in its own pose, or was changed since; run Garment Fitting: Dress Body "
                  "or Recover Pose first");
    Report report;
    std::vector<OutfitPart> garments;
    for (std::size_t i = 0; i < fitting->scene.garments.size(); ++i)
        garments.push_back(
            { fitting->garment_names[i],
              look_of_file(fitting->garment_files.at(i), fitting->scene.garments[i].mesh.triangles, report) });
    OutfitRequest request { choice.file, choice.outfit_bones, choice.hide_covered_skin,
                            avatar_of(choice, *fitting, report) };
    request.influences = choice.influences;
    OutfitPart wearer { fitting->body_name };
    if (!is_on_avatar(request))  // else its file is kept as it is
        wearer.look = look_of_file(choice.body->fullName().toStdString(), body.triangles, report);
    write_outfit(fitting->scene, wearer, garments, request);
    report.lines.push_back("wrote " + fitting->body_name + " and " + std::to_string(garments.size())
                           + (garments.size() == 1 ? " garment to " : " garments to ") + choice.file.string());
    return report;
}

/// @throws InvalidInput where the two layers are not the same garment.
WornGarment worn_garment(const Choice& choice, const Fitting& fitting, const TriangleMesh& body)
{
    const MeshModel& given = *choice.garments.front();
    const TriangleMesh rest = mesh_of(given), worn = mesh_of(*choice.worn);
    if (rest.positions.rows() != worn.positions.rows() || rest.triangles != worn.triangles)
        throw InvalidInput(ErrorCode::count_mismatch,
                           name_of(*choice.worn) + " has " + std::to_string(worn.positions.rows()) + " vertices, "
                               + name_of(given) + " has " + std::to_string(rest.positions.rows())
                               + "; choose the same garment as given and as worn");
    const Frame rest_frame = garment_frame(rest.positions, rest.triangles, fitting.body_frame, {},
                                           stature_of(*fitting.scene.body), fitting.scene.body->surface)
                                 .frame;
    const GarmentMesh garment
        = with_name(given, [&] { return make_garment(rest_frame.to_metres(rest.positions), rest.triangles); });
    const Positions positions = fitting.body_frame.to_metres(worn.positions);
    return { garment, positions, certify(body, garment, positions) };
}

Report measure(const MenuEntry& entry, Choice& choice, MeshDocument& document)
{
    Report report;
    Fitting fitting = inputs_of(entry, choice, document, report);
    put_lengths_in_metres(entry, choice.parameters, fitting.body_frame.metres_per_unit);
    const TriangleMesh& body = fitting.scene.body->surface;
    const Rig& rig = *fitting.scene.rig;
    const WornGarment worn = worn_garment(choice, fitting, body);
    const FitMap map = fit_map_on(*fitting.scene.body, body, worn, choice.parameters.drape.cloth);
    report_girths(report, girths(rig.skeleton, rig.weights, body, worn), fitting.body_frame.metres_per_unit);
    if (!worn.certificate.clean())
        report.warnings.push_back(name_of(*choice.worn) + " crosses the body or itself in "
                                  + std::to_string(worn.certificate.body_crossings + worn.certificate.self_crossings)
                                  + " places");
    add_measured(document, choice, std::move(fitting), map);
    return report;
}

}  // namespace

Report run_entry(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document,
                 const Progress& progress)
{
    Choice choice = read_choice(entry, list, document);
    switch (entry.task) {
    case Task::save_rig: return save_rig(entry, choice, document);
    case Task::load_rig: return load_rig(choice, document);
    case Task::save_outfit: return save_outfit(choice, document);
    case Task::measure: return measure(entry, choice, document);
    case Task::run_stages: break;
    }
    return run_stages(entry, choice, document, progress);
}

Progress progress_to(vcg::CallBackPos* callback)
{
    using Clock = std::chrono::steady_clock;
    if (!callback)
        return {};
    return Progress([callback, next = Clock::time_point()](double fraction, std::string_view stage) mutable {
        if (Clock::now() < next)
            return true;
        next = Clock::now() + k_between_reports;
        return callback(int(100 * fraction), std::string(stage).c_str());
    });
}

}  // namespace garmentfit::meshlab