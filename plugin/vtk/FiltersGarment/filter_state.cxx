// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_state.h"

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/warnings.h"
#include "garmentfit/number_text.h"

#include "vtkDataObject.h"
#include "vtkPolyData.h"

namespace garmentfit {
namespace {

/// Parameters as plain numbers, to detect changes.
struct Numbers {
    std::vector<double> values;
    template <class Value>
    void operator()(const Value& value, const About&)
    {
        if constexpr (is_optional<Value>) {
            values.push_back(value.has_value());
            values.push_back(value.value_or(0));
        } else {
            values.push_back(static_cast<double>(value));
        }
    }
};

std::string sizes_of_body(const Parameters& p) { return p.body_sizes.height ? text_of(*p.body_sizes.height) : "auto"; }

std::string sizes_of_garments(const Parameters& p)
{
    return text_of(p.garment_sizes.scale) + (p.fit.as_placed ? " placed" : "");
}

}  // namespace

FilterState::FilterState(const Filter& table_row) : filter(table_row)
{
    if (!filter.reads(Data::rig))
        for (const char* of_body : { "Unit", "Up", "Front" })
            hints.choices[of_body] = "auto";
    if (filter.reads(Data::garments) && !filter.reads(Data::fits) && !filter.reads(Data::draped))
        for (const char* of_garment : { "GarmentUnit", "GarmentUp", "GarmentFront" })
            hints.choices[of_garment] = "auto";
}

int FilterState::frames() const { return filter.makes(Data::recovered) ? parameters.recover.frames : 0; }

// ---- what changed -------------------------------------------------------------------------------

/// The source is set after a complete read: a failed one is repeated.
void FilterState::read_changed_body(vtkPolyData& body)
{
    const Source now { &body, body.GetMTime(), hints.on_body() + ' ' + sizes_of_body(parameters) };
    if (now == body_source_)
        return;
    body_source_ = garment_source_ = Source();
    known_ = KnownScene();
    known_ = scene_of_body(filter, body, hints, parameters);
    body_source_ = now;
}

void FilterState::read_changed_garments(vtkPolyData& body, vtkDataObject& garments)
{
    const Source now { &garments, garments.GetMTime(), hints.on_garments() + ' ' + sizes_of_garments(parameters) };
    if (now == garment_source_)
        return;
    garment_source_ = Source();
    forget_from(filter.reads(Data::fits) ? Stage::drape : Stage::fit);
    read_garments(known_, filter, garments, hints, parameters);
    if (filter.reads(Data::draped))
        read_worn(known_, body, garments);
    garment_source_ = now;
}

/// Forgets only what this filter makes, not its inputs.
void FilterState::forget_from(Stage stage)
{
    if (stage <= Stage::rig && filter.makes(Data::rig))
        known_.scene.rig.reset();
    if (stage <= Stage::fit && filter.makes(Data::fits)) {
        known_.scene.fits.clear();
        known_.scene.automatic_layers.clear();
    }
    if (stage <= Stage::drape && filter.makes(Data::draped))
        known_.scene.draped.reset();
    known_.scene.recovered.reset();
}

std::vector<double> FilterState::numbers_of(Stage stage) const
{
    Numbers numbers;
    const Parameters& p = parameters;
    if (stage == Stage::drape || stage == Stage::recover)
        describe_time_limit(p.time_limit, numbers);  // may have cut the last result short
    switch (stage) {
    case Stage::rig: describe(p.rig, numbers); break;
    case Stage::fit:
        describe(p.fit, numbers);
        describe_layers(p.layer_order, numbers);
        break;
    case Stage::drape:
        describe(p.drape, numbers);
        if (known_.scene.garments.size() > 1)
            describe_pose_path(p.recover, numbers);
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
    case Stage::rig: return known_.scene.rig.has_value();
    case Stage::fit: return !known_.scene.fits.empty() && known_.scene.fits.size() == known_.scene.garments.size();
    case Stage::drape: return known_.scene.draped.has_value();
    case Stage::recover: return known_.scene.recovered.has_value();
    }
    return false;
}

/// A stage that is stopped leaves no result; earlier stages stay.
void FilterState::run(Stage stage, const Progress& progress)
{
    Parameters p = parameters;
    p.recover.cloth = filter.cloth(parameters);
    try {
        filter_of(name_of(stage)).run(known_.scene, p, progress);
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
        if (known_.scene.draped && !all_put_on(known_.scene))
            return;
    }
}

void FilterState::update(vtkPolyData& body, vtkDataObject* garments, const Progress& progress)
{
    describe(filter, parameters, CheckRanges());
    read_changed_body(body);
    if (garments)
        read_changed_garments(body, *garments);
    forget_stale_stages();
    run(progress.until(Deadline::in(parameters.time_limit)));
}

// ---- what is shown ------------------------------------------------------------------------------

Snapshot FilterState::snapshot(double time) const { return snapshot_of(known_.scene, time, filter.cloth(parameters)); }

std::vector<std::string> FilterState::warnings() const
{
    std::vector<std::string> lines = known_.body_warnings;
    const auto add = [&](const std::vector<std::string>& more) { lines.insert(lines.end(), more.begin(), more.end()); };
    add(known_.garment_frame_warnings);
    if (filter.has(Stage::rig))
        add(warnings_about_rig(known_.scene, set_by_name));
    if (filter.has(Stage::fit))
        add(warnings_about_fits(known_.scene, known_.garment_names, set_by_name));
    add(warnings_about_layers(known_.scene, known_.garment_names, set_by_name));
    const Dressing* dressing = final_dressing(known_.scene);
    if (!dressing)
        return lines;
    add(warnings_about_dressing(*dressing, known_.garment_names));
    if (!dressing->certified)
        lines.insert(lines.begin(), explain(*dressing, known_.garment_names));
    return lines;
}

}  // namespace garmentfit
