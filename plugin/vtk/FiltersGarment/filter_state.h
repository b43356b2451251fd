// SPDX-License-Identifier: GPL-3.0-or-later

// What a vtkFitFilter keeps between two executions: its parameters, and the scene they made.

#ifndef filter_state_h
#define filter_state_h

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "filters/filters.h"
#include "filters/frame_choice.h"
#include "filters/moment.h"

#include "vtkType.h"

class vtkDataObject;
class vtkPolyData;

namespace fit {

class FilterState {
public:
    explicit FilterState(const Filter& table_row) : filter(table_row) { }

    const Filter& filter;
    Parameters parameters;
    std::map<std::string, std::string> choices;  ///< of units and axes; what is missing is "auto"
    std::map<std::string, Vec3> joints;  ///< given, in the body's units and axes

    bool takes(Data data) const;
    bool makes(Data data) const;
    /// States on the way that are asked for; 0 where the filter goes no way.
    int frames() const;

    /// Brings the scene up to date: reads what changed, computes what depends on it.
    /// @throws InvalidInput, SolverFailure, Cancelled; what was computed until then is kept.
    void update(vtkPolyData& body, vtkDataObject* garments, const Progress& progress);

    /// What the outputs show at a time.
    Moment moment(double time) const;
    /// Fills outputs that are shallow copies of the inputs.
    void write_body(vtkPolyData& body, const Moment& now) const;
    void write_garments(const std::vector<vtkPolyData*>& garments, const Moment& now) const;
    void write_skeleton(vtkPolyData& skeleton, const Moment& now) const;
    /// One line where garments could not be put on as they should; else empty.
    std::string note() const;

private:
    /// What a part of the scene was made from.
    struct Source {
        const void* data = nullptr;
        vtkMTimeType time = 0;
        std::string choices;
        bool operator==(const Source& other) const
        {
            return data == other.data && time == other.time && choices == other.choices;
        }
    };

    void read_body(vtkPolyData& data);
    void make_scene_body(const TriangleMesh& mesh);
    std::optional<Vec3> given_front() const;
    GivenJoints given_joints() const;
    void read_garments(vtkDataObject& data);
    void read_worn(vtkPolyData& body, vtkDataObject& garments);
    void forget_from(Stage stage);
    void forget_stale_stages();
    std::vector<double> numbers_of(Stage stage) const;
    bool has(Stage stage) const;
    void run(Stage stage, const Progress& progress);
    void run(const Progress& progress);
    FrameChoice frame_choice(const std::string& prefix) const;
    std::string choice(const std::string& what) const;
    std::string choices_of_body() const;

    const ClothOptions& cloth() const;
    void write_worn(vtkPolyData& garment, const Dressing& dressing, std::size_t i, const Moment& now) const;

    Scene scene_;
    Frame body_frame_;
    std::vector<Frame> garment_frames_;
    std::vector<std::string> garment_names_;
    Source body_source_, garment_source_;
    std::map<Stage, std::vector<double>> made_with_;  ///< the numbers of each stage's parameters
};

}  // namespace fit

#endif
