// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_input.h"

#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/joint_names.h"
#include "garmentfit/filters/scene_arrays.h"
#include "garmentfit/filters/snapshot.h"
#include "garmentfit/filters/warnings.h"
#include "garmentfit/number_text.h"
#include "named_arrays.h"
#include "polydata.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

namespace garmentfit {
namespace {

FrameChoice frame_choice(const Hints& hints, const std::string& prefix)
{
    return { hints.choice(prefix + "Unit"), hints.choice(prefix + "Up") };
}

/// What the garment's own field data say comes before what the filter says of all garments.
GarmentChoice garment_choice(vtkPolyData& garment, const Hints& hints, const Parameters& parameters)
{
    GarmentChoice choice { frame_choice(hints, "Garment"), parameters.garment_sizes.scale, parameters.fit.as_placed,
                           hints.choice("GarmentFront") };
    vtkFieldData& own = *garment.GetFieldData();
    if (auto* front = vtkStringArray::SafeDownCast(own.GetAbstractArray("GarmentFront"));
        front && front->GetNumberOfValues() > 0)
        choice.front = front->GetValue(0);
    if (vtkDataArray* scale = own.GetArray("GarmentScale"); scale && scale->GetNumberOfTuples() > 0)
        choice.scale = scale->GetTuple1(0);
    if (vtkDataArray* placed = own.GetArray("GarmentAsPlaced"); placed && placed->GetNumberOfTuples() > 0)
        choice.as_placed = placed->GetTuple1(0) != 0;
    return choice;
}

/// Of a string `GarmentFabric` in the garment's own field data.
std::optional<Fabric> fabric_of_field(vtkPolyData& garment)
{
    auto* name = vtkStringArray::SafeDownCast(garment.GetFieldData()->GetAbstractArray("GarmentFabric"));
    if (!name || name->GetNumberOfValues() == 0)
        return {};
    return fabric_of(name->GetValue(0));
}

GivenJoints joints(const Hints& hints, const Frame& frame)
{
    GivenJoints given;
    for (const auto& [name, place] : hints.joints)
        joint_of(given, name) = frame.to_metres(Positions(place.transpose())).row(0);
    return given;
}

void set_body(KnownScene& known, const TriangleMesh& mesh)
{
    put_body(known.scene, known.body_frame, mesh.positions, mesh.triangles);
}

KnownScene unknown_body(const TriangleMesh& mesh, const Hints& hints, const BodySizes& sizes)
{
    KnownScene known;
    const FrameGuess guess = body_frame(mesh.positions, mesh.triangles, { frame_choice(hints, ""), sizes.height });
    known.body_frame = guess.frame;
    known.body_warnings = warnings_about_frame("the body", guess, "", set_by_name);
    set_body(known, mesh);
    return known;
}

KnownScene rigged_body(const Filter& filter, vtkPolyData& body)
{
    const FindArray find = find_in(body);
    KnownScene known;
    known.body_frame = body_frame_from(find);
    set_body(known, mesh_at(body, k_input_position, "the body"));
    known.scene.rig = rig_from(find, known.scene.body->surface.positions);
    known.body_warnings = warnings_about_given_rig(*known.scene.rig, *known.scene.body, "the skeleton of the body");
    if (filter.reads(Data::fits) || (filter.reads(Data::draped) && find("FitPoses")))
        known.scene.fits = fits_from(find);
    return known;
}

std::string called(const std::vector<std::string>& names, std::size_t i)
{
    return names.size() == 1 ? "the garment" : "garment " + std::to_string(i + 1) + " (" + names[i] + ")";
}

/// @param seen  by an earlier filter, which kept the rest positions and the frame as arrays
void add_garment(KnownScene& known, vtkPolyData& garment, bool seen, const GarmentChoice& choice)
{
    const std::string name = called(known.garment_names, known.scene.garments.size());
    const TriangleMesh mesh = seen ? mesh_at(garment, k_rest_position, name) : mesh_of(garment, name);
    std::optional<Frame> frame;
    if (seen)
        frame = garment_frame_from(find_in(garment));
    if (!frame) {
        const FrameGuess guess
            = garment_frame(mesh.positions, mesh.triangles, known.body_frame, choice, stature_of(*known.scene.body));
        frame = guess.frame;
        for (const std::string& line : warnings_about_frame(name, guess, "garment_", set_by_name))
            known.garment_frame_warnings.push_back(line);
    }
    known.garment_frames.push_back(*frame);
    known.scene.garments.push_back({ .mesh = make_garment(frame->to_metres(mesh.positions), mesh.triangles,
                                                          corner_uvs_of(garment, mesh.triangles)),
                                     .type = given_type(garment),
                                     .front = front_of_garment(*frame, choice.front),
                                     .as_placed = choice.as_placed,
                                     .fabric = fabric_of_field(garment),
                                     .has_unit = frame->has_unit,
                                     .size_in_unit = frame->size_in_unit });
}

}  // namespace

std::string Hints::choice(const std::string& what) const
{
    const auto found = choices.find(what);
    return found == choices.end() ? "auto" : found->second;
}

std::string Hints::on_body() const
{
    std::string text = choice("Unit") + ' ' + choice("Up") + ' ' + choice("Front");
    for (const auto& [name, place] : joints)
        text += ' ' + name + ' ' + text_of(place);
    return text;
}

std::string Hints::on_garments() const
{
    return choice("GarmentUnit") + ' ' + choice("GarmentUp") + ' ' + choice("GarmentFront");
}

KnownScene scene_of_body(const Filter& filter, vtkPolyData& body, const Hints& hints, Parameters& parameters)
{
    if (filter.reads(Data::rig))
        return rigged_body(filter, body);
    KnownScene known = unknown_body(mesh_of(body, "the body"), hints, parameters.body_sizes);
    parameters.rig.front = front_of_body(known.body_frame, hints.choice("Front"));
    parameters.rig.joints = joints(hints, known.body_frame);
    return known;
}

void read_garments(KnownScene& known, const Filter& filter, vtkDataObject& garments, const Hints& hints,
                   const Parameters& parameters)
{
    known.scene.garments.clear();
    known.garment_frames.clear();
    known.garment_frame_warnings.clear();
    known.garment_names = garment_names_in(garments);
    const bool seen = filter.reads(Data::fits) || filter.reads(Data::draped);
    for (vtkPolyData* garment : garments_in(garments))
        add_garment(known, *garment, seen, garment_choice(*garment, hints, parameters));
}

void read_worn(KnownScene& known, vtkPolyData& body, vtkDataObject& garments)
{
    std::vector<Positions> worn;
    for (vtkPolyData* garment : garments_in(garments))
        worn.push_back(
            known.body_frame.to_metres(mesh_of(*garment, called(known.garment_names, worn.size())).positions));
    const Positions left = known.body_frame.to_metres(mesh_of(body, "the body").positions);
    known.scene.draped = dressing_from(known.scene, dressed_pose_from(find_in(body)), left, worn, known.garment_names);
}

KnownScene scene_of_dressed(vtkPolyData& body, vtkDataObject& garments)
{
    const Filter& reads_all = filter_of("recover");
    Parameters usual;
    KnownScene known = scene_of_body(reads_all, body, {}, usual);
    read_garments(known, reads_all, garments, {}, usual);
    read_worn(known, body, garments);
    return known;
}

}  // namespace garmentfit
