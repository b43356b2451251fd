// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_state.h"

#include <algorithm>
#include <sstream>

#include "filters/joint_names.h"
#include "filters/outcome.h"
#include "filters/scene_arrays.h"
#include "named_arrays.h"
#include "polydata.h"

#include "vtkDataObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace fit {
namespace {

constexpr const char* k_own = "OwnPosition";
constexpr const char* k_rest = "RestPosition";

bool contains(const std::vector<Data>& list, Data data)
{
    return std::find(list.begin(), list.end(), data) != list.end();
}

/// Parameters as plain numbers, to see whether they changed.
struct Numbers {
    std::vector<double> values;
    template <class Value>
    void operator()(const Value& value, const About&)
    {
        values.push_back(static_cast<double>(value));
    }
};

std::string called(const std::vector<std::string>& names, std::size_t i)
{
    return names.size() == 1 ? "the garment" : "garment " + std::to_string(i + 1) + " (" + names[i] + ")";
}

}  // namespace

bool FilterState::takes(Data data) const { return contains(filter.inputs, data); }

bool FilterState::makes(Data data) const { return contains(filter.outputs, data); }

int FilterState::frames() const { return makes(Data::recovered) ? parameters.recover.frames : 0; }

// ---- reading ---------------------------------------------------------------------------------------------------------

std::string FilterState::choice(const std::string& what) const
{
    const auto found = choices.find(what);
    return found == choices.end() ? "auto" : found->second;
}

FrameChoice FilterState::frame_choice(const std::string& prefix) const
{
    return { choice(prefix + "Unit"), choice(prefix + "Up") };
}

std::string FilterState::choices_of_body() const
{
    std::ostringstream text;
    text.precision(17);
    text << choice("Unit") << ' ' << choice("Up") << ' ' << choice("Front");
    for (const auto& [name, place] : joints)
        text << ' ' << name << ' ' << place.transpose();
    return text.str();
}

void FilterState::read_body(vtkPolyData& data)
{
    forget_from(Stage::rig);
    scene_ = Scene();
    if (takes(Data::rig)) {
        const FindArray find = find_in(data);
        body_frame_ = body_frame_from(find);
        make_scene_body(mesh_at(data, k_own, "the body"));
        scene_.rig = rig_from(find, data.GetNumberOfPoints());
        if (takes(Data::fits))
            scene_.fits = fits_from(find);
    } else {
        const TriangleMesh mesh = mesh_of(data, "the body");
        body_frame_ = body_frame(mesh.positions, mesh.triangles, frame_choice("")).frame;
        make_scene_body(mesh);
        parameters.rig.front = given_front();
        parameters.rig.joints = given_joints();
    }
}

void FilterState::make_scene_body(const TriangleMesh& mesh)
{
    scene_.body = make_body(body_frame_.to_metres(mesh.positions), mesh.triangles);
}

std::optional<Vec3> FilterState::given_front() const
{
    const std::string front = choice("Front");
    if (front == "auto")
        return {};
    return Vec3(body_frame_.rotation() * axis_of(front));
}

GivenJoints FilterState::given_joints() const
{
    GivenJoints given;
    for (const auto& [name, place] : joints)
        joint_of(given, name) = body_frame_.to_metres(Positions(place.transpose())).row(0);
    return given;
}

void FilterState::read_garments(vtkDataObject& data)
{
    forget_from(takes(Data::fits) ? Stage::drape : Stage::fit);
    scene_.garments.clear();
    garment_frames_.clear();
    garment_names_ = garment_names_in(data);
    const bool known = takes(Data::fits) || takes(Data::draped);
    for (vtkPolyData* garment : garments_in(data)) {
        const std::string name = called(garment_names_, scene_.garments.size());
        const TriangleMesh mesh = known ? mesh_at(*garment, k_rest, name) : mesh_of(*garment, name);
        const std::optional<Frame> frame = known ? garment_frame_from(find_in(*garment)) : std::nullopt;
        garment_frames_.push_back(
            frame ? *frame : garment_frame(mesh.positions, mesh.triangles, body_frame_, frame_choice("Garment")).frame);
        scene_.garments.push_back(
            { make_garment(garment_frames_.back().to_metres(mesh.positions), mesh.triangles), given_type(*garment) });
    }
}

/// The garments as they are worn in the pose that the body was left in.
void FilterState::read_worn(vtkPolyData& body, vtkDataObject& garments)
{
    std::vector<Positions> worn;
    for (vtkPolyData* garment : garments_in(garments))
        worn.push_back(body_frame_.to_metres(mesh_of(*garment, called(garment_names_, worn.size())).positions));
    const Positions left = body_frame_.to_metres(mesh_of(body, "the body").positions);
    scene_.draped = dressing_from(scene_, dressed_pose_from(find_in(body)), left, worn, garment_names_);
}

// ---- computing -------------------------------------------------------------------------------------------------------

/// Only what this filter makes: what it was given stays.
void FilterState::forget_from(Stage stage)
{
    if (stage <= Stage::rig && makes(Data::rig))
        scene_.rig.reset();
    if (stage <= Stage::fit && makes(Data::fits))
        scene_.fits.clear();
    if (stage <= Stage::drape && makes(Data::draped))
        scene_.draped.reset();
    scene_.recovered.reset();
}

std::vector<double> FilterState::numbers_of(Stage stage) const
{
    Numbers numbers;
    Parameters p = parameters;
    switch (stage) {
    case Stage::rig: describe(p.rig, numbers); break;
    case Stage::fit: describe(p.fit, numbers); break;
    case Stage::drape:
        describe(p.drape, numbers);
        p.recover.frames = 0;
        if (scene_.garments.size() > 1)
            describe_motion(p.recover, numbers);
        break;
    case Stage::recover: describe(p.recover, numbers); break;
    }
    return numbers.values;
}

void FilterState::forget_stale_stages()
{
    for (const Stage stage : filter.stages) {
        std::vector<double> numbers = numbers_of(stage);
        if (made_with_[stage] != numbers)
            forget_from(stage);
        made_with_[stage] = std::move(numbers);
    }
}

bool FilterState::has(Stage stage) const
{
    switch (stage) {
    case Stage::rig: return scene_.rig.has_value();
    case Stage::fit: return !scene_.fits.empty() && scene_.fits.size() == scene_.garments.size();
    case Stage::drape: return scene_.draped.has_value();
    case Stage::recover: return scene_.recovered.has_value();
    }
    return false;
}

/// A stage that is stopped leaves nothing behind; those before it stay.
void FilterState::run(Stage stage, const Progress& progress)
{
    Parameters p = parameters;
    p.recover.cloth = cloth();
    try {
        filter_of(name_of(stage)).run(scene_, p, progress);
    } catch (...) {
        forget_from(stage);
        throw;
    }
}

void FilterState::run(const Progress& progress)
{
    const double n = double(filter.stages.size());
    for (std::size_t i = 0; i < filter.stages.size(); ++i) {
        if (!has(filter.stages[i]))
            run(filter.stages[i], progress.part(double(i) / n, double(i + 1) / n));
        if (scene_.draped && !all_put_on(scene_))
            return;
    }
}

void FilterState::update(vtkPolyData& body, vtkDataObject* garments, const Progress& progress)
{
    describe(filter, parameters, CheckRanges());
    const Source body_now { &body, body.GetMTime(), choices_of_body() };
    const bool new_body = !(body_now == body_source_);
    if (new_body) {
        body_source_ = garment_source_ = Source();
        read_body(body);
        body_source_ = body_now;
    }
    if (garments) {
        const Source garments_now { garments, garments->GetMTime(), choice("GarmentUnit") + choice("GarmentUp") };
        const bool new_garments = !(garments_now == garment_source_);
        if (new_garments) {
            garment_source_ = Source();
            read_garments(*garments);
            if (takes(Data::draped))
                read_worn(body, *garments);
            garment_source_ = garments_now;
        }
    }
    forget_stale_stages();
    run(progress);
}

// ---- writing ---------------------------------------------------------------------------------------------------------

const ClothOptions& FilterState::cloth() const
{
    return filter.has(Stage::drape) ? parameters.drape.cloth : parameters.recover.cloth;
}

Moment FilterState::moment(double time) const { return moment_of(scene_, time, cloth()); }

void FilterState::write_body(vtkPolyData& body, const Moment& now) const
{
    const TriangleMesh& own = scene_.body->surface;
    if (makes(Data::rig)) {
        body.GetPointData()->RemoveArray(k_own);  // of an earlier dressing
        put(body, arrays_of(*scene_.rig, body_frame_));
    } else {
        restore_points(body, k_own);
    }
    if (makes(Data::fits))
        put(body, arrays_of_fits(scene_));
    if (now.body != own.positions)
        move_points(body, k_own, now.body, own.triangles, body_frame_);
    if (const Dressing* dressing = final_dressing(scene_))
        put(body, arrays_of(*dressing, now.pose, garment_names_, body_frame_));
}

void FilterState::write_garments(const std::vector<vtkPolyData*>& garments, const Moment& now) const
{
    for (std::size_t i = 0; i < garments.size(); ++i) {
        put(*garments[i], arrays_of(garment_frames_[i]));
        if (takes(Data::fits) || takes(Data::draped))
            restore_points(*garments[i], k_rest);
        else
            garments[i]->GetPointData()->RemoveArray(k_rest);  // of an earlier dressing
        if (makes(Data::fits))
            put(*garments[i], arrays_of(scene_.fits[i]));
        if (const Dressing* dressing = final_dressing(scene_))
            write_worn(*garments[i], *dressing, i, now);
    }
}

void FilterState::write_worn(vtkPolyData& garment, const Dressing& dressing, std::size_t i, const Moment& now) const
{
    put(garment, arrays_of_worn(dressing, i, body_frame_));
    if (i >= now.garments.size())
        return;
    move_points(garment, k_rest, now.garments[i], scene_.garments[i].mesh.triangles, body_frame_);
    put(garment, arrays_of(now.maps[i], body_frame_));
}

void FilterState::write_skeleton(vtkPolyData& skeleton, const Moment& now) const
{
    draw_skeleton(skeleton, posed(scene_.rig->skeleton, now.pose), body_frame_);
}

std::string FilterState::note() const
{
    const Dressing* dressing = final_dressing(scene_);
    return dressing && !dressing->certified ? explain(*dressing, garment_names_) : "";
}

}  // namespace fit
