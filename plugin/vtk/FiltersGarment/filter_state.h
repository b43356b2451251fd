// SPDX-License-Identifier: GPL-3.0-or-later

// What a vtkFitFilter keeps between two executions: its parameters, and the scene they made.

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

    /// States on the way that are asked for; 0 where the filter goes no way.
    int frames() const;

    /// Brings the scene up to date: reads what changed, computes what depends on it.
    /// @throws InvalidInput, SolverFailure, Cancelled; what was computed until then is kept.
    void update(vtkPolyData& body, vtkDataObject* garments, const Progress& progress);

    const KnownScene& known() const { return known_; }
    /// What the outputs show at a time.
    Snapshot moment(double time) const;
    /// What the user should know of how the garments ended up, one line each: first why they could not be put on as they should.
    std::vector<std::string> warnings() const;

private:
    /// What a part of the scene was made from.
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
