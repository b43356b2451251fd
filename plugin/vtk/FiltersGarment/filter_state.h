// SPDX-License-Identifier: GPL-3.0-or-later

// What a vtkFitFilter keeps between two executions: its parameters, and the scene that was computed with them.

#ifndef filter_state_h
#define filter_state_h

#include <map>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/snapshot.h"
#include "known_scene.h"
#include "scene_input.h"

#include "vtkType.h"

class vtkDataObject;
class vtkPolyData;

namespace garmentfit {

class FilterState {
public:
    explicit FilterState(const Filter& table_row);

    const Filter& filter;
    Parameters parameters;
    Hints hints;

    /// Number of frames on the pose path; 0 where the filter does not recover the pose.
    int frames() const;

    /// Reads inputs that changed and computes what depends on them.
    /// @throws InvalidInput, SolverFailure, Cancelled; finished stages are kept.
    void update(vtkPolyData& body, vtkDataObject* garments, const Progress& progress);

    const KnownScene& known() const { return known_; }
    /// What the outputs show at a time step.
    Snapshot snapshot(double time) const;
    /// What limits the trust in the result, one line each; the first one says why it is not certified.
    std::vector<std::string> warnings() const;

private:
    /// Identifies the input that a part of the scene was read from.
    struct Source {
        const void* data = nullptr;
        vtkMTimeType time = 0;
        std::string hints;
        bool operator==(const Source& other) const
        {
            return data == other.data && time == other.time && hints == other.hints;
        }
    };

    void read_changed_body(vtkPolyData& body);
    void read_changed_garments(vtkPolyData& body, vtkDataObject& garments);
    void forget_from(Stage stage);
    void forget_stale_stages();
    std::vector<double> numbers_of(Stage stage) const;
    bool has(Stage stage) const;
    void run(Stage stage, const Progress& progress);
    void run(const Progress& progress);

    KnownScene known_;
    Source body_source_, garment_source_;
    std::map<Stage, std::vector<double>> made_with_;  ///< the numbers of each stage's parameters
};

}  // namespace garmentfit

#endif
