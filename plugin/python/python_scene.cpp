// SPDX-License-Identifier: GPL-3.0-or-later
#include "python_scene.h"

#include <nanobind/stl/string.h>

#include "garmentfit/error.h"
#include "garmentfit/filters/animation.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/frame_choice.h"
#include "garmentfit/filters/joint_names.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/outfit.h"
#include "garmentfit/filters/snapshot.h"
#include "garmentfit/filters/warnings.h"

namespace garmentfit::python {
namespace {

std::string text_of(const nb::handle& value)
{
    if (nb::isinstance<nb::bool_>(value))
        return nb::cast<bool>(value) ? "on" : "off";
    return nb::str(value).c_str();
}

/// Whether a parameter may be None.
bool may_be_none(const Filter& filter, const std::string& name)
{
    bool may_be = false;
    const Parameters defaults;
    describe(filter, defaults, [&](const auto& value, const About& about) {
        may_be = may_be || (about.name == name && is_optional<decltype(value)>);
    });
    return may_be;
}

/// @throws InvalidInput naming the parameter.
void set_parameter(const Filter& filter, Parameters& parameters, const std::string& name, const nb::handle& value)
{
    if (value.is_none() && may_be_none(filter, name))
        return;
    SetByName set { name, text_of(value) };
    describe(filter, parameters, set);
    if (set.found)
        return;
    std::string names;
    describe(filter, parameters,
             [&](const auto&, const About& about) { names += (names.empty() ? "" : ", ") + std::string(about.name); });
    throw InvalidInput(ErrorCode::unknown_name,
                       std::string(filter.name) + " has no parameter called \"" + name + "\"; there are " + names);
}

Parameters parameters_from(const Filter& filter, const nb::dict& given)
{
    Parameters parameters;
    for (const auto& [name, value] : given)
        set_parameter(filter, parameters, nb::cast<std::string>(name), value);
    return parameters;
}

/// Those of some names, where they are given.
Parameters parameters_of(const Filter& filter, const nb::dict& given, std::initializer_list<const char*> names)
{
    Parameters parameters;
    for (const char* name : names)
        if (given.contains(name))
            set_parameter(filter, parameters, name, given[name]);
    return parameters;
}

/// The value as a Python object; choices by their names.
template <class Value>
nb::object object_of(const Value& value, const About& about)
{
    if constexpr (is_optional<Value>)
        return value ? nb::object(nb::cast(*value)) : nb::object(nb::none());
    else if constexpr (std::is_enum_v<Value>)
        return nb::str(garmentfit::text_of(value, about).c_str());
    else
        return nb::cast(value);
}

/// The Python annotation: "float", "Literal['cotton', 'denim']".
template <class Value>
std::string type_of(const About& about)
{
    if constexpr (is_optional<Value>)
        return type_of<typename Value::value_type>(about) + " | None";
    else if constexpr (std::is_same_v<Value, bool>)
        return "bool";
    else if constexpr (std::is_integral_v<Value>)
        return "int";
    else if constexpr (std::is_floating_point_v<Value>)
        return "float";
    std::string words;
    if (about.choices)
        for (const std::string_view word : *about.choices)
            words += (words.empty() ? "'" : ", '") + std::string(word) + "'";
    return "Literal[" + words + "]";
}

Positions as_positions(const std::vector<double>& place, const std::string& joint)
{
    if (place.size() != 3)
        throw InvalidInput(ErrorCode::wrong_call,
                           "joint " + joint + " has " + std::to_string(place.size()) + " coordinates; give x, y, z");
    return Eigen::Map<const Positions>(place.data(), 1, 3);
}

/// Repairs may take seconds: other Python threads run meanwhile.
void put_body_in(PythonScene& made, const Positions& in_file, const Triangles& triangles)
{
    const nb::gil_scoped_release other_threads_run;
    put_body(made.scene, made.body_frame, in_file, triangles);
}

/// Reports to Python. Stops where progress returns False, or on Ctrl-C.
Progress progress_to(const nb::object& progress)
{
    return Progress([&progress](double fraction, std::string_view stage) {
        const nb::gil_scoped_acquire python;
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        if (progress.is_none())
            return true;
        const nb::object answer = progress(fraction, std::string(stage));
        return answer.is_none() || nb::cast<bool>(nb::bool_(answer));
    });
}

/// Adds the warnings about it to the scene.
Frame guessed_frame(PythonScene& scene, const Positions& in_file, const Triangles& triangles,
                    const GarmentChoice& choice, const std::string& name)
{
    const FrameGuess guess = garment_frame(in_file, triangles, scene.body_frame, choice, stature_of(*scene.scene.body),
                                           scene.scene.body->surface);
    for (const std::string& line : warnings_about_frame(name, guess, "garment_", set_by_name))
        scene.frame_warnings.push_back(line);
    return guess.frame;
}

/// Of this garment, where it has one of its own.
std::optional<Fabric> fabric_from(const nb::dict& sizes)
{
    if (!sizes.contains("garment_fabric"))
        return {};
    return fabric_of(nb::cast<std::string>(sizes["garment_fabric"]));
}

void warn_of_file(PythonScene& scene, const MeshFile& file, const StrippedBody* left)
{
    std::vector<std::string> notes = file.warnings();
    for (const std::string& note : left ? notes_on(*left) : std::vector<std::string>())
        notes.push_back(note);
    for (const std::string& note : notes)
        scene.frame_warnings.push_back(file.path().filename().string() + ": " + note);
}

std::shared_ptr<const Appearance> look_of(const MeshFile& file, const StrippedBody* left)
{
    return std::make_shared<const Appearance>(left ? appearance_of(file.appearance(), *left) : file.appearance());
}

/// Of files: "shirt" of "shirt.obj".
std::vector<std::string> stems_of(const std::vector<std::string>& names)
{
    std::vector<std::string> stems;
    for (const std::string& name : names)
        stems.push_back(std::filesystem::path(name).stem().string());
    return stems;
}

}  // namespace

const Rig& PythonScene::rig() const
{
    if (!scene.rig)
        throw InvalidInput(ErrorCode::missing_input, "the body has no rig; run rig_body first");
    return *scene.rig;
}

const Dressing& PythonScene::dressing() const
{
    if (const Dressing* end = final_dressing(scene))
        return *end;
    throw InvalidInput(ErrorCode::missing_input, "no garment is draped; run drape_garment first");
}

PythonScene scene_of_body(const NumbersIn& positions, const IndicesIn& triangles, const std::string& unit,
                          const std::string& up, const std::string& front,
                          const std::map<std::string, std::vector<double>>& joints, const nb::dict& sizes)
{
    PythonScene made;
    const Positions in_file = positions_from(positions);
    const Triangles faces = triangles_from(triangles);
    const BodySizes known = parameters_of(filter_of("rig"), sizes, { "height" }).body_sizes;
    const FrameGuess guess = body_frame(in_file, faces, { { unit, up }, known.height });
    made.body_frame = guess.frame;
    made.frame_warnings = warnings_about_frame("the body", guess, "", set_by_name);
    put_body_in(made, in_file, faces);
    made.front = front_of_body(made.body_frame, front);
    for (const auto& [name, place] : joints)
        joint_of(made.joints, name) = made.body_frame.to_metres(as_positions(place, name)).row(0);
    return made;
}

PythonScene scene_of_rigged(const NumbersIn& positions, const IndicesIn& triangles, const nb::object& find, bool fitted)
{
    PythonScene made;
    const FindArray find_array = find_with(find);
    made.body_frame = body_frame_from(find_array);
    put_body_in(made, positions_from(positions), triangles_from(triangles));
    made.scene.rig = rig_from(find_array, made.scene.body->surface.positions);
    for (const std::string& line :
         warnings_about_given_rig(*made.scene.rig, *made.scene.body, "the skeleton of the body"))
        made.frame_warnings.push_back(line);
    if (fitted)
        made.scene.fits = fits_from(find_array);
    return made;
}

void add_garment(PythonScene& scene, const NumbersIn& positions, const IndicesIn& triangles, const NumbersIn& uvs,
                 const std::string& type, const std::string& unit, const std::string& up, const std::string& front,
                 const nb::dict& sizes, const std::string& name, const nb::object& find)
{
    const Positions in_file = positions_from(positions);
    const Triangles faces = triangles_from(triangles);
    const std::optional<Frame> known = garment_frame_from(find_with(find));
    const Parameters p = parameters_of(filter_of("fit"), sizes, { "garment_scale", "as_placed" });
    const GarmentChoice choice { { unit, up }, p.garment_sizes.scale, p.fit.as_placed, front };
    const Frame frame = known ? *known : guessed_frame(scene, in_file, faces, choice, name);
    scene.scene.garments.push_back({ .mesh = make_garment(frame.to_metres(in_file), faces, corner_uvs_from(uvs)),
                                     .type = garment_type_of(type),
                                     .front = front_of_garment(frame, front),
                                     .as_placed = choice.as_placed,
                                     .fabric = fabric_from(sizes),
                                     .has_unit = frame.has_unit,
                                     .size_in_unit = frame.size_in_unit });
    scene.garment_frames.push_back(frame);
    scene.names.push_back(name);
}

void set_worn(PythonScene& s, const nb::object& find, const NumbersIn& body, const std::vector<NumbersIn>& garments)
{
    std::vector<Positions> worn;
    for (const NumbersIn& garment : garments)
        worn.push_back(s.body_frame.to_metres(positions_from(garment)));
    const Positions left = s.body_frame.to_metres(positions_from(body));
    s.scene.draped = dressing_from(s.scene, dressed_pose_from(find_with(find)), left, worn, s.names);
}

void set_body_file(PythonScene& scene, const MeshFile& file, const StrippedBody* left)
{
    warn_of_file(scene, file, left);
    scene.body_file = file;
    scene.is_stripped = left != nullptr;
    scene.body_look = look_of(file, left);
}

void set_garment_look(PythonScene& scene, const MeshFile& file, const StrippedBody* left)
{
    warn_of_file(scene, file, left);
    for (const std::string& warning : warnings_about_left_behind(file))
        scene.frame_warnings.push_back(warning);
    scene.garment_looks.resize(scene.scene.garments.size());
    scene.garment_looks.back() = look_of(file, left);
}

void write_outfit_of(const PythonScene& s, const std::filesystem::path& path, const std::string& bones,
                     bool hide_covered_skin, int influences)
{
    const auto part = [](std::string name, const std::shared_ptr<const Appearance>& look) {
        return OutfitPart { std::move(name), look ? *look : Appearance() };
    };
    const std::vector<std::string> names = stems_of(s.names);
    std::vector<OutfitPart> garments;
    for (std::size_t i = 0; i < names.size(); ++i)
        garments.push_back(part(names[i], i < s.garment_looks.size() ? s.garment_looks[i] : nullptr));
    OutfitRequest request { path, bone_names_called(bones), hide_covered_skin };
    request.influences = influences;
    const nb::gil_scoped_release other_threads_run;
    if (s.body_file && !request.bones)
        request.avatar = avatar_in(*s.body_file, s.body_frame);
    request.is_stripped = s.is_stripped;
    write_outfit(s.scene, part("body", s.body_look), garments, request);
}

void write_animation_of(const PythonScene& s, const std::filesystem::path& path, double seconds)
{
    if (!s.scene.recovered)
        throw InvalidInput(ErrorCode::missing_input, "there are no frames before the pose is recovered");
    const nb::gil_scoped_release other_threads_run;
    write_animation(s.scene, *s.scene.recovered, stems_of(s.names), path, seconds);
}

PythonScene run(const PythonScene& given, const std::string& name, const nb::dict& values, const nb::object& progress)
{
    const Filter& filter = filter_of(name);
    Parameters parameters = parameters_from(filter, values);
    parameters.rig.front = given.front;
    parameters.rig.joints = given.joints;
    PythonScene made = given;
    const Progress report = progress_to(progress);
    const nb::gil_scoped_release other_threads_run;
    filter.run(made.scene, parameters, report);
    made.cloth = filter.cloth(parameters);
    return made;
}

nb::list parameters_of(const std::string& name)
{
    nb::list list;
    const Parameters defaults;
    describe(filter_of(name), defaults, [&](const auto& value, const About& about) {
        using Value = std::decay_t<decltype(value)>;
        list.append(nb::make_tuple(std::string(about.name), object_of(value, about), type_of<Value>(about),
                                   range_of<Value>(about), std::string(about.help)));
    });
    return list;
}

}  // namespace garmentfit::python
