// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.h"

#include <algorithm>
#include <iostream>
#include <map>

#include <CLI/CLI.hpp>

#include "garmentfit/error.h"
#include "garmentfit/version.h"

namespace garmentfit::cli {
namespace {

struct CommandText {
    std::string_view name, examples;
};

constexpr CommandText k_commands[] = {
    { "dress",
      "Examples:\n"
      "  garmentfit dress woman.obj coat.obj -o dressed\n"
      "  garmentfit dress man.ply shirt.glb trousers.obj --type tshirt --type trousers -o dressed\n"
      "  garmentfit dress scan.stl dress.obj --unit mm --up +z --json -o dressed\n" },
    { "rig",
      "Examples:\n"
      "  garmentfit rig man.ply -o rigged\n"
      "  garmentfit rig woman.obj --unit dm --swap-sides -o rigged\n"
      "  garmentfit rig scan.ply --up +z --front +x --joints elbows.json -o rigged\n" },
    { "fit",
      "Examples:\n"
      "  garmentfit fit man.ply coat.obj -o fitted\n"
      "  garmentfit fit man.ply coat.obj --rig rigged/rig.json -o fitted\n" },
    { "drape",
      "Examples:\n"
      "  garmentfit drape fitted -o draped\n"
      "  garmentfit drape fitted --density 0.4 --bend-stiffness 1e-4 -o draped\n" },
    { "recover",
      "Examples:\n"
      "  garmentfit recover draped -o dressed\n" },
};

/// One flag for each parameter of the schema; flags that exist already are left alone.
class AddFlags {
public:
    explicit AddFlags(CLI::App& command) : command_(command) { }

    template <class Value>
    void operator()(Value& value, const About& about)
    {
        std::string flag = "--" + std::string(about.name);
        std::replace(flag.begin(), flag.end(), '_', '-');
        if (command_.get_option_no_throw(flag))
            return;
        const std::string help = std::string(about.help) + " (" + range_of<Value>(about) + ")";
        const std::string group = about.group == Group::research ? "Research" : "Parameters";
        if constexpr (std::is_same_v<Value, bool>)
            command_.add_flag(flag, value, help)->group(group);
        else
            command_
                .add_option_function<std::string>(
                    flag, [&value, about](const std::string& text) { set_from_text(value, about, text); }, help)
                ->default_str(text_of(value, about))
                ->type_name("")
                ->group(group);
    }

private:
    CLI::App& command_;
};

bool starts_from_meshes(const Filter& filter) { return filter.has(Stage::rig) || filter.has(Stage::fit); }
/// `fit` also rigs, unless it is given a rig.
bool moves_cloth(const Filter& filter) { return filter.has(Stage::drape) || filter.has(Stage::recover); }
bool recovers(const Filter& filter) { return filter.has(Stage::recover); }
bool takes_a_rig(const Filter& filter) { return filter.has(Stage::fit) && !filter.has(Stage::rig); }

double scale_from(const std::string& text)
{
    GarmentSizes sizes;
    describe(sizes, SetByName { "garment_scale", text });
    return sizes.scale;
}

void add_mesh_options(CLI::App& command, const Filter& filter, Call& call)
{
    command.add_option("BODY", call.body, "Body mesh: OBJ, PLY, OFF, STL, glTF, GLB, FBX, DAE")->required();
    command.add_option("--unit", call.body_frame.unit, "Unit of the body's file: auto, m, dm, cm, mm, in, ft")
        ->default_str("auto");
    command.add_option("--up", call.body_frame.up, "Up axis of the body's file: auto, +x, -x, +y, -y, +z, -z")
        ->default_str("auto");
    command
        .add_option("--front", call.front,
                    "Where the chest faces, roughly: auto, +x, -x, +y, -y, +z, -z of the body's file")
        ->default_str("auto");
    command.add_flag("--reconstruct", call.reconstruct,
                     "Build a surface from the body's points where its file has no faces");
    command.add_option(
        "--joints", call.joints,
        "File with the places of some or all joints, as JSON (docs/rig.md), where the program finds wrong ones");
    command.add_flag("--ignore-skin", call.ignores_skin,
                     "Find the skeleton by the body's shape, also where the body is a skinned glTF or GLB");
    command
        .add_option_function<std::string>(
            "--wears", [&call](const std::string& name) { call.wears = wears_called(name); },
            "Clothes that an avatar wears in its file already: keep (all parts are the body), or strip (parts that are "
            "named as clothes and have skin under them are left out)")
        ->type_name("NAME")
        ->default_str("keep");
    if (!filter.has(Stage::fit))
        return;
    command.add_option("GARMENT", call.garments, "Garment meshes, from the inside out (see --layer-order)")->required();
    command
        .add_option("--type", call.types,
                    "Type of a garment, once for each: "
                        + range_of<GarmentType>(
                            { .name = {}, .label = {}, .unit = {}, .help = {}, .choices = &garment_type_names() }))
        ->allow_extra_args(false)
        ->default_str("auto");
    command.add_option("--garment-unit", call.garment_frame.unit, "Unit of the garments' files")->default_str("auto");
    command.add_option("--garment-up", call.garment_frame.up, "Up axis of the garments' files")->default_str("auto");
    command
        .add_option("--garment-front", call.garment_fronts,
                    "Where the front of a garment faces in its file, once for all or once for each: auto, +x, -x, +y, "
                    "-y, +z, -z")
        ->allow_extra_args(false)
        ->default_str("auto");
    command
        .add_option_function<std::vector<std::string>>(
            "--garment-scale",
            [&call](const std::vector<std::string>& texts) {
                for (const std::string& text : texts)
                    call.garment_scales.push_back(scale_from(text));
            },
            "A garment's file is multiplied by this, after its unit; once for all or once for each (0.001..1000)")
        ->allow_extra_args(false)
        ->type_name("")
        ->default_str("1");
    command.add_flag("--as-placed", call.as_placed_texts,
                     "Body and garment come from one scene, and the garment lies round the body already; --as-placed "
                     "for all, or --as-placed=on or --as-placed=off once for each");
    command.add_option("--rig", call.rig,
                       "Take the rig from this rig.json (weights from rigged.ply beside it, where there is one) or "
                       "from this skinned glTF or GLB of the same vertices");
}

void add_fabric_option(CLI::App& command, Call& call)
{
    command
        .add_option(
            "--fabric", call.fabrics,
            "Fabric of the garments, once for all or once for each; GARMENT=FABRIC for the one of this file "
            "name. Sets density, stiffness, friction and largest stretch, where they are not given ("
                + range_of<Fabric>({ .name = {}, .label = {}, .unit = {}, .help = {}, .choices = &fabric_names() })
                + ")")
        ->allow_extra_args(false)
        ->type_name("")
        ->default_str("cotton")
        ->group("Parameters");
}

void add_outfit_options(CLI::App& command, Call& call)
{
    command
        .add_option("--outfit", call.outfit.path,
                    "Write body and clothes as one skinned GLB, too, where they are certified: one skeleton, and "
                    "weights for all meshes, so that other programs can pose them")
        ->check([](const std::string& path) { return fault_of_outfit_name(path); });
    command
        .add_flag(
            "--hide-covered-skin", call.outfit.hide_covered_skin,
            "With --outfit: leave out faces of the body that the clothes cover in all poses of everyday "
            "movement, and draw in skin under cloth by up to 6 cm (of an adult; not on an avatar's own bones), so "
            "that less passes through posed cloth")
        ->needs("--outfit");
    command
        .add_option_function<std::string>(
            "--bones", [&call](const std::string& name) { call.outfit.bones = bone_names_called(name); },
            "With --outfit: whose joints and names it has: own (those of the body's file, with its animations and all "
            "else, where it is a skinned glTF or GLB; else garmentfit), garmentfit, vrm, mixamo, unreal or smpl. A "
            "name that ends in .vrm has those of vrm")
        ->type_name("NAME")
        ->default_str("own")
        ->needs("--outfit");
    command
        .add_option_function<std::string>(
            "--influences", [&call](const std::string& name) { call.outfit.influences = influences_called(name); },
            "With --outfit: at most so many joints move a vertex of the clothes: four, which all programs read, or "
            "eight (a second set of joints and weights)")
        ->type_name("NAME")
        ->default_str("four")
        ->needs("--outfit");
}

void add_command(CLI::App& app, const CommandText& text, Call& call)
{
    const Filter& filter = filter_of(text.name);
    CLI::App& command = *app.add_subcommand(std::string(filter.name), std::string(filter.help));
    command.footer(std::string(text.examples));
    if (starts_from_meshes(filter))
        add_mesh_options(command, filter, call);
    else
        command
            .add_option("DIR_IN", call.from,
                        "Folder that garmentfit " + std::string(filter.name == "drape" ? "fit" : "drape") + " wrote")
            ->required();
    command.add_option("-o,--output", call.out, "Folder for the results")->required();
    if (recovers(filter))
        add_outfit_options(command, call);
    command.add_option("--threads", call.threads, "Number of threads; 0 uses all cores. Results do not depend on it")
        ->check(CLI::Range(0, 1024))
        ->default_str("0");
    command.add_flag("--quiet", call.quiet, "Print errors only");
    command.add_flag("--json", call.json, "Print report.json on standard output; after an error, its code and line");
    if (moves_cloth(filter))
        add_fabric_option(command, call);
    if (takes_a_rig(filter))
        describe(filter_of("rig"), call.parameters, AddFlags(command));
    describe(filter, call.parameters, AddFlags(command));
    command.callback([&call, &filter] { call.filter = &filter; });
}

std::string one_line(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// One value for all garments, or one for each.
template <class Value>
void require_one_or_each(const std::vector<Value>& values, const Call& call, const std::string& flag)
{
    if (values.size() > 1 && values.size() != call.garments.size())
        throw InvalidInput(ErrorCode::wrong_call,
                           std::to_string(values.size()) + " values of " + flag + " for "
                               + std::to_string(call.garments.size())
                               + " garments; give it once for all of them, or once for each");
}

template <class Value>
Value value_of(const std::vector<Value>& values, std::size_t garment, Value otherwise)
{
    return values.empty() ? otherwise : values.size() == 1 ? values.front() : values.at(garment);
}

/// Of a flag: "true" where it has no value.
bool is_on(const std::string& text)
{
    FitOptions options;
    describe(options, SetByName { "as_placed", text == "true" ? "on" : text });
    return options.as_placed;
}

void read_choices(Call& call)
{
    for (const std::string& text : call.as_placed_texts)
        call.as_placed.push_back(is_on(text));
    require_one_or_each(call.garment_fronts, call, "--garment-front");
    require_one_or_each(call.garment_scales, call, "--garment-scale");
    require_one_or_each(call.as_placed, call, "--as-placed");
    describe(call.parameters.body_sizes, CheckRanges());
}

void require_types(const Call& call)
{
    if (call.types.size() > call.garments.size())
        throw InvalidInput(ErrorCode::wrong_call,
                           std::to_string(call.types.size()) + " types for " + std::to_string(call.garments.size())
                               + " garments; give --type at most once for each garment");
    for (const std::string& type : call.types)
        garment_type_of(type);
}

}  // namespace

GarmentChoice Call::garment_choice(std::size_t garment) const
{
    return { garment_frame, value_of(garment_scales, garment, 1.0), value_of(as_placed, garment, false),
             value_of<std::string>(garment_fronts, garment, "auto") };
}

std::vector<std::optional<Fabric>> Call::fabrics_of(const std::vector<std::string>& names) const
{
    std::vector<std::string> unnamed;
    std::vector<std::optional<Fabric>> result(names.size());
    std::vector<std::pair<std::size_t, Fabric>> named;
    for (const std::string& text : fabrics) {
        const std::size_t equals = text.rfind('=');
        if (equals == std::string::npos) {
            unnamed.push_back(text);
            continue;
        }
        const std::string name = text.substr(0, equals);
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InvalidInput(ErrorCode::wrong_call,
                               "--fabric " + text + ": no garment has the file name " + name
                                   + "; give the name of its file without folders");
        named.emplace_back(std::size_t(found - names.begin()), fabric_of(text.substr(equals + 1)));
    }
    if (unnamed.size() > 1 && unnamed.size() != names.size())
        throw InvalidInput(ErrorCode::wrong_call,
                           std::to_string(unnamed.size()) + " values of --fabric for " + std::to_string(names.size())
                               + " garments; give it once for all of them, once for each, or as GARMENT=FABRIC");
    for (std::size_t i = 0; i < names.size() && !unnamed.empty(); ++i)
        result[i] = fabric_of(unnamed.size() == 1 ? unnamed.front() : unnamed[i]);
    for (const auto& [garment, fabric] : named)
        result[garment] = fabric;
    return result;
}

std::optional<Call> parse(int argc, char** argv)
{
    auto call = std::make_unique<Call>();  // flags point into it
    CLI::App app("Dresses a 3D body of any shape and pose in garments made for another body", "garmentfit");
    app.set_version_flag("--version", "garmentfit " GARMENTFIT_VERSION);
    app.require_subcommand(1);
    app.footer("Each command has its own help: garmentfit dress --help\n"
               "Exit codes: 0 dressed and certified, 2 wrong input, 3 too small, 4 not certified, 130 stopped\n\n"
               "Example:\n  garmentfit dress woman.obj coat.obj -o dressed\n");
    for (const CommandText& text : k_commands)
        add_command(app, text, *call);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        app.exit(asked);
        return {};
    } catch (const CLI::Error& error) {
        throw InvalidInput(ErrorCode::wrong_call, one_line(error.what()) + "; see garmentfit --help");
    }
    require_types(*call);
    read_choices(*call);
    return *call;
}

}  // namespace garmentfit::cli
