// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_entry.h"

#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "dialog.h"
#include "filters/outcome.h"
#include "filters/rig_arrays.h"
#include "filters/rig_file.h"
#include "fit/certificate.h"
#include "fit/fit_map.h"
#include "fitting.h"
#include "layers.h"

namespace fit::meshlab {
namespace {

constexpr double k_doubt = 0.2;  // guesses with a smaller margin (0 a toss-up, 1 sure) are worth a warning
constexpr auto k_between_reports = std::chrono::milliseconds(100);

// The ends of the colour ramps, as the dialog says.
constexpr double k_shown_ease = 0.1;  // m
constexpr double k_shown_strain = 0.1;
constexpr double k_shown_pressure = 1000;  // Pa

std::vector<TriangleMesh> meshes_of(const std::vector<MeshModel*>& layers)
{
    std::vector<TriangleMesh> meshes;
    for (const MeshModel* layer : layers)
        meshes.push_back(mesh_of(*layer));
    return meshes;
}

/// What `make` returns. @throws InvalidInput in its words, after the layer's name.
template <class Make>
auto with_name(const MeshModel& layer, const Make& make)
{
    try {
        return make();
    } catch (const InvalidInput& error) {
        throw InvalidInput(name_of(layer) + ": " + error.what());
    }
}

// ---- layers to a scene -------------------------------------------------------------------------------------------

void add_doubts(Report& report, const std::string& name, const FrameGuess& guess, const std::string& prefix)
{
    if (guess.unit_margin < k_doubt)
        report.warnings.push_back("the unit of " + name + " is hardly more than a guess (" + guess.why + "); set "
                                  + prefix + "unit");
    if (guess.up_margin < k_doubt)
        report.warnings.push_back("the up axis of " + name + " is hardly more than a guess (" + guess.why + "); set "
                                  + prefix + "up");
}

Fitting new_fitting(const Choice& choice, Report& report)
{
    const TriangleMesh mesh = mesh_of(*choice.body);
    if (mesh.triangles.rows() == 0)
        throw InvalidInput(name_of(*choice.body) + " has no faces; choose the body's layer");
    Fitting fitting;
    fitting.body_name = name_of(*choice.body);
    with_name(*choice.body, [&] {
        const FrameGuess guess = body_frame(mesh.positions, mesh.triangles, choice.body_frame);
        fitting.body_frame = guess.frame;
        fitting.scene.body = make_body(guess.frame.to_metres(mesh.positions), mesh.triangles);
        report.lines.push_back(fitting.body_name + ": " + guess.why);
        add_doubts(report, fitting.body_name, guess, "");
    });
    if (fitting.scene.body->repaired)
        report.warnings.push_back(fitting.body_name
                                  + " is not one closed surface; its geometry was read from a repaired copy");
    return fitting;
}

/// Garments new to the scene; what was known of others goes.
void put_on_garments(Fitting& fitting, const Choice& choice, Report& report)
{
    Scene scene;
    scene.body = std::move(fitting.scene.body);
    scene.rig = std::move(fitting.scene.rig);
    fitting.garment_names.clear();
    fitting.garment_frames.clear();
    for (std::size_t i = 0; i < choice.garments.size(); ++i)
        with_name(*choice.garments[i], [&] {
            const TriangleMesh mesh = mesh_of(*choice.garments[i]);
            const FrameGuess guess
                = garment_frame(mesh.positions, mesh.triangles, fitting.body_frame, choice.garment_frame);
            scene.garments.push_back(
                { make_garment(guess.frame.to_metres(mesh.positions), mesh.triangles), choice.types[i] });
            fitting.garment_names.push_back(name_of(*choice.garments[i]));
            fitting.garment_frames.push_back(guess.frame);
            add_doubts(report, fitting.garment_names.back(), guess, "garment_");
        });
    fitting.scene = std::move(scene);
}

/// Garments whose fits stand in a rig file. @throws InvalidInput unless they are the chosen ones.
void put_on_fitted_garments(Fitting& fitting, const Choice& choice)
{
    std::vector<std::string> names;
    for (const MeshModel* garment : choice.garments)
        names.push_back(name_of(*garment));
    if (names != fitting.garment_names)
        throw InvalidInput("no pose of " + fitting.body_name + " in " + names.front()
                           + " is known; run Garment Fitting: Fit Skeleton with the same garments first");
    for (std::size_t i = 0; i < choice.garments.size(); ++i) {
        const TriangleMesh mesh = mesh_of(*choice.garments[i]);
        fitting.scene.garments.push_back(with_name(*choice.garments[i], [&] {
            return GarmentInput { make_garment(fitting.garment_frames[i].to_metres(mesh.positions), mesh.triangles),
                                  fitting.scene.fits[i].type };
        }));
    }
}

/// The newest fitting in the document that has what the filter reads, else one of the body, else the file beside the body.
Fitting known_fitting(const MenuEntry& entry, const Choice& choice, const MeshDocument& document)
{
    const TriangleMesh body = mesh_of(*choice.body);
    const std::vector<TriangleMesh> garments = meshes_of(choice.garments);
    const auto is_of_body = [&](const Fitting& fitting) { return fitting.is_of_body(body); };
    const auto has_inputs = [&](const Fitting& fitting) {
        return is_of_body(fitting) && fitting.is_of_garments(garments)
            && (fitting.scene.draped || !entry.reads(Data::draped));
    };
    if (const SharedFitting found = find_fitting(document, has_inputs))
        return *found;
    if (const SharedFitting found = find_fitting(document, is_of_body))
        return *found;
    const std::filesystem::path file = rig_file_beside(*choice.body);
    if (!file.empty() && std::filesystem::exists(file))
        return fitting_from_file(file, name_of(*choice.body), body);
    throw InvalidInput(name_of(*choice.body)
                       + " is not rigged, or was changed since; run Garment Fitting: Rig Body or Load Rig first");
}

Fitting inputs_of(const MenuEntry& entry, const Choice& choice, const MeshDocument& document, Report& report)
{
    Fitting fitting = entry.begins_with_body() ? new_fitting(choice, report) : known_fitting(entry, choice, document);
    if (!entry.filter || !entry.reads(Data::garments))
        return fitting;
    if (entry.filter->has(Stage::fit))
        put_on_garments(fitting, choice, report);
    else if (fitting.scene.garments.empty())
        put_on_fitted_garments(fitting, choice);
    else if (!fitting.is_of_garments(meshes_of(choice.garments)))
        throw InvalidInput(
            fitting.body_name + " was not fitted into " + name_of(*choice.garments.front())
            + ", or that was changed since; run Garment Fitting: Fit Skeleton with the same garments first");
    return fitting;
}

// ---- judging ---------------------------------------------------------------------------------------------------------

Positions in_layer(const Fitting& fitting, const Positions& in_metres)
{
    return as_kept(fitting.body_frame.to_file(in_metres));
}

/// @throws SolverFailure for a garment that is too small or could not be certified in the digits of a layer.
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

void report_scene(Report& report, const Fitting& fitting)
{
    const Scene& scene = fitting.scene;
    report.numbers["side_margin"] = scene.rig->side_margin;
    if (scene.rig->side_margin < k_doubt)
        report.warnings.emplace_back(
            "left and right of the body are hardly more than a guess; look, and set swap_sides");
    for (std::size_t i = 0; i < scene.fits.size(); ++i) {
        const std::string name = fitting.garment_names[i], type(name_of(scene.fits[i].type));
        if (scene.fits[i].type_margin < k_doubt)
            report.warnings.push_back("the type of " + name + " is hardly more than a guess, " + type + "; set type");
        if (!scene.draped)
            report.lines.push_back(name + " (" + type + "): fitted");
    }
    const Dressing* end = final_dressing(scene);
    if (!end)
        return;
    for (std::size_t i = 0; i < end->garments.size(); ++i)
        report.lines.push_back(in_one_line(fitting.garment_names[i], scene.fits[i].type, end->garments[i]));
    report.numbers["smallest_gap"] = end->garments.back().certificate.smallest_gap / fitting.body_frame.metres_per_unit;
    report.numbers["strain_p95"] = end->garments.back().certificate.strain.p95;
    if (end->speed >= k_at_rest)
        report.warnings.push_back("the cloth is not at rest yet (" + std::to_string(std::lround(1000 * end->speed))
                                  + " mm/s); give more settling steps");
}

// ---- a scene to layers -----------------------------------------------------------------------------------------------

/// Adds layers to one document for one fitting, and ties the fitting to each.
class Results {
public:
    Results(MeshDocument& document, const Choice& choice, Fitting fitting) :
        document_(document), choice_(choice), fitting_(std::make_shared<const Fitting>(std::move(fitting)))
    {
    }

    void add(Data data, bool visible)
    {
        visible_ = visible;
        switch (data) {
        case Data::rig: add_rig(); break;
        case Data::fits: add_fits(); break;
        case Data::draped: add_dressing(*scene().draped, ", draped"); break;
        case Data::recovered:
            add_dressing(*scene().recovered, "");
            add_frames(*scene().recovered);
            break;
        case Data::body:
        case Data::garments: break;  // no filter makes them
        }
    }

    void add_worn_copy(MeshModel& worn, const FitMap& map)
    {
        visible_ = true;
        add_map(kept(add_moved_copy(document_, worn, name_of(worn) + " ease", mesh_of(worn).positions)), map);
    }

private:
    const Scene& scene() const { return fitting_->scene; }

    MeshModel& kept(MeshModel& layer)
    {
        set_visible(document_, layer, visible_);
        hand_on(document_, layer, fitting_);
        return layer;
    }

    MeshModel& add_body(const std::string& name, const Positions& in_metres)
    {
        return kept(add_moved_copy(document_, *choice_.body, name, fitting_->body_frame.to_file(in_metres)));
    }

    void add_bones(const std::string& name, const Skeleton& skeleton)
    {
        kept(add_skeleton(document_, name, fitting_->body_frame.to_file(rows_of(skeleton))));
    }

    void add_rig()
    {
        const SkinWeights& skin = scene().rig->weights;
        MeshModel& body = add_body(fitting_->body_name + " rigged", scene().body->surface.positions);
        for (int slot = 0; slot < 4; ++slot) {
            add_attribute(body, "joint" + std::to_string(slot), skin.bones.col(slot).cast<double>());
            add_attribute(body, "weight" + std::to_string(slot), skin.weights.col(slot));
        }
        const auto shown = (skin.bones.array() == int(choice_.shown_bone)).cast<double>() * skin.weights.array();
        show_quality(body, shown.rowwise().sum().matrix(), 1, 0);
        add_bones(fitting_->body_name + " skeleton", scene().rig->skeleton);
    }

    void add_fits()
    {
        const Rig& rig = *scene().rig;
        for (std::size_t i = 0; i < scene().fits.size(); ++i) {
            const Pose& pose = scene().fits[i].pose;
            const std::string in_pose = " in the pose of " + fitting_->garment_names[i];
            add_body(fitting_->body_name + in_pose,
                     skin(scene().body->surface.positions, rig.weights, bone_transforms(rig.skeleton, pose)));
            add_bones(fitting_->body_name + " skeleton" + in_pose, posed(rig.skeleton, pose));
        }
    }

    void add_map(MeshModel& layer, const FitMap& map)
    {
        const double metres = fitting_->body_frame.metres_per_unit;
        const Eigen::VectorXd ease = map.ease / metres;
        add_attribute(layer, "ease", ease);
        add_attribute(layer, "strain", map.strain);
        add_attribute(layer, "pressure", map.pressure);
        switch (choice_.shown_map) {
        case ShownMap::ease: show_quality(layer, ease, 0, k_shown_ease / metres); break;
        case ShownMap::strain: show_quality(layer, map.strain, k_shown_strain, 0); break;
        case ShownMap::pressure: show_quality(layer, map.pressure, k_shown_pressure, 0); break;
        case ShownMap::none: break;
        }
    }

    MeshModel& add_garment(std::size_t i, const std::string& suffix, const Positions& in_metres)
    {
        return kept(add_moved_copy(document_, *choice_.garments[i],
                                   fitting_->garment_names[i] + " on " + fitting_->body_name + suffix,
                                   fitting_->body_frame.to_file(in_metres)));
    }

    void add_dressing(const Dressing& dressing, const std::string& suffix)
    {
        for (std::size_t i = 0; i < dressing.garments.size(); ++i)
            add_map(add_garment(i, suffix, dressing.garments[i].positions), dressing.maps[i]);
    }

    /// States on the way, hidden.
    void add_frames(const Dressing& dressing)
    {
        visible_ = false;
        for (const RecoverFrame& frame : dressing.frames) {
            const std::string suffix = ", " + std::to_string(percent(frame.share)) + "% of the way";
            add_body(fitting_->body_name + suffix, frame.body);
            for (std::size_t i = 0; i < frame.garments.size(); ++i)
                add_garment(i, suffix, frame.garments[i]);
        }
    }

    MeshDocument& document_;
    const Choice& choice_;
    std::shared_ptr<const Fitting> fitting_;
    bool visible_ = true;
};

// ---- the four tasks --------------------------------------------------------------------------------------------------

Report run_stages(const MenuEntry& entry, Choice& choice, MeshDocument& document, const Progress& progress)
{
    Report report;
    Fitting fitting = inputs_of(entry, choice, document, report);
    put_lengths_in_metres(entry, choice.parameters, fitting.body_frame.metres_per_unit);
    if (choice.front != "auto")
        choice.parameters.rig.front = fitting.body_frame.rotation() * axis_of(choice.front);
    entry.filter->run(fitting.scene, choice.parameters, progress);
    require_certified(fitting);
    report_scene(report, fitting);

    Results results(document, choice, std::move(fitting));
    for (const Data data : entry.filter->outputs)
        results.add(data, data == entry.filter->outputs.back());
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
    Fitting fitting = with_name(
        *choice.body, [&] { return fitting_from_file(choice.file, name_of(*choice.body), mesh_of(*choice.body)); });
    Report report;
    report.lines.push_back("read the rig of " + fitting.body_name + " from " + choice.file.string());
    Results(document, choice, std::move(fitting)).add(Data::rig, true);
    return report;
}

void report_girths(Report& report, const std::vector<Girth>& girths, double metres_per_unit)
{
    std::ostringstream lines;
    lines << std::fixed << std::setprecision(1);
    for (const Girth& girth : girths) {
        lines.str("");
        lines << girth.place << ": body " << 100 * girth.body << " cm, garment " << 100 * girth.garment << " cm, ease "
              << 100 * girth.ease() << " cm";
        report.lines.push_back(lines.str());
        report.numbers[girth.place + " body"] = girth.body / metres_per_unit;
        report.numbers[girth.place + " garment"] = girth.garment / metres_per_unit;
    }
}

/// @throws InvalidInput where garment and worn garment are not the same one.
WornGarment worn_garment(const Choice& choice, const Fitting& fitting, const TriangleMesh& body)
{
    const MeshModel& given = *choice.garments.front();
    const TriangleMesh rest = mesh_of(given), worn = mesh_of(*choice.worn);
    if (rest.positions.rows() != worn.positions.rows() || rest.triangles != worn.triangles)
        throw InvalidInput(name_of(*choice.worn) + " has " + std::to_string(worn.positions.rows()) + " vertices, "
                           + name_of(given) + " has " + std::to_string(rest.positions.rows())
                           + "; choose the same garment as given and as worn");
    const Frame rest_frame = garment_frame(rest.positions, rest.triangles, fitting.body_frame).frame;
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
    const FitMap map = fit_map(body, worn, choice.parameters.drape.cloth);
    report_girths(report, girths(rig.skeleton, rig.weights, body, worn), fitting.body_frame.metres_per_unit);
    if (!worn.certificate.clean())
        report.warnings.push_back(name_of(*choice.worn) + " crosses the body or itself in "
                                  + std::to_string(worn.certificate.body_crossings + worn.certificate.self_crossings)
                                  + " places");
    Results(document, choice, std::move(fitting)).add_worn_copy(*choice.worn, map);
    return report;
}

}  // namespace

Report run_entry(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document,
                 const Progress& progress)
{
    Choice choice = read_dialog(entry, list, document);
    switch (entry.task) {
    case Task::save_rig: return save_rig(entry, choice, document);
    case Task::load_rig: return load_rig(choice, document);
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

}  // namespace fit::meshlab
