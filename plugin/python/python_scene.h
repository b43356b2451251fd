// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A scene, the frames of its inputs, and the filters that run on it. A scene that Python holds never changes: each step
// works on a copy.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "garmentfit/appearance.h"
#include "garmentfit/filters/filters.h"
#include "garmentfit/io.h"
#include "garmentfit/units.h"
#include "garmentfit/worn_clothes.h"
#include "numpy_arrays.h"

namespace garmentfit::python {

struct PythonScene {
    Scene scene;
    Frame body_frame;
    std::vector<Frame> garment_frames;
    std::vector<std::string> names;
    std::vector<std::string> frame_warnings;  ///< one line for each guess of unit, axes and scale that is uncertain
    std::optional<Vec3> front;
    GivenJoints joints;
    std::optional<MeshFile> body_file;  ///< none where the body was made of arrays
    bool is_stripped = false;  ///< clothes in that file are left out of the body
    std::shared_ptr<const Appearance> body_look;  ///< of the body's file; null where it was made of arrays
    std::vector<std::shared_ptr<const Appearance>> garment_looks;  ///< of each garment, or null
    ClothOptions cloth;  ///< of the last step that moved the garments

    /// @throws InvalidInput naming the step that is missing.
    const Rig& rig() const;
    const Dressing& dressing() const;
};

/// A body as it was given. @param sizes  the parameters of rigging; of them, height  @throws InvalidInput.
PythonScene scene_of_body(const NumbersIn& positions, const IndicesIn& triangles, const std::string& unit,
                          const std::string& up, const std::string& front,
                          const std::map<std::string, std::vector<double>>& joints, const nb::dict& sizes);
/// A body that a filter has rigged, and posed where `fitted`; find(name) returns its arrays. @throws InvalidInput.
PythonScene scene_of_rigged(const NumbersIn& positions, const IndicesIn& triangles, const nb::object& find,
                            bool fitted);

/// Reads the array GarmentFrame where an earlier filter has written one.
/// @param sizes  the parameters of fitting; of them, garment_scale and as_placed; and garment_fabric  @throws InvalidInput.
/// @param uvs    of the corners of each triangle, m x 6; without rows: none
void add_garment(PythonScene& scene, const NumbersIn& positions, const IndicesIn& triangles, const NumbersIn& uvs,
                 const std::string& type, const std::string& unit, const std::string& up, const std::string& front,
                 const nb::dict& sizes, const std::string& name, const nb::object& find);
/// Sets body and garments as worn in the body's DressedPose, in its units. @throws InvalidInput.
void set_worn(PythonScene& scene, const nb::object& find, const NumbersIn& body,
              const std::vector<NumbersIn>& garments);

/// UVs, materials and pictures of the file that the body, or the garment that was added last, was read from.
/// @param left  what is left of the file without its clothes; null where all of it is the body or the garment
void set_body_file(PythonScene& scene, const MeshFile& file, const StrippedBody* left);
void set_garment_look(PythonScene& scene, const MeshFile& file, const StrippedBody* left);

/// Body and garments as one skinned file that other programs can pose. Other Python threads run meanwhile.
/// @throws InvalidInput.
void write_outfit_of(const PythonScene& scene, const std::filesystem::path& path, const std::string& bones,
                     bool hide_covered_skin, int influences);

/// The frames on the pose path as one GLB that other programs can play. Other Python threads run meanwhile.
/// @param seconds  how long it is
/// @throws InvalidInput where there are none.
void write_animation_of(const PythonScene& scene, const std::filesystem::path& path, double seconds);

/// Runs a filter of the table on a copy. Other Python threads run meanwhile; progress(fraction, stage) returns False to
/// stop.
PythonScene run(const PythonScene& given, const std::string& name, const nb::dict& values, const nb::object& progress);

/// [(name, default, type, range, help), ...] of a filter.
nb::list parameters_of(const std::string& filter);

}  // namespace garmentfit::python
