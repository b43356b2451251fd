// SPDX-License-Identifier: GPL-3.0-or-later

// The compiled half of the Python package: scenes, the table of filters over them, and mesh files. What users call is
// written in Python on top of it.

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "filters/filters.h"
#include "filters/frame_choice.h"
#include "filters/joint_names.h"
#include "filters/outcome.h"
#include "filters/rig_arrays.h"
#include "fit/error.h"
#include "fit/io.h"
#include "fit/reconstruct.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace fit {
namespace {

/// A matrix that Python reads without a copy while it is called, and one that it keeps without a copy.
using NumbersIn = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using IndicesIn = nb::ndarray<const int, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

Rows rows_from(const NumbersIn& array)
{
    return Eigen::Map<const Rows>(array.data(), Eigen::Index(array.shape(0)), Eigen::Index(array.shape(1)));
}

Positions positions_from(const NumbersIn& array)
{
    if (array.shape(1) != 3)
        throw InvalidInput("positions have " + std::to_string(array.shape(1)) + " columns; give an array of n x 3");
    return rows_from(array);
}

Triangles triangles_from(const IndicesIn& array)
{
    return Eigen::Map<const Triangles>(array.data(), Eigen::Index(array.shape(0)), 3);
}

/// Metres per unit, and the up axis: a frame as another filter has found it.
Frame frame_from(const NumbersIn& row)
{
    const Rows values = rows_from(row);
    if (values.size() != 4 || !(values(0) > 0) || values.rightCols(3).cwiseAbs().sum() != 1)
        throw InvalidInput("a frame is metres per unit and one of the six axes; give what a filter made");
    return { values(0), Vec3(values(1), values(2), values(3)) };
}

/// Moves the matrix onto the heap, where the array that Python gets keeps it alive.
template <class Matrix>
auto array_of(Matrix matrix)
{
    using Scalar = typename Matrix::Scalar;
    auto* kept = new Matrix(std::move(matrix));
    nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<Matrix*>(p); });
    return nb::ndarray<nb::numpy, Scalar, nb::ndim<2>>(kept->data(), { size_t(kept->rows()), size_t(kept->cols()) },
                                                       owner);
}

auto array_of(Eigen::VectorXd vector)
{
    auto* kept = new Eigen::VectorXd(std::move(vector));
    nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<Eigen::VectorXd*>(p); });
    return nb::ndarray<nb::numpy, double, nb::ndim<1>>(kept->data(), { size_t(kept->size()) }, owner);
}

auto frame_row(const Frame& frame)
{
    Rows row(1, 4);
    row << frame.metres_per_unit, frame.up.transpose();
    return array_of(row);
}

// ---- parameters ------------------------------------------------------------------------------------------------

std::string text_of(const nb::handle& value)
{
    if (nb::isinstance<nb::bool_>(value))
        return nb::cast<bool>(value) ? "on" : "off";
    return nb::str(value).c_str();
}

/// @throws InvalidInput naming the parameter.
void set_parameter(const Filter& filter, Parameters& parameters, const std::string& name, const nb::handle& value)
{
    SetByName set { name, text_of(value) };
    describe(filter, parameters, set);
    if (set.found)
        return;
    std::string names;
    describe(filter, parameters,
             [&](const auto&, const About& about) { names += (names.empty() ? "" : ", ") + std::string(about.name); });
    throw InvalidInput(std::string(filter.name) + " has no parameter called \"" + name + "\"; there are " + names);
}

Parameters parameters_from(const Filter& filter, const nb::dict& given)
{
    Parameters parameters;
    for (const auto& [name, value] : given)
        set_parameter(filter, parameters, nb::cast<std::string>(name), value);
    return parameters;
}

/// A value as Python has it: choices by their names.
template <class Value>
nb::object object_of(const Value& value, const About& about)
{
    if constexpr (std::is_enum_v<Value>)
        return nb::str(fit::text_of(value, about).c_str());
    else
        return nb::cast(value);
}

/// [(name, default, range, help), ...]
nb::list parameters_of(const std::string& name)
{
    nb::list list;
    const Parameters defaults;
    describe(filter_of(name), defaults, [&](const auto& value, const About& about) {
        list.append(nb::make_tuple(std::string(about.name), object_of(value, about),
                                   range_of<std::decay_t<decltype(value)>>(about), std::string(about.help)));
    });
    return list;
}

// ---- the scene -------------------------------------------------------------------------------------------------

/// A scene and the door it came in by. Python never changes one that it has handed out: each step works on a copy.
struct PythonScene {
    Scene scene;
    Frame body_frame;
    std::vector<Frame> garment_frames;
    std::vector<std::string> names;
    std::optional<Vec3> front;
    GivenJoints joints;
    ClothOptions cloth;  ///< that the garments were last moved as

    const Dressing& dressing() const
    {
        if (const Dressing* end = final_dressing(scene))
            return *end;
        throw InvalidInput("nothing has been draped yet; run drape_garment first");
    }

    const Rig& rig() const
    {
        if (!scene.rig)
            throw InvalidInput("the body has no rig yet; run rig_body first");
        return *scene.rig;
    }
};

PythonScene scene_of_body(const NumbersIn& positions, const IndicesIn& triangles, const std::string& unit,
                          const std::string& up, const std::string& front,
                          const std::map<std::string, std::vector<double>>& joints, std::optional<NumbersIn> frame)
{
    PythonScene made;
    const Positions in_file = positions_from(positions);
    const Triangles faces = triangles_from(triangles);
    made.body_frame = frame ? frame_from(*frame) : body_frame(in_file, faces, { unit, up }).frame;
    made.scene.body = make_body(made.body_frame.to_metres(in_file), faces);
    if (front != "auto")
        made.front = made.body_frame.rotation() * axis_of(front);
    for (const auto& [name, place] : joints) {
        if (place.size() != 3)
            throw InvalidInput("joint " + name + " has " + std::to_string(place.size()) + " coordinates; give x, y, z");
        joint_of(made.joints, name) = made.body_frame.to_metres(Eigen::Map<const Positions>(place.data(), 1, 3)).row(0);
    }
    return made;
}

void add_garment(PythonScene& scene, const NumbersIn& positions, const IndicesIn& triangles, const std::string& type,
                 const std::string& unit, const std::string& up, const std::string& name,
                 std::optional<NumbersIn> known)
{
    const Positions in_file = positions_from(positions);
    const Triangles faces = triangles_from(triangles);
    const Frame frame
        = known ? frame_from(*known) : garment_frame(in_file, faces, scene.body_frame, { unit, up }).frame;
    scene.scene.garments.push_back({ make_garment(frame.to_metres(in_file), faces), garment_type_of(type) });
    scene.garment_frames.push_back(frame);
    scene.names.push_back(name);
}

/// Runs a filter of the table on a copy. Python may run meanwhile; it is asked at each report whether to go on.
PythonScene run(const PythonScene& given, const std::string& name, const nb::dict& values, const nb::object& progress)
{
    const Filter& filter = filter_of(name);
    Parameters parameters = parameters_from(filter, values);
    parameters.rig.front = given.front;
    parameters.rig.joints = given.joints;
    PythonScene made = given;
    const Progress report([&](double fraction, std::string_view stage) {
        const nb::gil_scoped_acquire python;
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        if (progress.is_none())
            return true;
        const nb::object answer = progress(fraction, std::string(stage));
        return answer.is_none() || nb::cast<bool>(nb::bool_(answer));
    });
    const nb::gil_scoped_release others_may_run;
    filter.run(made.scene, parameters, report);
    made.cloth = filter.has(Stage::drape) ? parameters.drape.cloth : parameters.recover.cloth;
    return made;
}

// ---- what a scene tells ----------------------------------------------------------------------------------------

auto in_body_units(const PythonScene& s, const Positions& metres) { return array_of(s.body_frame.to_file(metres)); }

/// The pose that the scene has come to: the body's own, the fit's, or that of the dressing.
Pose current_pose(const PythonScene& s)
{
    if (const Dressing* end = final_dressing(s.scene))
        return end->pose;
    return s.scene.fits.empty() ? Pose() : s.scene.fits.back().pose;
}

auto body_positions(const PythonScene& s)
{
    if (const Dressing* end = final_dressing(s.scene))
        return in_body_units(s, end->body);
    const Positions& own = s.scene.body->surface.positions;
    if (s.scene.fits.empty())
        return in_body_units(s, own);
    return in_body_units(s, skin(own, s.rig().weights, bone_transforms(s.rig().skeleton, current_pose(s))));
}

/// Whether the body is elsewhere than it was given.
bool is_moved(const PythonScene& s)
{
    if (const Dressing* end = final_dressing(s.scene))
        return end->body != s.scene.body->surface.positions;
    return !s.scene.fits.empty();
}

nb::dict certificate_of(const Certificate& c, double metres_per_unit)
{
    nb::dict made;
    made["body_crossings"] = c.body_crossings;
    made["self_crossings"] = c.self_crossings;
    made["input_self_crossings"] = c.input_self_crossings;
    made["layer_crossings"] = c.layer_crossings;
    made["vertices_inside"] = c.vertices_inside;
    made["smallest_gap"] = c.smallest_gap / metres_per_unit;
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

/// Where the garment is at a share of the way, and how it sits there; at the end where none is asked for.
std::pair<Positions, FitMap> worn_at(const PythonScene& s, std::size_t i, std::optional<double> share)
{
    const Dressing& end = s.dressing();
    for (const RecoverFrame& frame : end.frames)
        if (share && frame.share == *share) {
            WornGarment worn = end.garments[i];
            worn.positions = frame.garments[i];
            return { worn.positions, fit_map({ frame.body, s.scene.body->surface.triangles }, worn, s.cloth) };
        }
    return { end.garments[i].positions, end.maps[i] };
}

nb::list garments_of(const PythonScene& s, std::optional<double> share)
{
    const Dressing& end = s.dressing();
    const double unit = s.body_frame.metres_per_unit;
    nb::list made;
    for (std::size_t i = 0; i < end.garments.size(); ++i) {
        const auto [positions, map] = worn_at(s, i, share);
        nb::dict garment;
        garment["name"] = s.names[i];
        garment["positions"] = in_body_units(s, positions);
        garment["triangles"] = array_of(end.garments[i].rest.triangles);
        garment["certificate"] = certificate_of(end.garments[i].certificate, unit);
        garment["ease"] = array_of(Eigen::VectorXd(map.ease / unit));
        garment["strain"] = array_of(map.strain);
        garment["pressure"] = array_of(map.pressure);
        garment["girths"] = girths_of(end.girths[i], unit);
        garment["too_tight"] = too_tight_of(end, i, unit);
        made.append(garment);
    }
    return made;
}

nb::list fits_of(const PythonScene& s)
{
    nb::list made;
    for (const FitResult& result : s.scene.fits) {
        nb::dict fit;
        fit["type"] = std::string(name_of(result.type));
        fit["type_margin"] = result.type_margin;
        nb::list covered;
        for (const Bone bone : result.covered)
            covered.append(nb::str(bone_name(bone).data()));
        fit["covered"] = covered;
        made.append(fit);
    }
    return made;
}

nb::dict verdict_of(const PythonScene& s)
{
    const Dressing& end = s.dressing();
    nb::dict made;
    made["certified"] = end.certified;
    made["too_small"] = !end.certified && outcome_of(end) == Outcome::too_small;
    made["size_reached"] = end.size_reached;
    made["pose_reached"] = end.pose_reached;
    made["speed"] = end.speed;
    made["note"] = end.certified ? std::string() : explain(end, s.names);
    nb::list held;
    for (const HeldBack& part : end.held_back)
        held.append(nb::make_tuple(part.part, part.distance / s.body_frame.metres_per_unit));
    made["held_back"] = held;
    return made;
}

/// [(share of the way, body, [garment, ...]), ...]
nb::list frames_of(const PythonScene& s)
{
    nb::list made;
    for (const RecoverFrame& frame : s.dressing().frames) {
        nb::list garments;
        for (const Positions& positions : frame.garments)
            garments.append(in_body_units(s, positions));
        made.append(nb::make_tuple(frame.share, in_body_units(s, frame.body), garments));
    }
    return made;
}

/// The joints in the pose that the scene has come to, or at a share of the way from the fitted pose to it.
auto joints_of(const PythonScene& s, std::optional<double> share)
{
    const Pose end = current_pose(s);
    const Pose pose = share && s.scene.draped ? slerp(s.scene.draped->pose, end, *share) : end;
    return in_body_units(s, rows_of(posed(s.rig().skeleton, pose)));
}

// ---- what a scene is made of, to hand on -----------------------------------------------------------------------

nb::dict rig_arrays(const PythonScene& s)
{
    const Rig& rig = s.rig();
    Rows axes(2, 3), radii(int(bone_count), 1), margin(1, 1);
    axes << rig.up.transpose(), rig.front.transpose();
    std::copy(rig.radii.begin(), rig.radii.end(), radii.data());
    margin << rig.side_margin;
    nb::dict made;
    made["BodyFrame"] = frame_row(s.body_frame);
    made["JointIndices"] = array_of(rig.weights.bones);
    made["JointWeights"] = array_of(rig.weights.weights);
    made["RigJoints"] = array_of(rows_of(rig.skeleton));
    made["RigAxes"] = array_of(axes);
    made["RigRadii"] = array_of(radii);
    made["RigSideMargin"] = array_of(margin);
    return made;
}

Rows array_in(const std::map<std::string, NumbersIn>& arrays, const std::string& name, int rows, int columns)
{
    const auto found = arrays.find(name);
    if (found == arrays.end())
        throw InvalidInput("the body has no array " + name + "; rig it first");
    const Rows values = rows_from(found->second);
    if ((rows >= 0 && values.rows() != rows) || values.cols() != columns || !values.allFinite())
        throw InvalidInput("array " + name + " is not what a filter made; rig the body again");
    return values;
}

void set_rig(PythonScene& s, const std::map<std::string, NumbersIn>& arrays)
{
    const Rows axes = array_in(arrays, "RigAxes", 2, 3), radii = array_in(arrays, "RigRadii", bone_count, 1);
    Rig rig;
    rig.weights = weights_of(array_in(arrays, "JointIndices", -1, 4), array_in(arrays, "JointWeights", -1, 4));
    if (rig.weights.weights.rows() != s.scene.body->surface.positions.rows())
        throw InvalidInput("the rig belongs to a body of " + std::to_string(rig.weights.weights.rows())
                           + " vertices, this one has " + std::to_string(s.scene.body->surface.positions.rows())
                           + "; rig this body");
    rig.skeleton = fit::skeleton_of(array_in(arrays, "RigJoints", k_joint_rows, 3));
    rig.up = axes.row(0);
    rig.front = axes.row(1);
    std::copy_n(radii.data(), radii.size(), rig.radii.begin());
    rig.side_margin = array_in(arrays, "RigSideMargin", 1, 1)(0, 0);
    s.scene.rig = rig;
}

auto fit_poses(const PythonScene& s)
{
    Rows poses(s.scene.fits.size(), k_pose_columns);
    for (std::size_t i = 0; i < s.scene.fits.size(); ++i)
        poses.row(Eigen::Index(i)) = row_of(s.scene.fits[i].pose);
    return array_of(poses);
}

void set_fit_poses(PythonScene& s, const NumbersIn& poses)
{
    const Rows rows = rows_from(poses);
    s.scene.fits.assign(rows.rows(), {});
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        s.scene.fits[i].pose = pose_of(rows.row(i));
}

/// The garments as they are worn in a pose, in the body's units; certified anew.
void set_worn(PythonScene& s, const NumbersIn& pose, const std::vector<NumbersIn>& garments)
{
    Dressing draped;
    draped.pose = pose_of(rows_from(pose));
    draped.body
        = skin(s.scene.body->surface.positions, s.rig().weights, bone_transforms(s.rig().skeleton, draped.pose));
    const TriangleMesh skinned { draped.body, s.scene.body->surface.triangles };
    std::vector<TriangleMesh> under;
    if (garments.size() != s.scene.garments.size())
        throw InvalidInput(std::to_string(garments.size()) + " worn garments for "
                           + std::to_string(s.scene.garments.size()) + " as given");
    for (std::size_t i = 0; i < garments.size(); ++i) {
        const GarmentMesh& rest = s.scene.garments[i].mesh;
        const Positions positions = s.body_frame.to_metres(positions_from(garments[i]));
        if (positions.rows() != rest.positions.rows())
            throw InvalidInput(s.names[i] + " is worn with " + std::to_string(positions.rows())
                               + " vertices, as given it has " + std::to_string(rest.positions.rows()));
        draped.garments.push_back({ rest, positions, certify(skinned, rest, positions, under) });
        under.push_back({ positions, rest.triangles });
    }
    draped.certified = all_clean(draped.garments);
    s.scene.draped = std::move(draped);
}

std::vector<std::string> joint_names()
{
    std::vector<std::string> names { "root" };
    for (int b = 0; b < bone_count; ++b)
        names.emplace_back(joint_name(Bone(b)));
    for (int e = 0; e < extremity_count; ++e)
        names.emplace_back(joint_name(Extremity(e)));
    return names;
}

/// [(name of the bone or tip, from joint, to joint), ...]
std::vector<std::tuple<std::string, int, int>> bones()
{
    std::vector<std::tuple<std::string, int, int>> made;
    for (int b = 0; b < bone_count; ++b)
        made.emplace_back(bone_name(b), 1 + parent_of(b), 1 + b);
    for (int e = 0; e < extremity_count; ++e)
        made.emplace_back(joint_name(Extremity(e)), 1 + bone_before(Extremity(e)), 1 + int(bone_count) + e);
    return made;
}

}  // namespace
}  // namespace fit

NB_MODULE(_core, m)
{
    using namespace fit;
    nb::set_leak_warnings(false);  // VTK's Python filters are cycles that Python does not collect at its end
    m.attr("__version__") = FIT_VERSION;
    nb::exception<InvalidInput>(m, "InvalidInput", PyExc_ValueError);
    nb::exception<SolverFailure>(m, "SolverFailure", PyExc_RuntimeError);
    nb::exception<Cancelled>(m, "Cancelled", PyExc_RuntimeError);

    m.def("parameters_of", &parameters_of, "filter"_a,
          nb::sig("def parameters_of(filter: str) -> list[tuple[str, bool | int | float | str, str, str]]"));
    m.def("joint_names", &joint_names);
    m.def("bones", &bones);
    m.def("garment_types", [] {
        std::vector<std::string> names;
        for (const std::string_view name : garment_type_names())
            names.emplace_back(name);
        return names;
    });
    m.def(
        "reconstruct_surface",
        [](const NumbersIn& points) { return array_of(reconstruct_surface(positions_from(points))); }, "points"_a);
    m.def(
        "vertex_normals",
        [](const NumbersIn& positions, const IndicesIn& triangles) {
            return array_of(vertex_normals(positions_from(positions), triangles_from(triangles)));
        },
        "positions"_a, "triangles"_a);

    nb::class_<MeshFile>(m, "MeshFile")
        .def_static("read", &MeshFile::read, "path"_a)
        .def_static("read_points", &MeshFile::read_points, "path"_a)
        .def_prop_ro(
            "positions", [](const MeshFile& file) { return array_of(file.positions()); }, nb::rv_policy::automatic)
        .def_prop_ro(
            "triangles", [](const MeshFile& file) { return array_of(file.triangles()); }, nb::rv_policy::automatic)
        .def_prop_ro("format", [](const MeshFile& file) { return file.format(); })
        .def(
            "write",
            [](const MeshFile& file, const std::filesystem::path& path, const NumbersIn& positions) {
                file.write(path, positions_from(positions));
            },
            "path"_a, "positions"_a);

    nb::class_<PythonScene>(m, "Scene")
        .def_static("of_body", &scene_of_body, "positions"_a, "triangles"_a, "unit"_a, "up"_a, "front"_a, "joints"_a,
                    "frame"_a = nb::none())
        .def("copy", [](const PythonScene& s) { return PythonScene(s); })
        .def("add_garment", &add_garment, "positions"_a, "triangles"_a, "type"_a, "unit"_a, "up"_a, "name"_a,
             "frame"_a = nb::none())
        .def("run", &run, "filter"_a, "parameters"_a, "progress"_a.none())
        .def("rig_arrays", &rig_arrays, nb::sig("def rig_arrays(self) -> dict[str, object]"))
        .def("set_rig", &set_rig, "arrays"_a)
        .def("fit_poses", &fit_poses)
        .def("set_fit_poses", &set_fit_poses, "poses"_a)
        .def("set_worn", &set_worn, "pose"_a, "garments"_a)
        .def("pose", [](const PythonScene& s) { return array_of(row_of(current_pose(s))); })
        .def(
            "pose_at",
            [](const PythonScene& s, double share) {
                return array_of(row_of(slerp(s.scene.draped.value().pose, current_pose(s), share)));
            },
            "share"_a)
        .def("body_positions", &body_positions)
        .def("body_triangles", [](const PythonScene& s) { return array_of(s.scene.body->surface.triangles); })
        .def("skeleton", &joints_of, "share"_a = nb::none())
        .def("fits", &fits_of)
        .def("garments", &garments_of, "share"_a = nb::none())
        .def("verdict", &verdict_of)
        .def("frames", &frames_of)
        .def(
            "garment_frame", [](const PythonScene& s, std::size_t i) { return frame_row(s.garment_frames.at(i)); },
            "garment"_a)
        .def_prop_ro("moved", &is_moved)
        .def_prop_ro("metres_per_unit", [](const PythonScene& s) { return s.body_frame.metres_per_unit; })
        .def_prop_ro("repaired", [](const PythonScene& s) { return s.scene.body->repaired; });
}
