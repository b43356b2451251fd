// SPDX-License-Identifier: GPL-3.0-or-later

// The compiled half of the Python package: scenes, the table of filters, and mesh files. The functions for users are
// written in Python on top of it.

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/reconstruct.h"
#include "garmentfit/version.h"
#include "garmentfit/worn_clothes.h"
#include "plugin/cli/program.h"
#include "python_results.h"
#include "python_scene.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace garmentfit::python {
namespace {

std::vector<std::string> type_names() { return { garment_type_names().begin(), garment_type_names().end() }; }

auto reconstruct(const NumbersIn& points) { return array_of(reconstruct_surface(positions_from(points))); }

auto normals_of(const NumbersIn& positions, const IndicesIn& triangles)
{
    return array_of(vertex_normals(positions_from(positions), triangles_from(triangles)));
}

void write(const MeshFile& file, const std::filesystem::path& path, const NumbersIn& positions)
{
    file.write(path, positions_from(positions));
}

void write_mesh(const std::filesystem::path& path, const NumbersIn& positions, const IndicesIn& triangles)
{
    write_ply(path, positions_from(positions), triangles_from(triangles));
}

/// Runs the command line's program. It replaces Python's handler of Ctrl-C.
int run_program(std::vector<std::string> words)
{
    const nb::gil_scoped_release other_threads_run;
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    const int count = int(pointers.size());
    pointers.push_back(nullptr);
    const int code = cli::run_program(count, pointers.data());
    std::cout.flush();
    return code;
}

/// The exception with the attribute `code`, the name of the ErrorCode.
void bind_invalid_input(nb::module_& m)
{
    const nb::exception<InvalidInput> type(m, "InvalidInput", PyExc_ValueError);
    type.attr("code") = std::string(name_of(ErrorCode::invalid_input));
    nb::register_exception_translator(  // comes before the translator of nb::exception, which sets no code
        [](const std::exception_ptr& thrown, void* payload) {
            try {
                std::rethrow_exception(thrown);
            } catch (const InvalidInput& error) {
                const nb::handle type(static_cast<PyObject*>(payload));
                nb::object made = type(error.what());
                made.attr("code") = std::string(name_of(error.code()));
                PyErr_SetObject(type.ptr(), made.ptr());
            }
        },
        type.ptr());
}

void bind_functions(nb::module_& m)
{
    m.def("parameters_of", &parameters_of, "filter"_a,
          nb::sig("def parameters_of(filter: str) -> list[tuple[str, bool | int | float | str, str, str, str]]"));
    m.def("garment_types", &type_names);
    m.def("skeleton_lines", &skeleton_lines, "(from joint, to joint) of the bones, then of the tips");
    m.def("skeleton_arrays", [] { return dict_of(arrays_of_skeleton()); });
    m.def("reconstruct_surface", &reconstruct, "points"_a);
    m.def("vertex_normals", &normals_of, "positions"_a, "triangles"_a);
    m.def("run_program", &run_program, "words"_a);
    m.def("write_mesh", &write_mesh, "path"_a, "positions"_a, "triangles"_a);
}

void bind_mesh_file(nb::module_& m)
{
    nb::class_<MeshFile>(m, "MeshFile")
        .def_static("read", &MeshFile::read, "path"_a)
        .def_static("read_points", &MeshFile::read_points, "path"_a)
        .def_prop_ro(
            "positions", [](const MeshFile& file) { return array_of(file.positions()); }, nb::rv_policy::automatic)
        .def_prop_ro(
            "triangles", [](const MeshFile& file) { return array_of(file.triangles()); }, nb::rv_policy::automatic)
        .def_prop_ro(
            "corner_uvs", [](const MeshFile& file) { return array_of(file.corner_uvs()); }, nb::rv_policy::automatic,
            "Of each triangle u0 v0 u1 v1 u2 v2; without rows: none")
        .def_prop_ro("format", [](const MeshFile& file) { return file.format(); })
        .def("write", &write, "path"_a, "positions"_a);
    nb::class_<StrippedBody>(m, "StrippedBody", "What of an avatar's file is its body")
        .def_ro("stripped", &StrippedBody::stripped)
        .def_ro("scenery", &StrippedBody::scenery);
    m.def(
        "find_body",
        [](const MeshFile& file, const std::string& wears) { return find_body(file, wears_called(wears)); }, "file"_a,
        "wears"_a, "None where all parts of the file stay");
    m.def(
        "triangles_of_body",
        [](const MeshFile& file, const StrippedBody& left) { return array_of(triangles_of(file, left)); }, "file"_a,
        "left"_a);
    m.def("require_no_body", &require_no_body, "garment"_a);
}

void bind_snapshot(nb::module_& m)
{
    nb::class_<PythonSnapshot>(m, "Snapshot", "A scene at one point of the pose path to the body's input pose")
        .def("body", &PythonSnapshot::body)
        .def("joints", &PythonSnapshot::joints)
        .def("garment", &PythonSnapshot::garment, "garment"_a)
        .def_prop_ro("worn", &PythonSnapshot::worn, "Indices of the worn garments")
        .def_prop_ro("is_body_moved", &PythonSnapshot::is_body_moved)
        .def("dressing_arrays", &PythonSnapshot::dressing_arrays)
        .def("worn_arrays", &PythonSnapshot::worn_arrays, "garment"_a)
        .def("map_arrays", &PythonSnapshot::map_arrays, "garment"_a);
}

void bind_scene(nb::module_& m)
{
    nb::class_<PythonScene>(m, "Scene")
        .def_static("of_body", &scene_of_body, "positions"_a, "triangles"_a, "unit"_a, "up"_a, "front"_a, "joints"_a,
                    "sizes"_a)
        .def_static("of_rigged", &scene_of_rigged, "positions"_a, "triangles"_a, "find"_a, "fitted"_a)
        .def("copy", [](const PythonScene& s) { return PythonScene(s); })
        .def("add_garment", &add_garment, "positions"_a, "triangles"_a, "corner_uvs"_a, "type"_a, "unit"_a, "up"_a,
             "front"_a, "sizes"_a, "name"_a, "find"_a = nb::none())
        .def("set_body_file", &set_body_file, "file"_a, "left"_a.none())
        .def("set_garment_look", &set_garment_look, "file"_a, "left"_a.none())
        .def("write_animation", &write_animation_of, "path"_a, "seconds"_a)
        .def("write_outfit", &write_outfit_of, "path"_a, "bones"_a, "hide_covered_skin"_a, "influences"_a)
        .def("set_worn", &set_worn, "find"_a, "body"_a, "garments"_a)
        .def("run", &run, "filter"_a, "parameters"_a, "progress"_a.none())
        .def(
            "snapshot", [](const PythonScene& s, double share) { return PythonSnapshot(s, share); }, "share"_a = 1.0,
            nb::keep_alive<0, 1>())
        .def("rig_arrays", [](const PythonScene& s) { return dict_of(arrays_of(s.rig(), s.body_frame)); })
        .def("fit_arrays", [](const PythonScene& s) { return dict_of(arrays_of_fits(s.scene)); })
        .def(
            "garment_arrays",
            [](const PythonScene& s, std::size_t i) { return dict_of(arrays_of(s.garment_frames.at(i))); }, "garment"_a)
        .def(
            "found_arrays", [](const PythonScene& s, std::size_t i) { return dict_of(arrays_of(s.scene.fits.at(i))); },
            "garment"_a)
        .def("fits", &fits_of)
        .def("conflicts", &conflicts_of)
        .def("garments", &garments_of)
        .def("verdict", &verdict_of)
        .def("frames", &frames_of)
        .def_prop_ro("metres_per_unit", [](const PythonScene& s) { return s.body_frame.metres_per_unit; })
        .def_prop_ro("repaired", [](const PythonScene& s) { return s.scene.body->repaired; });
}

}  // namespace
}  // namespace garmentfit::python

NB_MODULE(_core, m)
{
    using namespace garmentfit;
    using namespace garmentfit::python;
    nb::set_leak_warnings(false);  // VTK's Python filters are reference cycles, which Python does not collect at exit
    m.attr("__version__") = GARMENTFIT_VERSION;
    bind_invalid_input(m);
    const nb::exception<SolverFailure> failure(m, "SolverFailure", PyExc_RuntimeError);
    nb::exception<TimeLimitReached>(m, "TimeLimitReached", failure.ptr()).attr("code") = "time_limit";
    nb::exception<Cancelled>(m, "Cancelled", PyExc_RuntimeError);
    bind_functions(m);
    bind_mesh_file(m);
    bind_snapshot(m);
    bind_scene(m);
}
