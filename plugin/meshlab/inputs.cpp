// SPDX-License-Identifier: GPL-3.0-or-later
#include "inputs.h"

#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/frame_choice.h"
#include "garmentfit/filters/warnings.h"
#include "layers.h"

namespace garmentfit::meshlab {
namespace {

Fitting new_fitting(const Choice& choice, Report& report)
{
    const TriangleMesh mesh = mesh_of(*choice.body);
    if (mesh.triangles.rows() == 0)
        throw InvalidInput(ErrorCode::no_faces, name_of(*choice.body) + " has no faces; choose the layer of the body");
    Fitting fitting;
    fitting.body_name = name_of(*choice.body);
    with_name(*choice.body, [&] {
        const BodyChoice body { choice.body_frame, choice.parameters.body_sizes.height };
        const FrameGuess guess = body_frame(mesh.positions, mesh.triangles, body);
        fitting.body_frame = guess.frame;
        put_body(fitting.scene, guess.frame, mesh.positions, mesh.triangles);
        report.lines.push_back(fitting.body_name + ": " + guess.why);
        report.warn(warnings_about_frame(fitting.body_name, guess, "", set_by_name));
    });
    if (fitting.scene.body->repaired)
        report.warnings.push_back(fitting.body_name
                                  + " is not one closed surface; the skeleton was found on a repaired copy");
    return fitting;
}

GarmentInput input_of(const MeshModel& layer, const Frame& frame, GarmentType type, const std::optional<Fabric>& fabric)
{
    const TriangleMesh mesh = mesh_of(layer);
    GarmentInput input { make_garment(frame.to_metres(mesh.positions), mesh.triangles, corner_uvs_of(layer)), type };
    input.fabric = fabric;
    input.has_unit = frame.has_unit;
    input.size_in_unit = frame.size_in_unit;
    return input;
}

/// Replaces the garments of the scene and drops the results on earlier ones.
void put_on_garments(Fitting& fitting, const Choice& choice, Report& report)
{
    Scene scene;
    scene.unit = fitting.scene.unit;
    scene.body = std::move(fitting.scene.body);
    scene.rig = std::move(fitting.scene.rig);
    fitting.garment_names.clear();
    fitting.garment_frames.clear();
    fitting.garment_files.clear();
    for (std::size_t i = 0; i < choice.garments.size(); ++i)
        with_name(*choice.garments[i], [&] {
            const TriangleMesh mesh = mesh_of(*choice.garments[i]);
            const GarmentChoice garment { choice.garment_frame, choice.parameters.garment_sizes.scale,
                                          choice.parameters.fit.as_placed, choice.garment_fronts[i] };
            const FrameGuess guess = garment_frame(mesh.positions, mesh.triangles, fitting.body_frame, garment,
                                                   stature_of(*scene.body), scene.body->surface);
            scene.garments.push_back(input_of(*choice.garments[i], guess.frame, choice.types[i], choice.fabrics[i]));
            scene.garments.back().front = front_of_garment(guess.frame, garment.front);
            fitting.garment_names.push_back(name_of(*choice.garments[i]));
            fitting.garment_frames.push_back(guess.frame);
            fitting.garment_files.push_back(choice.garments[i]->fullName().toStdString());
            report.warn(warnings_about_frame(fitting.garment_names.back(), guess, "garment_", set_by_name));
        });
    fitting.scene = std::move(scene);
}

/// The garments whose fits a rig file holds. @throws InvalidInput unless they are the chosen ones.
void put_on_fitted_garments(Fitting& fitting, const Choice& choice)
{
    std::vector<std::string> names;
    for (const MeshModel* garment : choice.garments)
        names.push_back(name_of(*garment));
    if (names != fitting.garment_names)
        throw InvalidInput(ErrorCode::missing_input,
                           fitting.body_name + " was not fitted into " + names.front()
                               + "; run Garment Fitting: Fit Skeleton with the same garments first");
    for (std::size_t i = 0; i < choice.garments.size(); ++i) {
        fitting.garment_files.push_back(choice.garments[i]->fullName().toStdString());
        fitting.scene.garments.push_back(with_name(*choice.garments[i], [&] {
            return input_of(*choice.garments[i], fitting.garment_frames[i], fitting.scene.fits[i].type,
                            choice.fabrics[i]);
        }));
    }
}

/// The newest fitting in the document that has all inputs of the filter, else the newest of the body, else the file
/// beside the body.
Fitting known_fitting(const MenuEntry& entry, const Choice& choice, const MeshDocument& document, Report& report)
{
    const TriangleMesh body = mesh_of(*choice.body);
    const std::vector<TriangleMesh> garments = meshes_of(choice.garments);
    const auto is_of_body = [&](const Fitting& fitting) { return fitting.is_of_body(body); };
    const auto has_inputs = [&](const Fitting& fitting) {
        return is_of_body(fitting) && (fitting.is_of_garments(garments) || !entry.reads(Data::garments))
            && (fitting.scene.draped || !entry.reads(Data::draped));
    };
    if (const SharedFitting found = find_fitting(document, has_inputs))
        return *found;
    if (const SharedFitting found = find_fitting(document, is_of_body))
        return *found;
    const std::filesystem::path file = rig_file_beside(*choice.body);
    if (!file.empty() && std::filesystem::exists(file))
        return fitting_from_file(file, *choice.body, report);
    throw InvalidInput(
        ErrorCode::missing_input,
        name_of(*choice.body)
            + " has no rig, or was changed after rigging; run Garment Fitting: Rig Body or Load Rig first");
}

}  // namespace

Fitting fitting_from_file(const std::filesystem::path& file, const MeshModel& body, Report& report)
{
    const Fitting fitting = fitting_from_file(file, name_of(body), mesh_of(body));
    report.warn(warnings_about_given_rig(*fitting.scene.rig, *fitting.scene.body,
                                         "the skeleton in " + file.filename().string()));
    return fitting;
}

Fitting inputs_of(const MenuEntry& entry, const Choice& choice, const MeshDocument& document, Report& report)
{
    Fitting fitting
        = entry.begins_with_body() ? new_fitting(choice, report) : known_fitting(entry, choice, document, report);
    if (!entry.filter || !entry.reads(Data::garments))
        return fitting;
    if (entry.filter->has(Stage::fit))
        put_on_garments(fitting, choice, report);
    else if (fitting.scene.garments.empty())
        put_on_fitted_garments(fitting, choice);
    else if (!fitting.is_of_garments(meshes_of(choice.garments)))
        throw InvalidInput(
            ErrorCode::missing_input,
            fitting.body_name + " was not fitted into " + name_of(*choice.garments.front())
                + ", or the garment was changed after fitting; run Garment Fitting: Fit Skeleton with the "
                  "same garments first");
    return fitting;
}

}  // namespace garmentfit::meshlab
