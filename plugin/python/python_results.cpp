// SPDX-License-Identifier: GPL-3.0-or-later
#include "python_results.h"

#include <nanobind/stl/string.h>

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "garmentfit/filters/warnings.h"

namespace garmentfit::python {
namespace {

nb::object in_body_units(const PythonScene& s, const Positions& metres)
{
    return nb::cast(array_of(s.body_frame.to_file(metres)));
}

nb::dict certificate_of(const Certificate& c, double metres_per_unit)
{
    nb::dict made;
    made["body_crossings"] = c.body_crossings;
    made["self_crossings"] = c.self_crossings;
    made["input_self_crossings"] = c.input_self_crossings;
    made["kept_self_crossings"] = c.kept_self_crossings.size();
    made["shifted_self_crossings"] = c.shifted_self_crossings;
    made["layer_crossings"] = c.layer_crossings;
    made["vertices_inside"] = c.vertices_inside;
    made["min_distance"] = c.min_distance / metres_per_unit;
    made["strain_median"] = c.strain.median;
    made["strain_p95"] = c.strain.p95;
    made["strain_max"] = c.strain.max;
    return made;
}

nb::list girths_of(const std::vector<Girth>& girths, double metres_per_unit)
{
    nb::list made;
    for (const Girth& girth : girths)
        made.append(nb::make_tuple(girth.place, girth.body / metres_per_unit, girth.garment / metres_per_unit));
    return made;
}

nb::list too_tight_of(const Dressing& end, std::size_t i, double metres_per_unit)
{
    nb::list made;
    for (const TooTight& part : end.too_tight)
        if (part.garment == int(i))
            made.append(nb::make_tuple(part.part, part.missing_girth / metres_per_unit));
    return made;
}

/// (fit, fabric_that_would_do, [(place, fit, stretch, pressure), ...])
nb::object fit_verdict_of(const Dressing& end, std::size_t i)
{
    const std::optional<FitVerdict> verdict = fit_verdict(end, i);
    if (!verdict)
        return nb::none();
    nb::list places;
    for (const PlaceVerdict& place : verdict->places)
        places.append(nb::make_tuple(place.place, std::string(name_of(place.verdict)), place.stretch, place.pressure));
    const nb::object fabric
        = verdict->would_do ? nb::cast(std::string(fabric_names()[static_cast<int>(*verdict->would_do)])) : nb::none();
    return nb::make_tuple(std::string(name_of(verdict->verdict)), fabric, places);
}

nb::dict garment_of(const PythonScene& s, std::size_t i)
{
    const Dressing& end = s.dressing();
    const double unit = s.body_frame.metres_per_unit;
    nb::dict garment;
    garment["name"] = s.names[i];
    garment["positions"] = in_body_units(s, end.garments[i].positions);
    garment["triangles"] = array_of(s.scene.garments[i].mesh.triangles);
    garment["certificate"] = certificate_of(end.garments[i].certificate, unit);
    garment["ease"] = array_of(Eigen::VectorXd(end.maps[i].ease / unit));
    garment["strain"] = array_of(end.maps[i].strain);
    garment["pressure"] = array_of(end.maps[i].pressure);
    garment["girths"] = girths_of(end.girths[i], unit);
    const Overstretch& stretch = end.overstretches[i];
    garment["overstretched"] = nb::make_tuple(stretch.edges, stretch.largest, stretch.part);
    garment["too_tight"] = too_tight_of(end, i, unit);
    garment["verdict"] = fit_verdict_of(end, i);
    return garment;
}

}  // namespace

PythonSnapshot::PythonSnapshot(const PythonScene& scene, double share) :
    scene_(scene), now_(snapshot_of(scene.scene, share, scene.cloth))
{
}

nb::object PythonSnapshot::body() const { return in_body_units(scene_, now_.body); }

nb::object PythonSnapshot::joints() const
{
    return in_body_units(scene_, rows_of(pose_skeleton(scene_.rig().skeleton, now_.pose)));
}

nb::object PythonSnapshot::garment(std::size_t i) const { return in_body_units(scene_, now_.garments.at(i)); }

bool PythonSnapshot::is_body_moved() const { return now_.body != scene_.scene.body->surface.positions; }

nb::dict PythonSnapshot::dressing_arrays() const
{
    return dict_of(arrays_of(scene_.dressing(), now_.pose, scene_.names, scene_.body_frame));
}

nb::dict PythonSnapshot::worn_arrays(std::size_t garment) const
{
    return dict_of(arrays_of_worn(scene_.dressing(), garment, scene_.body_frame));
}

nb::dict PythonSnapshot::map_arrays(std::size_t garment) const
{
    return dict_of(arrays_of(now_.maps.at(garment), scene_.body_frame));
}

nb::list garments_of(const PythonScene& s)
{
    nb::list made;
    for (const std::size_t i : s.dressing().worn())
        made.append(garment_of(s, i));
    return made;
}

nb::list fits_of(const PythonScene& s)
{
    nb::list made;
    for (const FitResult& result : s.scene.fits) {
        nb::dict fit;
        fit["type"] = std::string(name_of(result.type));
        fit["type_probability"] = result.type_probability;
        nb::list covered;
        for (const Bone bone : result.covered)
            covered.append(nb::str(bone_name(bone).data()));
        fit["covered"] = covered;
        fit["layer"] = result.layer;
        made.append(fit);
    }
    return made;
}

nb::list conflicts_of(const PythonScene& s)
{
    nb::list made;
    for (const FitConflict& conflict : s.scene.conflicts)
        made.append(nb::make_tuple(std::string(bone_name(conflict.bone)),
                                   nb::make_tuple(conflict.garments[0], conflict.garments[1]),
                                   k_degrees_per_radian * conflict.angle));
    return made;
}

nb::dict verdict_of(const PythonScene& s)
{
    const Dressing& end = s.dressing();
    nb::dict made;
    made["certified"] = end.certified;
    made["put_on"] = all_put_on(s.scene);
    made["too_small"] = !end.certified && outcome_of(end) == Outcome::too_small;
    made["scale_reached"] = end.scale_reached;
    made["pose_reached"] = end.pose_reached;
    made["speed"] = end.speed ? nb::cast(*end.speed) : nb::none();
    made["residual"] = end.residual ? nb::object(nb::make_tuple(end.residual->mean, end.residual->percentile_99))
                                    : nb::object(nb::none());
    made["note"] = end.certified ? std::string() : explain(end, s.names);
    nb::list warnings;
    const auto add = [&](const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            warnings.append(nb::str(line.c_str()));
    };
    add(s.frame_warnings);
    add(warnings_about_scene(s.scene, s.names, set_by_name));
    made["warnings"] = warnings;
    nb::list held;
    for (const HeldBack& part : end.held_back)
        held.append(nb::make_tuple(part.part, part.distance / s.body_frame.metres_per_unit));
    made["held_back"] = held;
    nb::list overlaps;
    for (const Overlap& overlap : end.overlaps)
        overlaps.append(nb::make_tuple(overlap.part, overlap.other, overlap.depth / s.body_frame.metres_per_unit));
    made["overlaps"] = overlaps;
    return made;
}

nb::list frames_of(const PythonScene& s)
{
    nb::list made;
    for (const RecoverFrame& frame : s.dressing().frames) {
        nb::list garments;
        for (const std::size_t i : s.dressing().worn())
            garments.append(in_body_units(s, frame.garments[i]));
        made.append(nb::make_tuple(frame.share, in_body_units(s, frame.body), garments));
    }
    return made;
}

}  // namespace garmentfit::python
