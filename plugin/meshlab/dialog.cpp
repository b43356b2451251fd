// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialog.h"

#include <algorithm>

#include "fields.h"
#include "fitting.h"
#include "garmentfit/filters/frame_choice.h"
#include "garmentfit/filters/outfit.h"
#include "garmentfit/units.h"
#include "layers.h"

namespace garmentfit::meshlab {
namespace {

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

// ---- defaults -----------------------------------------------------------------------------------------------------

struct Defaults {
    std::vector<const MeshModel*> layers;  ///< with faces: body, garment, worn garment; never null
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

/// Body and garment of the newest result; else the first layer is the body and the next one with faces the garment.
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

QString tip_of(const About& about, const std::string& range)
{
    return text(about.help) + " (" + QString::fromStdString(range) + ")";
}

QString label_of(const About& about)
{
    return (about.group == Group::research ? "Research: " : "") + text(about.label)
        + (about.unit.empty() || is_length(about) ? "" : ", " + text(about.unit));
}

/// Adds a field for each parameter of one group.
class AddToDialog {
public:
    AddToDialog(RichParameterList& list, const Defaults& defaults, Group group) :
        list_(list), defaults_(defaults), group_(group)
    {
    }

    template <class Value>
    void operator()(const Value& value, const About& about) const
    {
        if (about.group == group_)
            add(value, about);
    }

private:
    template <class Value>
    void add(const Value& value, const About& about) const
    {
        const QString name = text(about.name), label = label_of(about), tip = tip_of(about, range_of<Value>(about));
        if constexpr (is_optional<Value>)
            list_.addParam(RichString(name, QString::fromStdString(text_of(value, about)), label,
                                      tip + ", or \"" + text(about.otherwise) + "\""));
        else if constexpr (std::is_enum_v<Value>)
            list_.addParam(RichEnum(name, int(value), list_of(*about.choices), label, tip));
        else if constexpr (std::is_same_v<Value, bool>)
            list_.addParam(RichBool(name, value, label, tip));
        else if constexpr (std::is_integral_v<Value>)
            list_.addParam(RichInt(name, value, label, tip));
        else if (is_length(about))
            list_.addParam(LengthParameter(name, Scalarm(value / defaults_.metres_per_unit), 0,
                                           Scalarm(defaults_.diagonal), label,
                                           tip + "; in the body's unit, or as a share of the body's diagonal"));
        else
            list_.addParam(RichFloat(name, Scalarm(value), label, tip));
    }

    RichParameterList& list_;
    const Defaults& defaults_;
    Group group_;
};

void add_choice(RichParameterList& list, const QString& name, const std::vector<std::string_view>& choices,
                const char* label, const char* tip, int first = 0)
{
    list.addParam(RichEnum(name, first, list_of(choices), label, tip));
}

void add_garments(RichParameterList& list, const Defaults& defaults, ShownDocument& document, const MenuEntry& entry)
{
    const char* labels[] = { "Garment", "Second garment (optional)", "Third garment (optional)" };
    const char* front_labels[]
        = { "Front of the garment", "Front of the second garment", "Front of the third garment" };
    const char* fabric_labels[] = { "", "Fabric of the second garment", "Fabric of the third garment" };
    const char* type_labels[] = { "", "Type of the second garment", "Type of the third garment" };
    for (int i = 0; i < 3; ++i) {
        list.addParam(layer_parameter(
            k_garments[i], *defaults.layers[1], document, labels[i],
            i == 0 ? "The layer with the garment as it was given"
                   : "From the inside out, unless Layer order is auto; choose the first garment again for none"));
        if (i > 0 && entry.filter->has(Stage::fit))
            add_choice(list, k_types[i], garment_type_names(), type_labels[i], "auto finds it from the openings");
        if (i > 0 && (entry.filter->has(Stage::drape) || entry.filter->has(Stage::recover)))
            add_choice(list, k_fabrics[i], further_fabrics(), fabric_labels[i], "What it is made of");
        if (entry.filter->has(Stage::fit))
            add_choice(list, k_garment_fronts[i], axis_choices(), front_labels[i],
                       "The axis of its layer that the garment's front faces; auto finds it");
    }
}

void add_frames(RichParameterList& list, const MenuEntry& entry)
{
    if (entry.begins_with_body()) {
        add_choice(list, k_unit, unit_choices(), "Unit of the body",
                   "MeshLab has no units; auto guesses the unit from the body's size");
        add_choice(list, k_up, axis_choices(), "Up axis of the body", "auto guesses the axis from the body's shape");
        add_choice(list, k_front, axis_choices(), "Front of the body",
                   "The axis that the chest faces, roughly; auto finds it");
    }
    if (entry.filter && entry.filter->has(Stage::fit)) {
        add_choice(list, k_garment_unit, unit_choices(), "Unit of the garments",
                   "auto takes the body's unit unless the garment's size contradicts it");
        add_choice(list, k_garment_up, axis_choices(), "Up axis of the garments",
                   "auto takes the body's axis unless the garment's shape contradicts it");
    }
}

void add_file(RichParameterList& list, const MenuEntry& entry, const MeshModel& body)
{
    const QString beside = QString::fromStdString(rig_file_beside(body).string());
    if (entry.task == Task::save_rig)
        list.addParam(
            SaveFileParameter(k_file, beside, "*.rig.json", "Rig file",
                              "Without a name: man.rig.json beside man.ply, where filters find it by themselves"));
    if (entry.task == Task::load_rig)
        list.addParam(OpenFileParameter(k_file, beside, { "*.json" }, "Rig file",
                                        "A file of Save Rig, or rig.json of the program garmentfit; without a name the "
                                        "file beside the body's file"));
}

void add_outfit(RichParameterList& list, const MeshModel& body)
{
    const std::vector<std::string_view> bones = outfit_bones();
    add_choice(list, k_outfit_bones, bones, "Bones",
               "Names and number of the joints, as that program has them; a .vrm file has those of VRM. own: those of "
               "the body's file, which is kept as it is and gets the garments; of garmentfit where it has none",
               int(bones.size()) - 1);
    list.addParam(OpenFileParameter(
        k_body_file, "", { "*.glb", "*.gltf", "*.vrm" }, "Body file",
        "For the bones own: the skinned glTF, GLB or VRM that the body was made from, where its layer was opened from "
        "another file; its vertices are found by their places. Without a name: the file of the layer"));
    list.addParam(
        RichBool(k_hide_covered_skin, false, "Hide covered skin",
                 "Leave out faces of the body that the garments cover in poses of everyday movement, and draw in "
                 "skin under cloth by up to 6 cm (not on an avatar's own bones)"));
    add_choice(list, k_influences, influences(), "Influences",
               "At most so many joints move a vertex of the clothes: four, which all programs read, or eight");
    list.addParam(SaveFileParameter(k_file, QString::fromStdString(outfit_beside(body).string()), "*.glb", "Outfit",
                                    "A .glb or .vrm file; without a name: man.outfit.glb beside man.ply"));
}

void add_shown(RichParameterList& list, const MenuEntry& entry)
{
    if (entry.makes_rig())
        add_choice(list, k_bone, bone_names(), "Shown bone",
                   "Its skin weight becomes quality and colour of the rigged body", thorax);
    if (entry.makes_maps())
        add_choice(list, k_map, k_maps, "Shown map",
                   "Becomes quality and colour of the garment: ease from red (0) to blue (10 cm), strain from blue "
                   "(none) to red "
                   "(10%), pressure from blue (none) to red (1000 Pa); none leaves its colours");
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
                                      "The layer with the same garment on the body, in the body's input pose"));
    }
    add_file(list, entry, *defaults.layers[0]);
    if (entry.task == Task::save_outfit)
        add_outfit(list, *defaults.layers[0]);
    add_frames(list, entry);
    const Parameters parameters;
    describe_entry(entry, parameters, AddToDialog(list, defaults, Group::everyday));
    add_shown(list, entry);
    describe_entry(entry, parameters, AddToDialog(list, defaults, Group::research));
    return list;
}

}  // namespace garmentfit::meshlab
