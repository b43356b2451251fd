// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_state.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "filters/joint_names.h"
#include "filters/outcome.h"
#include "fit/error.h"
#include "scene_data.h"

#include "vtkDataObject.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace fit {
namespace {

constexpr const char* k_own = "OwnPosition";
constexpr const char* k_rest = "RestPosition";
constexpr const char* k_body_frame = "BodyFrame";
constexpr const char* k_garment_frame = "GarmentFrame";

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
        const TriangleMesh mesh = mesh_at(data, k_own, "the body");
        scene_.rig = rig_in(data);
        body_frame_ = frame_in(data, k_body_frame);
        scene_.body = make_body(body_frame_.to_metres(mesh.positions), mesh.triangles);
    } else {
        const TriangleMesh mesh = mesh_of(data, "the body");
        body_frame_ = body_frame(mesh.positions, mesh.triangles, frame_choice("")).frame;
        scene_.body = make_body(body_frame_.to_metres(mesh.positions), mesh.triangles);
    }
    if (takes(Data::fits))
        scene_.fits = fits_in(data);
    if (makes(Data::rig)) {
        RigOptions& known = parameters.rig;
        const std::string front = choice("Front");
        known.front.reset();
        if (front != "auto")
            known.front = body_frame_.rotation() * axis_of(front);
        known.joints = {};
        for (const auto& [name, place] : joints)
            joint_of(known.joints, name) = body_frame_.to_metres(Positions(place.transpose())).row(0);
    }
}

void FilterState::read_garments(vtkDataObject& data)
{
    forget_from(takes(Data::fits) ? Stage::drape : Stage::fit);
    scene_.garments.clear();
    garment_frames_.clear();
    garment_names_ = garment_names_in(data);
    const bool as_given = takes(Data::fits) || takes(Data::draped);
    for (vtkPolyData* garment : garments_in(data)) {
        const std::string name = called(garment_names_, scene_.garments.size());
        const TriangleMesh mesh = as_given ? mesh_at(*garment, k_rest, name) : mesh_of(*garment, name);
        const Frame frame = as_given && has_frame(*garment, k_garment_frame)
            ? frame_in(*garment, k_garment_frame)
            : garment_frame(mesh.positions, mesh.triangles, body_frame_, frame_choice("Garment")).frame;
        garment_frames_.push_back(frame);
        scene_.garments.push_back(
            { make_garment(frame.to_metres(mesh.positions), mesh.triangles), given_type(*garment) });
    }
}

/// The garments as they are worn in the pose that the body was left in.
void FilterState::read_worn(vtkPolyData& body, vtkDataObject& garments)
{
    Dressing draped;
    draped.pose = pose_in(body);
    const Rig& rig = *scene_.rig;
    draped.body = skin(scene_.body->surface.positions, rig.weights, bone_transforms(rig.skeleton, draped.pose));
    const TriangleMesh skinned { draped.body, scene_.body->surface.triangles };
    std::vector<TriangleMesh> under;
    for (vtkPolyData* garment : garments_in(garments)) {
        const std::size_t i = draped.garments.size();
        const Positions positions = body_frame_.to_metres(mesh_of(*garment, called(garment_names_, i)).positions);
        const GarmentMesh& rest = scene_.garments[i].mesh;
        draped.garments.push_back({ rest, positions, certify(skinned, rest, positions, under) });
        under.push_back({ positions, rest.triangles });
    }
    draped.certified = all_clean(draped.garments);
    scene_.draped = std::move(draped);
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
        if (scene_.draped && !scene_.draped->certified)
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

const Dressing* FilterState::end() const
{
    return makes(Data::draped) || makes(Data::recovered) ? final_dressing(scene_) : nullptr;
}

/// The state on the way that is nearest to a time; none at the end, which is the result itself.
const RecoverFrame* FilterState::frame_at(double time) const
{
    const Dressing* dressing = end();
    if (!dressing || dressing->frames.empty() || time >= 1)
        return nullptr;
    return &*std::min_element(dressing->frames.begin(), dressing->frames.end(),
                              [time](const RecoverFrame& a, const RecoverFrame& b) {
                                  return std::abs(a.share - time) < std::abs(b.share - time);
                              });
}

Pose FilterState::pose_at(double time) const
{
    if (const RecoverFrame* frame = frame_at(time))
        return slerp(scene_.draped->pose, Pose(), frame->share);
    if (const Dressing* dressing = end())
        return dressing->pose;
    return scene_.fits.empty() ? Pose() : scene_.fits.back().pose;
}

void FilterState::write_body(vtkPolyData& body, double time) const
{
    const TriangleMesh& own = scene_.body->surface;
    const Rig& rig = *scene_.rig;
    if (makes(Data::rig)) {
        body.GetPointData()->RemoveArray(k_own);  // of an earlier dressing
        put_frame(body, k_body_frame, body_frame_);
        put_rig(body, rig);
    } else
        restore_points(body, k_own);
    if (makes(Data::fits))
        put_fits(body, scene_.fits);

    const RecoverFrame* frame = frame_at(time);
    const Dressing* dressing = end();
    const Positions now = frame ? frame->body
        : dressing              ? dressing->body
                                : skin(own.positions, rig.weights, bone_transforms(rig.skeleton, pose_at(time)));
    if (now != own.positions)
        move_points(body, k_own, now, own.triangles, body_frame_);
    if (dressing) {
        put_pose(body, pose_at(time));
        put_dressing(body, *dressing, note(), body_frame_.metres_per_unit);
    }
}

void FilterState::write_garments(const std::vector<vtkPolyData*>& garments, double time) const
{
    const RecoverFrame* frame = frame_at(time);
    const Dressing* dressing = end();
    for (std::size_t i = 0; i < garments.size(); ++i) {
        vtkPolyData& garment = *garments[i];
        put_frame(garment, k_garment_frame, garment_frames_[i]);
        if (makes(Data::fits))
            put_fit(garment, scene_.fits[i]);
        if (takes(Data::fits) || takes(Data::draped))
            restore_points(garment, k_rest);
        else
            garment.GetPointData()->RemoveArray(k_rest);  // of an earlier dressing
        if (!dressing)
            continue;
        put_worn(garment, *dressing, i, body_frame_.metres_per_unit);
        if (i >= dressing->garments.size())
            continue;
        WornGarment worn = dressing->garments[i];
        if (frame)
            worn.positions = frame->garments[i];
        move_points(garment, k_rest, worn.positions, worn.rest.triangles, body_frame_);
        put_map(garment,
                frame ? fit_map({ frame->body, scene_.body->surface.triangles }, worn, cloth()) : dressing->maps[i],
                body_frame_.metres_per_unit);
    }
}

void FilterState::write_skeleton(vtkPolyData& skeleton, double time) const
{
    draw_skeleton(skeleton, posed(scene_.rig->skeleton, pose_at(time)), body_frame_);
}

std::string FilterState::note() const
{
    const Dressing* dressing = end();
    return dressing && !dressing->certified ? explain(*dressing, garment_names_) : "";
}

}  // namespace fit
