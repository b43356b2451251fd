// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "garmentfit/filters/warnings.h"
#include "garmentfit/number_text.h"

namespace garmentfit::meshlab {

void Report::warn(const std::vector<std::string>& more) { warnings.insert(warnings.end(), more.begin(), more.end()); }

void report_scene(Report& report, const Fitting& fitting)
{
    const Scene& scene = fitting.scene;
    report.warn(warnings_about_scene(scene, fitting.garment_names, set_by_name));
    report.numbers["side_confidence"] = scene.rig->side_confidence;
    const Dressing* end = final_dressing(scene);
    for (std::size_t i = 0; i < scene.fits.size(); ++i) {
        const std::string& name = fitting.garment_names[i];
        const GarmentType type = scene.fits[i].type;
        report.lines.push_back(end ? in_one_line(name, type, end->garments[i]) + verdict_in_words(*end, i)
                                   : name + " (" + std::string(name_of(type)) + "): fitted");
    }
    if (!end)
        return;
    const Certificate& outermost = end->garments[end->outermost].certificate;
    report.numbers["min_distance"] = outermost.min_distance / fitting.body_frame.metres_per_unit;
    report.numbers["strain_p95"] = outermost.strain.p95;
}

void report_girths(Report& report, const std::vector<Girth>& girths, double metres_per_unit)
{
    const auto centimetres = [](double metres) { return fixed_text(100 * metres, 1) + " cm"; };
    for (const Girth& girth : girths) {
        report.lines.push_back(girth.place + ": body " + centimetres(girth.body) + ", garment "
                               + centimetres(girth.garment) + ", ease " + centimetres(girth.ease()));
        report.numbers[girth.place + " body"] = girth.body / metres_per_unit;
        report.numbers[girth.place + " garment"] = girth.garment / metres_per_unit;
    }
}

}  // namespace garmentfit::meshlab
