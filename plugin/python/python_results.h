// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Results of a scene in Python's types. Lengths are in the body's unit.

#include <cstddef>

#include "garmentfit/filters/snapshot.h"
#include "python_scene.h"

namespace garmentfit::python {

/// A scene at one point of the pose path to the body's input pose, with the array names of all hosts.
class PythonSnapshot {
public:
    /// The scene must outlive it.
    PythonSnapshot(const PythonScene& scene, double share);

    nb::object body() const;
    nb::object joints() const;
    nb::object garment(std::size_t i) const;
    std::vector<std::size_t> worn() const { return scene_.dressing().worn(); }
    bool is_body_moved() const;
    nb::dict dressing_arrays() const;
    nb::dict worn_arrays(std::size_t garment) const;
    nb::dict map_arrays(std::size_t garment) const;

private:
    const PythonScene& scene_;
    Snapshot now_;
};

/// [{name, positions, triangles, certificate: {...}, ease, strain, pressure, girths: [...], too_tight: [...], verdict}, ...]
nb::list garments_of(const PythonScene& scene);
/// [{type, type_probability, covered: [bone, ...]}, ...]
nb::list fits_of(const PythonScene& scene);
/// [(bone, (garment, garment), degrees), ...]
nb::list conflicts_of(const PythonScene& scene);
/// {certified, too_small, note, scale_reached, ...}
nb::dict verdict_of(const PythonScene& scene);
/// [(share of the pose path, body, [garment, ...]), ...]
nb::list frames_of(const PythonScene& scene);

}  // namespace garmentfit::python
