// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <oneapi/tbb/global_control.h>

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "garmentfit/units.h"

namespace garmentfit::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_crossings_listed = 10;  // unit: what a person looks at

double peak_memory_bytes()
{
    rusage usage {};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * double(usage.ru_maxrss);  // Linux counts kibibytes
}

Json stages_of(const Session& session)
{
    Json stages { { "read", session.read_seconds } };
    for (int s = 0; s < k_stage_count; ++s)
        stages[std::string(name_of(Stage(s)))] = session.scene.seconds[s];
    stages["write"] = session.write_seconds;
    return stages;
}

Json vector_of(const Vec3& v) { return Json { v.x(), v.y(), v.z() }; }

Json sides_of(const std::vector<Bone>& bones)
{
    Json sides = Json::array();
    for (const Bone bone : bones)
        sides.push_back(bone < mirror_of(bone) ? "left" : "right");
    return sides;
}

Json guess_of(const FrameGuess& guess)
{
    return { { "metres_per_unit", guess.frame.metres_per_unit },
             { "unit_confidence", guess.unit_confidence },
             { "up", vector_of(guess.frame.up) },
             { "up_confidence", guess.up_confidence },
             { "why", guess.why } };
}

Json body_of(const Session& session)
{
    const BodyFile& body = session.body;
    Json json { { "file", body.path.filename().string() },
                { "vertices", body.file.positions().rows() },
                { "repaired", session.scene.body->repaired } };
    json.update(guess_of(body.frame));
    json["height"] = height_of(body.file.positions(), body.triangles, body.frame.frame);
    if (const auto& rig = session.scene.rig) {
        json["skeleton"] = session.skeleton;
        json["front"] = vector_of(body.frame.frame.rotation().transpose() * rig->front);
        json["front_confidence"] = rig->side_confidence;
        json["human_probability"] = rig->human_probability;
    }
    return json;
}

/// How many, and those of the longest edges: the vertices of the edge and of the triangle that it passes through,
/// counted from 0.
Json crossings_of(const std::vector<Crossing>& crossings, const WornGarment& garment, double metres_per_unit)
{
    const Triangles& triangles = garment.rest.triangles;
    const auto edges = edges_of(triangles);
    std::vector<std::pair<double, Crossing>> longest;
    for (const Crossing& crossing : crossings) {
        const auto e = crossing.first;
        const double length = (garment.positions.row(edges(e, 0)) - garment.positions.row(edges(e, 1))).norm();
        longest.push_back({ length, crossing });
    }
    std::stable_sort(longest.begin(), longest.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    longest.resize(std::min(longest.size(), k_crossings_listed));
    Json list = Json::array();
    for (const auto& [length, crossing] : longest) {
        const auto& [e, f] = crossing;
        list.push_back({ { "edge", { edges(e, 0), edges(e, 1) } },
                         { "triangle", { triangles(f, 0), triangles(f, 1), triangles(f, 2) } },
                         { "length", length / metres_per_unit } });
    }
    return { { "count", crossings.size() }, { "longest", list } };
}

void put_certificate(Json& json, const WornGarment& garment, double metres_per_unit)
{
    const Certificate& c = garment.certificate;
    json["crossings"] = { { "body", c.body_crossings },
                          { "self", c.self_crossings },
                          { "self_input", c.input_self_crossings },
                          { "self_shifted", c.shifted_self_crossings },
                          { "layers", c.layer_crossings } };
    json["self_kept"] = crossings_of(c.kept_self_crossings, garment, metres_per_unit);
    json["vertices_inside"] = c.vertices_inside;
    json["min_distance"] = c.min_distance / metres_per_unit;
    json["slipped"] = garment.slipped / metres_per_unit;
    json["pieces"] = { { "count", garment.pieces.count },
                       { "seamed", garment.pieces.seamed },
                       { "held", garment.pieces.held },
                       { "free", garment.pieces.free },
                       { "longest_shift", garment.piece_shift / metres_per_unit } };
    json["strain"] = { { "median", c.strain.median }, { "p95", c.strain.p95 }, { "max", c.strain.max } };
}

Json too_tight_of(const Dressing& dressing, std::size_t garment, double metres_per_unit)
{
    Json parts = Json::array();
    for (const TooTight& tight : dressing.too_tight)
        if (tight.garment == int(garment))
            parts.push_back({ { "part", tight.part },
                              { "missing_girth", tight.missing_girth / metres_per_unit },
                              { "enlargement", tight.enlargement } });
    return parts;
}

/// The gap between skin and cloth, and the girths of both.
void put_ease(Json& json, const Dressing& end, std::size_t i, double metres_per_unit)
{
    Eigen::VectorXd ease = end.maps[i].ease / metres_per_unit;
    std::sort(ease.begin(), ease.end());
    json["ease"]
        = { { "smallest", ease[0] }, { "median", ease[ease.size() / 2] }, { "largest", ease[ease.size() - 1] } };
    json["girths"] = Json::array();
    for (const Girth& girth : end.girths[i])
        json["girths"].push_back({ { "place", girth.place },
                                   { "body", girth.body / metres_per_unit },
                                   { "garment", girth.garment / metres_per_unit },
                                   { "ease", girth.ease() / metres_per_unit } });
}

Json overstretched_of(const Overstretch& stretch)
{
    return { { "edges", stretch.edges }, { "largest", stretch.largest }, { "part", stretch.part } };
}

/// What a garment is made of, SI units.
Json cloth_of(const ClothOptions& cloth, Fabric fabric)
{
    const Material material = material_of(cloth, fabric);
    return { { "fabric", fabric_names()[static_cast<int>(fabric)] },
             { "density", material.density },
             { "stretch_stiffness", material.stretch_stiffness },
             { "weft_to_warp", material.weft_to_warp },
             { "shear_stiffness", material.shear_stiffness },
             { "bend_stiffness", material.bend_stiffness },
             { "friction", material.friction },
             { "largest_stretch", material.largest_stretch },
             { "thickness", material.thickness } };
}

/// How the garment fits: as a whole, and in each place.
Json verdict_of(const FitVerdict& verdict)
{
    Json places = Json::array();
    for (const PlaceVerdict& place : verdict.places)
        places.push_back({ { "place", place.place },
                           { "verdict", name_of(place.verdict) },
                           { "stretch", place.stretch },
                           { "pressure", place.pressure } });
    return { { "fit", name_of(verdict.verdict) },
             { "fabric_that_would_do",
               verdict.would_do ? Json(fabric_names()[static_cast<int>(*verdict.would_do)]) : Json() },
             { "places", places } };
}

Json held_back_of(const Dressing& dressing, double metres_per_unit)
{
    Json parts = Json::array();
    for (const HeldBack& held : dressing.held_back)
        parts.push_back({ { "part", held.part }, { "distance", held.distance / metres_per_unit } });
    return parts;
}

Json overlaps_of(const Dressing& dressing, double metres_per_unit)
{
    Json pairs = Json::array();
    for (const Overlap& overlap : dressing.overlaps)
        pairs.push_back({ { "parts", { overlap.part, overlap.other } }, { "depth", overlap.depth / metres_per_unit } });
    return pairs;
}

/// E_B of each covered bone before and after, its clearance, the probabilities of the garment's up and front, and which
/// ways of wearing were tried in vain.
void put_fit(Json& json, const FitResult& fit, double metres_per_unit, const Eigen::Matrix3d& file_from_metres)
{
    json["up"] = vector_of(file_from_metres * fit.up);
    json["up_probability"] = fit.up_probability;
    json["front_probability"] = fit.front_probability;
    json["rejected"] = Json::array();
    for (const Rejected& one : fit.rejected)
        json["rejected"].push_back({ { "type", name_of(one.type) },
                                     { "up", vector_of(file_from_metres * one.up) },
                                     { "front", vector_of(file_from_metres * one.front) },
                                     { "probability", one.probability },
                                     { "reason", one.reason } });
    Json bones;
    for (const Bone bone : fit.covered)
        bones[std::string(bone_name(bone))] = { { "before", fit.scores_before[bone] / metres_per_unit },
                                                { "after", fit.scores[bone] / metres_per_unit },
                                                { "clearance", fit.clearance[bone] } };
    json["score"] = { { "before", fit.score_before / metres_per_unit },
                      { "after", fit.score_after / metres_per_unit },
                      { "bones", bones } };
}

Json conflicts_of(const Session& session)
{
    Json conflicts = Json::array();
    for (const FitConflict& conflict : session.scene.conflicts)
        conflicts.push_back(
            { { "bone", bone_name(conflict.bone) },
              { "garments",
                { session.garments[conflict.garments[0]].name(), session.garments[conflict.garments[1]].name() } },
              { "degrees", k_degrees_per_radian * conflict.angle } });
    return conflicts;
}

int frames_asked(const Call& call) { return call.filter->makes(Data::recovered) ? call.parameters.recover.frames : 0; }

std::size_t frames_written(const Dressing& dressing)
{
    return all_clean(dressing.garments) ? dressing.frames.size() : 0;
}

Json garment_of(const Session& session, const ClothOptions& cloth, std::size_t i)
{
    const Scene& scene = session.scene;
    const double metres_per_unit = session.body.frame.frame.metres_per_unit;
    Json json { { "file", session.garments[i].name() } };
    if (i < scene.fits.size()) {
        const FitResult& fit = scene.fits[i];
        json["type"] = name_of(fit.type);
        json["type_probability"] = fit.type_probability;
        json["layer"] = fit.layer;
        json["covered"] = Json::array();
        for (const Bone bone : fit.covered)
            json["covered"].push_back(bone_name(bone));
        put_fit(json, fit, metres_per_unit, session.body.frame.frame.rotation().transpose());
    }
    if (const Dressing* end = final_dressing(scene)) {
        json["worn"] = end->is_worn(i);
        if (i < end->fabrics.size())
            json["cloth"] = cloth_of(cloth, end->fabrics[i]);
        json["warp_known"] = scene.garments[i].mesh.warps.rows() > 0;
        const std::optional<FitVerdict> verdict = fit_verdict(*end, i);
        json["verdict"] = verdict ? verdict_of(*verdict) : Json();
        if (end->is_worn(i)) {
            put_certificate(json, end->garments[i], metres_per_unit);
            json["size"] = end->garments[i].size;
            json["girth"] = end->garments[i].girth;
            json["too_tight"] = too_tight_of(*end, i, metres_per_unit);
            json["overstretched"] = overstretched_of(end->overstretches[i]);
            json["off_shoulders"] = sides_of(end->off_shoulders[i]);
            json["below_hips"] = sides_of(end->below_hips[i]);
            put_ease(json, *end, i, metres_per_unit);
        }
    }
    json["closed_ends"] = closed_ends(scene, i);
    const LeftOut left_out = left_out_of(scene, i);
    json["left_out"]
        = { { "garments", left_out.garments }, { "solids", left_out.solids },       { "lids", left_out.lids },
            { "specks", left_out.specks },     { "backdrops", left_out.backdrops }, { "faces", left_out.faces } };
    const GarmentFile& file = session.garments[i];
    json["guesses"] = guess_of(file.frame);
    json["guesses"]["scale"] = file.frame.scale;
    json["guesses"]["scale_probability"] = file.frame.scale_probability;
    if (const std::optional<GarmentChoice>& choice = file.choice)
        json["given"] = { { "front", choice->front }, { "as_placed", choice->as_placed }, { "scale", choice->scale } };
    return json;
}

Json time_limit_of(const Call& call, const Session& session)
{
    const Dressing* end = final_dressing(session.scene);
    return { { "seconds", call.parameters.time_limit },
             { "reached_in", end && end->out_of_time ? Json(name_of(*end->out_of_time)) : Json() } };
}

Json json_of(const Call& call, const Session& session)
{
    Json json { { "command", call.filter->name } };
    if (const Dressing* end = final_dressing(session.scene)) {
        json["certified"] = end->certified;
        json["scale_reached"] = end->scale_reached;
        json["pose_reached"] = end->pose_reached;
        json["settled"] = end->residual ? Json(end->residual->is_at_rest()) : Json();
        json["speed"] = end->speed ? Json(*end->speed) : Json();
        json["residual"] = end->residual ? Json { { "mean", end->residual->mean },
                                                  { "percentile_99", end->residual->percentile_99 },
                                                  { "at_rest", end->residual->is_at_rest() } }
                                         : Json();
        const ClothOptions& cloth = call.filter->cloth(call.parameters);
        json["cloth"] = cloth_of(cloth, end->fabrics.empty() ? cloth.fabric : end->fabrics.front());
        json["cloth_seconds"] = { { "detection", end->seconds.detection }, { "solver", end->seconds.solver } };
        json["held_back"] = held_back_of(*end, session.body.frame.frame.metres_per_unit);
        json["pressed_body"] = is_pressed(*end) ? Json(k_pressed_body) : Json();
        json["spikes"] = { { "edges", end->spikes.edges },
                           { "share", end->spiked_share },
                           { "largest", end->spikes.largest },
                           { "part", end->spikes.part } };
        json["overlaps"] = overlaps_of(*end, session.body.frame.frame.metres_per_unit);
        if (const int asked = frames_asked(call); asked > 0)
            json["frames"] = { { "asked", asked }, { "written", frames_written(*end) } };
        if (!end->certified)
            json["note"] = explain(*end, session.garment_names());
    }
    json["stages"] = stages_of(session);
    json["time_limit"] = time_limit_of(call, session);
    json["threads"] = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    json["peak_memory_bytes"] = peak_memory_bytes();
    json["body"] = body_of(session);
    json["garments"] = Json::array();
    for (std::size_t i = 0; i < session.garments.size(); ++i)
        json["garments"].push_back(garment_of(session, call.filter->cloth(call.parameters), i));
    if (session.scene.one_pose) {
        json["one_pose"] = *session.scene.one_pose;
        json["conflicts"] = conflicts_of(session);
    }
    json["warnings"] = session.warnings;
    return json;
}

}  // namespace

std::string report_json(const Call& call, const Session& session)
{
    // a file name need not be UTF-8
    return json_of(call, session).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string error_json(std::string_view code, const std::string& message)
{
    const Json json { { "error", { { "code", code }, { "message", message } } } };
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const Call& call, const Session& session)
{
    std::ostringstream text;
    const BodyFile& body = session.body;
    text << body.path.filename().string() << ": " << body.frame.why << '\n';
    if (const Dressing* end = final_dressing(session.scene))
        for (const std::size_t i : end->worn())
            text << in_one_line(session.garments[i].name(), session.scene.fits[i].type, end->garments[i])
                 << verdict_in_words(*end, i) << '\n';
    else
        for (std::size_t i = 0; i < session.scene.fits.size(); ++i)
            text << session.garments[i].name() << " (" << name_of(session.scene.fits[i].type) << "): fitted\n";
    if (const Dressing* end = final_dressing(session.scene); end && frames_asked(call) > 0)
        text << frames_written(*end) << " of " << frames_asked(call) << " frames\n";
    if (session.scene.one_pose.value_or(false))
        text << "one pose serves all " << session.garments.size() << " garments\n";
    for (const std::string& warning : session.warnings)
        text << "note: " << warning << '\n';
    text << "written to " << call.out.string() << '\n';
    return text.str();
}

}  // namespace garmentfit::cli
