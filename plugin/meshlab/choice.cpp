// SPDX-License-Identifier: GPL-3.0-or-later
#include "choice.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "fields.h"
#include "fitting.h"
#include "garmentfit/number_text.h"
#include "layers.h"

namespace garmentfit::meshlab {
namespace {

/// The number that a user typed, and that the command line would read. All MeshLabs pass parameters as floats, also
/// those whose layers have doubles: 0.2 arrives as 0.2000000030. The conversion from a share of the body's size or from
/// another unit loses no further digits.
double as_typed(double value)
{
    const std::string digits = rounded_text(value, std::numeric_limits<float>::digits10);
    double typed = value;
    std::from_chars(digits.data(), digits.data() + digits.size(), typed);
    return typed;
}

/// A choice by its number. A dialog shows valid ones only; a script may hold any number.
template <class Enum>
Enum read_number(const RichParameterList& list, const QString& name, std::size_t choices)
{
    const int number = list.getEnum(name);
    if (number < 0 || std::size_t(number) >= choices)
        throw InvalidInput(ErrorCode::out_of_range,
                           name.toStdString() + ": " + std::to_string(number) + " is out of range; give 0.."
                               + std::to_string(choices - 1));
    return Enum(number);
}

class ReadFromDialog {
public:
    explicit ReadFromDialog(const RichParameterList& list) : list_(list) { }

    template <class Value>
    void operator()(Value& value, const About& about) const
    {
        const QString name = text(about.name);
        if constexpr (is_optional<Value>)
            set_from_text(value, about, list_.getString(name).toStdString());
        else if constexpr (std::is_enum_v<Value>)
            value = read_number<Value>(list_, name, about.choices->size());
        else if constexpr (std::is_same_v<Value, bool>)
            value = list_.getBool(name);
        else if constexpr (std::is_integral_v<Value>)
            value = list_.getInt(name);
        else
            value = as_typed(is_length(about) ? list_.getAbsPerc(name) : list_.getFloat(name));
    }

private:
    const RichParameterList& list_;
};

struct LengthsInMetres {
    double metres_per_unit;

    template <class Value>
    void operator()(Value& value, const About& about) const
    {
        if constexpr (std::is_floating_point_v<Value>)
            if (is_length(about))
                value = as_typed(value * metres_per_unit);
    }
};

MeshModel* read_layer(const RichParameterList& list, const QString& name, MeshDocument& document)
{
    MeshModel* layer = chosen_layer(list, name, document);
    if (!layer)
        throw InvalidInput(ErrorCode::wrong_call,
                           name.toStdString() + ": this layer does not exist; choose a layer of the document");
    return layer;
}

std::string read_word(const RichParameterList& list, const QString& name, const std::vector<std::string_view>& words)
{
    return std::string(words[read_number<std::size_t>(list, name, words.size())]);
}

/// Of the second or third garment, where it is not that of the first.
std::optional<Fabric> read_fabric(const RichParameterList& list, int garment, const Filter& filter)
{
    if (garment == 0 || !(filter.has(Stage::drape) || filter.has(Stage::recover)))
        return {};
    const auto number = read_number<std::size_t>(list, k_fabrics[garment], further_fabrics().size());
    return number > 0 ? std::optional(Fabric(number - 1)) : std::nullopt;
}

void read_garments(Choice& choice, const RichParameterList& list, MeshDocument& document, const MenuEntry& entry)
{
    for (int i = 0; i < 3; ++i) {
        MeshModel* garment = read_layer(list, k_garments[i], document);
        if (garment == choice.body)
            throw InvalidInput(ErrorCode::wrong_call,
                               k_garments[i].toStdString() + ": " + name_of(*garment)
                                   + " is already chosen as the body; choose the garment's layer");
        if (i > 0 && garment == choice.garments.front())
            continue;
        if (std::find(choice.garments.begin(), choice.garments.end(), garment) != choice.garments.end())
            throw InvalidInput(
                ErrorCode::wrong_call,
                k_garments[i].toStdString() + ": " + name_of(*garment)
                    + " is already chosen as another garment; choose the first garment again for no further one");
        choice.garments.push_back(garment);
        choice.types.push_back(entry.filter->has(Stage::fit)
                                   ? read_number<GarmentType>(list, k_types[i], garment_type_names().size())
                                   : GarmentType::automatic);
        choice.fabrics.push_back(read_fabric(list, i, *entry.filter));
        choice.garment_fronts.push_back(
            entry.filter->has(Stage::fit) ? read_word(list, k_garment_fronts[i], axis_choices()) : "auto");
    }
}

void read_frames(Choice& choice, const RichParameterList& list, const MenuEntry& entry)
{
    if (entry.begins_with_body()) {
        choice.body_frame = { read_word(list, k_unit, unit_choices()), read_word(list, k_up, axis_choices()) };
        choice.front = read_word(list, k_front, axis_choices());
    }
    if (entry.filter && entry.filter->has(Stage::fit))
        choice.garment_frame
            = { read_word(list, k_garment_unit, unit_choices()), read_word(list, k_garment_up, axis_choices()) };
}

/// MeshLab's file dialog starts with an empty name, whatever the default.
std::filesystem::path read_file_name(const RichParameterList& list, const MenuEntry& entry, const MeshModel& body)
{
    const bool is_outfit = entry.task == Task::save_outfit;
    const QString name = entry.task == Task::load_rig ? list.getOpenFileName(k_file) : list.getSaveFileName(k_file);
    if (!name.isEmpty())
        return std::filesystem::path(name.toStdString());
    const std::filesystem::path path = is_outfit ? outfit_beside(body) : rig_file_beside(body);
    if (path.empty())
        throw InvalidInput(ErrorCode::wrong_call,
                           "file: " + name_of(body) + " has no file yet; give a file name that ends in "
                               + (is_outfit ? ".glb" : ".rig.json"));
    return path;
}

}  // namespace

Choice read_choice(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document)
{
    if (layers_of(document).empty())
        throw InvalidInput(ErrorCode::missing_input, "the document has no layer; open a body first");
    Choice choice;
    choice.body = read_layer(list, k_body, document);
    if (entry.reads(Data::garments))
        read_garments(choice, list, document, entry);
    if (entry.task == Task::measure) {
        choice.garments = { read_layer(list, k_garments[0], document) };
        choice.worn = read_layer(list, k_worn, document);
    }
    if (entry.task == Task::save_outfit) {
        choice.outfit_bones = bone_names_called(read_word(list, k_outfit_bones, outfit_bones()));
        choice.body_file = list.getOpenFileName(k_body_file).toStdString();
        choice.hide_covered_skin = list.getBool(k_hide_covered_skin);
        choice.influences
            = influence_choices()[read_number<std::size_t>(list, k_influences, influence_choices().size())].second;
    }
    if (entry.task == Task::save_rig || entry.task == Task::load_rig || entry.task == Task::save_outfit)
        choice.file = read_file_name(list, entry, *choice.body);
    read_frames(choice, list, entry);
    describe_entry(entry, choice.parameters, ReadFromDialog(list));
    choice.parameters.fit.type = GarmentType::automatic;  // each garment has its own
    if (entry.makes_rig())
        choice.shown_bone = read_number<Bone>(list, k_bone, bone_count);
    if (entry.makes_maps())
        choice.shown_map = read_number<ShownMap>(list, k_map, k_maps.size());
    return choice;
}

void put_lengths_in_metres(const MenuEntry& entry, Parameters& parameters, double metres_per_unit)
{
    describe_entry(entry, parameters, LengthsInMetres { metres_per_unit });
}

}  // namespace garmentfit::meshlab
