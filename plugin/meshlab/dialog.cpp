// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialog.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "fit/units.h"
#include "fitting.h"
#include "layers.h"

namespace fit::meshlab {
namespace {

const QString k_body = "body", k_worn = "worn", k_file = "file", k_unit = "unit", k_up = "up", k_front = "front",
              k_garment_unit = "garment_unit", k_garment_up = "garment_up", k_bone = "shown_bone", k_map = "shown_map";
const QString k_garments[] = { "garment", "second_garment", "third_garment" };
const QString k_types[] = { "type", "second_type", "third_type" };

const std::vector<std::string_view> k_units { "auto", "m", "dm", "cm", "mm", "in", "ft" };
const std::vector<std::string_view> k_axes { "auto", "+x", "-x", "+y", "-y", "+z", "-z" };
const std::vector<std::string_view> k_maps { "ease", "strain", "pressure", "none" };

QString text(std::string_view words) { return QString::fromUtf8(words.data(), int(words.size())); }

QStringList list_of(const std::vector<std::string_view>& words)
{
    QStringList list;
    for (const std::string_view word : words)
        list << text(word);
    return list;
}

std::vector<std::string_view> bone_names()
{
    std::vector<std::string_view> names;
    for (int bone = 0; bone < bone_count; ++bone)
        names.push_back(bone_name(bone));
    return names;
}

// ---- what a dialog begins with -----------------------------------------------------------------------------------

struct Defaults {
    std::vector<const MeshModel*> layers;  ///< with faces: body, garment, worn garment; all of them are there
    double metres_per_unit = 1;
    double diagonal = 1;  ///< of the body
};

const MeshModel* layer_called(const std::vector<const MeshModel*>& layers, const std::string& name)
{
    const auto found
        = std::find_if(layers.begin(), layers.end(), [&](const MeshModel* layer) { return name_of(*layer) == name; });
    return found == layers.end() ? nullptr : *found;
}

double metres_per_unit_of(const TriangleMesh& body)
{
    return body.triangles.rows() > 0 ? guess_body_frame(body.positions, body.triangles).frame.metres_per_unit : 1;
}

/// The body and garment of the filter before; else the first layer is the body and the next one with faces the garment.
Defaults defaults_for(const MeshDocument& document)
{
    const std::vector<const MeshModel*> layers = layers_of(document);
    const SharedFitting fitting = find_fitting(document, [](const Fitting&) { return true; });
    const MeshModel* body = fitting ? layer_called(layers, fitting->body_name) : nullptr;
    if (!body)
        body = layers.front();
    const MeshModel* garment
        = fitting && !fitting->garment_names.empty() ? layer_called(layers, fitting->garment_names.front()) : nullptr;
    for (const MeshModel* layer : layers)
        if (!garment && layer != body && layer->cm.fn > 0 && !is_result(document, *layer))
            garment = layer;
    Defaults defaults;
    defaults.layers = { body, garment ? garment : body, layers.back() };
    const TriangleMesh mesh = mesh_of(*body);
    defaults.metres_per_unit = metres_per_unit_of(mesh);
    if (mesh.positions.rows() > 0)
        defaults.diagonal = (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
    return defaults;
}

// ---- to the dialog -------------------------------------------------------------------------------------------------

bool is_length(const About& about) { return about.unit == "m"; }

QString tip_of(const About& about, const std::string& range)
{
    return text(about.help) + " (" + QString::fromStdString(range) + ")";
}

QString label_of(const About& about)
{
    return text(about.label) + (about.unit.empty() || is_length(about) ? "" : ", " + text(about.unit));
}

class AddToDialog {
public:
    AddToDialog(RichParameterList& list, const Defaults& defaults) : list_(list), defaults_(defaults) { }

    template <class Value>
    void operator()(const Value& value, const About& about) const
    {
        const QString name = text(about.name), label = label_of(about), tip = tip_of(about, range_of<Value>(about));
        if constexpr (std::is_enum_v<Value>)
            list_.addParam(RichEnum(name, int(value), list_of(*about.choices), label, tip));
        else if constexpr (std::is_same_v<Value, bool>)
            list_.addParam(RichBool(name, value, label, tip));
        else if constexpr (std::is_integral_v<Value>)
            list_.addParam(RichInt(name, value, label, tip));
        else if (is_length(about))
            list_.addParam(LengthParameter(name, Scalarm(value / defaults_.metres_per_unit), 0,
                                           Scalarm(defaults_.diagonal), label,
                                           tip + "; in the body's own unit, or as a share of the body's diagonal"));
        else
            list_.addParam(RichFloat(name, Scalarm(value), label, tip));
    }

private:
    RichParameterList& list_;
    const Defaults& defaults_;
};

void add_choice(RichParameterList& list, const QString& name, const std::vector<std::string_view>& choices,
                const char* label, const char* tip, int first = 0)
{
    list.addParam(RichEnum(name, first, list_of(choices), label, tip));
}

void add_garments(RichParameterList& list, const Defaults& defaults, ShownDocument& document, const MenuEntry& entry)
{
    const char* labels[] = { "Garment", "Second garment, over it", "Third garment, over both" };
    const char* type_labels[] = { "", "Type of the second garment", "Type of the third garment" };
    for (int i = 0; i < 3; ++i) {
        list.addParam(layer_parameter(k_garments[i], *defaults.layers[1], document, labels[i],
                                      i == 0 ? "The layer with the garment as it was given"
                                             : "From the inside out; choose the first garment again for none"));
        if (i > 0 && entry.filter->has(Stage::fit))
            add_choice(list, k_types[i], garment_type_names(), type_labels[i], "auto finds it from the openings");
    }
}

void add_frames(RichParameterList& list, const MenuEntry& entry)
{
    if (entry.begins_with_body()) {
        add_choice(list, k_unit, k_units, "Unit of the body",
                   "MeshLab has no units; auto guesses from the body's size");
        add_choice(list, k_up, k_axes, "Up axis of the body", "auto guesses from the body's shape");
        add_choice(list, k_front, k_axes, "Front of the body", "Where the chest faces, roughly; auto finds it");
    }
    if (entry.filter && entry.filter->has(Stage::fit)) {
        add_choice(list, k_garment_unit, k_units, "Unit of the garments",
                   "auto takes the body's unless their size speaks against it");
        add_choice(list, k_garment_up, k_axes, "Up axis of the garments",
                   "auto takes the body's unless their shape speaks against it");
    }
}

void add_file(RichParameterList& list, const MenuEntry& entry, const MeshModel& body)
{
    const QString beside = QString::fromStdString(rig_file_beside(body).string());
    if (entry.task == Task::save_rig)
        list.addParam(SaveFileParameter(k_file, beside, "*.rig.json", "Rig file",
                                        "Without a name it is called like the body's file, man.rig.json beside "
                                        "man.ply; filters find it there by themselves"));
    if (entry.task == Task::load_rig)
        list.addParam(
            OpenFileParameter(k_file, beside, { "*.json" }, "Rig file",
                              "What Save Rig wrote, or rig.json by the program garmentfit; without a name the "
                              "one beside the body's file"));
}

bool makes_rig(const MenuEntry& entry) { return entry.begins_with_body() || entry.task == Task::load_rig; }

bool makes_maps(const MenuEntry& entry)
{
    return entry.task == Task::measure
        || (entry.filter && (entry.filter->has(Stage::drape) || entry.filter->has(Stage::recover)));
}

void add_shown(RichParameterList& list, const MenuEntry& entry)
{
    if (makes_rig(entry))
        add_choice(list, k_bone, bone_names(), "Shown bone",
                   "Its skin weight becomes quality and colour of the rigged body", thorax);
    if (makes_maps(entry))
        add_choice(list, k_map, k_maps, "Shown map",
                   "Becomes quality and colour of the garment: ease from red (0) to blue (10 cm), strain from blue "
                   "(none) to red "
                   "(10%), pressure from blue (none) to red (1000 Pa); none leaves its colours");
}

// ---- from the dialog -----------------------------------------------------------------------------------------------

/// 0.0025 for what is next to it, a float, or a share of the body's size and back: as a user typed it, and as the command
/// line reads it.
double as_typed(Scalarm value)
{
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general,
                                   std::numeric_limits<Scalarm>::digits10)
                         .ptr;
    double typed = double(value);
    std::from_chars(digits, end, typed);
    return typed;
}

class ReadFromDialog {
public:
    explicit ReadFromDialog(const RichParameterList& list) : list_(list) { }

    template <class Value>
    void operator()(Value& value, const About& about) const
    {
        const QString name = text(about.name);
        if constexpr (std::is_enum_v<Value>)
            value = Value(list_.getEnum(name));
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
                value *= metres_per_unit;
    }
};

MeshModel* read_layer(const RichParameterList& list, const QString& name, MeshDocument& document)
{
    MeshModel* layer = chosen_layer(list, name, document);
    if (!layer)
        throw InvalidInput(name.toStdString() + ": there is no such layer; choose one of the document");
    return layer;
}

std::string read_word(const RichParameterList& list, const QString& name, const std::vector<std::string_view>& words)
{
    return std::string(words.at(std::size_t(list.getEnum(name))));
}

void read_garments(Choice& choice, const RichParameterList& list, MeshDocument& document, const MenuEntry& entry)
{
    for (int i = 0; i < 3; ++i) {
        MeshModel* garment = read_layer(list, k_garments[i], document);
        if (garment == choice.body)
            throw InvalidInput(k_garments[i].toStdString() + ": " + name_of(*garment)
                               + " is the body already; choose the garment's layer");
        if (i > 0 && garment == choice.garments.front())
            continue;
        if (std::find(choice.garments.begin(), choice.garments.end(), garment) != choice.garments.end())
            throw InvalidInput(k_garments[i].toStdString() + ": " + name_of(*garment)
                               + " is worn already; choose the first garment again for none");
        choice.garments.push_back(garment);
        choice.types.push_back(entry.filter->has(Stage::fit) ? GarmentType(list.getEnum(k_types[i]))
                                                             : GarmentType::automatic);
    }
}

void read_frames(Choice& choice, const RichParameterList& list, const MenuEntry& entry)
{
    if (entry.begins_with_body()) {
        choice.body_frame = { read_word(list, k_unit, k_units), read_word(list, k_up, k_axes) };
        choice.front = read_word(list, k_front, k_axes);
    }
    if (entry.filter && entry.filter->has(Stage::fit))
        choice.garment_frame = { read_word(list, k_garment_unit, k_units), read_word(list, k_garment_up, k_axes) };
}

/// MeshLab's own dialog begins without a name, whatever the default.
std::filesystem::path read_file_name(const RichParameterList& list, const MenuEntry& entry, const MeshModel& body)
{
    const QString name = entry.task == Task::save_rig ? list.getSaveFileName(k_file) : list.getOpenFileName(k_file);
    const std::filesystem::path path
        = name.isEmpty() ? rig_file_beside(body) : std::filesystem::path(name.toStdString());
    if (path.empty())
        throw InvalidInput("file: " + name_of(body) + " was not saved yet; give a name that ends in .rig.json");
    return path;
}

/// Calls the visitor for each parameter of the schema that an entry shows.
template <class AnyParameters, class Visitor>
void describe_entry(const MenuEntry& entry, AnyParameters& parameters, const Visitor& visit)
{
    if (entry.filter)
        describe(*entry.filter, parameters, visit);
    else if (entry.task == Task::measure)
        describe(parameters.drape.cloth, visit);
}

}  // namespace

RichParameterList dialog_for(const MenuEntry& entry, ShownDocument& document)
{
    RichParameterList list;
    if (layers_of(document).empty())
        return list;
    const Defaults defaults = defaults_for(document);
    list.addParam(
        layer_parameter(k_body, *defaults.layers[0], document, "Body", "The layer with the body as it was given"));
    if (entry.reads(Data::garments))
        add_garments(list, defaults, document, entry);
    if (entry.task == Task::measure) {
        list.addParam(layer_parameter(k_garments[0], *defaults.layers[1], document, "Garment",
                                      "The layer with the garment as it was given"));
        list.addParam(layer_parameter(k_worn, *defaults.layers[2], document, "Garment as worn",
                                      "The layer with the same garment on the body, in the body's own pose"));
    }
    add_file(list, entry, *defaults.layers[0]);
    add_frames(list, entry);
    const Parameters parameters;
    describe_entry(entry, parameters, AddToDialog(list, defaults));
    add_shown(list, entry);
    return list;
}

Choice read_dialog(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document)
{
    if (layers_of(document).empty())
        throw InvalidInput("there is no layer; open a body first");
    Choice choice;
    choice.body = read_layer(list, k_body, document);
    if (entry.reads(Data::garments))
        read_garments(choice, list, document, entry);
    if (entry.task == Task::measure) {
        choice.garments = { read_layer(list, k_garments[0], document) };
        choice.worn = read_layer(list, k_worn, document);
    }
    if (entry.task == Task::save_rig || entry.task == Task::load_rig)
        choice.file = read_file_name(list, entry, *choice.body);
    read_frames(choice, list, entry);
    describe_entry(entry, choice.parameters, ReadFromDialog(list));
    choice.parameters.fit.type = GarmentType::automatic;  // each garment has its own
    if (makes_rig(entry))
        choice.shown_bone = Bone(list.getEnum(k_bone));
    if (makes_maps(entry))
        choice.shown_map = ShownMap(list.getEnum(k_map));
    return choice;
}

void put_lengths_in_metres(const MenuEntry& entry, Parameters& parameters, double metres_per_unit)
{
    describe_entry(entry, parameters, LengthsInMetres { metres_per_unit });
}

}  // namespace fit::meshlab
