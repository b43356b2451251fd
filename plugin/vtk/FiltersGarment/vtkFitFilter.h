// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkFitFilter
 * @brief   what the five filters that dress bodies have in common
 *
 * A filter reads a body (port 0, vtkPolyData) and, except vtkRigBody, the garments (port 1): one as vtkPolyData, or
 * several as a composite of vtkPolyData, innermost first, such as vtkMultiBlockDataGroupFilter makes. Results are
 * arrays of the outputs, so that filters can be chained, and files written in between:
 *
 * port 0, the body
 * - point data `JointIndices`, `JointWeights` (4 components each): skin weights, the bones of a vertex and their
 *   weights
 * - point data `InputPosition`: the points of the input, where they were moved
 * - field data `RigJoints`, `RigAxes`, `RigRadii`, `RigSideConfidence`, `FitPoses`, `FitLayers`, `DressedPose`: in
 *   metres with +y up; `BodyFrame`: metres per unit and the up axis of the input
 * - field data after a fit of several garments: `OnePose`; `ConflictBone`, `ConflictGarments`, `ConflictAngle`
 *   (degrees)
 * - field data of a dressed body: `Certified`, `ScaleReached`, `PoseReached`, `Speed` (m/s, of the cloth's fastest
 *   vertex; NaN where the garment is too small and was never settled), `HeldBackPart`, `HeldBackDistance`,
 *   `OverlapPart`, `OverlapOther`, `OverlapDepth`; `Note`: one line where it is not certified; `Warnings`: what limits
 *   the trust in the result, one line each
 *
 * port 1, the garments, of the data type of the input (not of vtkRigBody)
 * - point data `RestPosition`: the points of the input; `Ease`: gap to the skin; `Strain`: mean stretch of the edges;
 *   `Pressure`: Pa
 * - field data `FoundType`, `FoundTypeProbability`, `Worn`, `BodyCrossings`, `SelfCrossings`, `InputSelfCrossings`,
 *   `KeptSelfCrossings`, `ShiftedSelfCrossings`, `LayerCrossings`, `VerticesInside`, `GarmentMinDistance`,
 *   `StrainMedian`, `StrainP95`, `StrainMax`,
 *   `OverstretchedEdges`, `LargestStretch`, `OverstretchedPart`, `TooTightPart`, `MissingGirth`, `GirthPlace`,
 *   `GirthBody`, `GirthGarment`, `Verdict`, `VerdictPlace`, `PlaceVerdict`, `PlaceStretch`, `PlacePressure` (Pa),
 *   `FabricThatWouldDo`
 * - a string `GarmentType` in the field data of an input sets the garment's type, a string `GarmentFront` the axis
 *   that its front faces, a string `GarmentFabric` what it is made of, a number `GarmentScale` its scale, and a number `GarmentAsPlaced` other than 0 says that it
 *   lies round the body already
 *
 * last port, the skeleton: lines with `JointName`, `JointId`, `JointParent` (point data), `BoneName`, `BoneId` (cell
 * data).
 *
 * Lengths are in the body's unit. Cells and all other arrays are passed through without a copy. Points that move are
 * new, and their point normals are computed anew. Polygons are read as fans of triangles; lines and vertices are
 * ignored.
 *
 * Bad input raises an ErrorEvent with one line, sets error code and error name, and empties the outputs. AbortExecute
 * empties them, too; call Modified() and Update() to run again. A garment that is too small is a result and not an
 * error: a warning is raised, `Certified` is 0 and `Note` says why. The lines of `Warnings` are raised as warnings,
 * too.
 *
 * @sa vtkRigBody vtkFitSkeleton vtkDrapeGarment vtkRecoverPose vtkDressBody
 */
#ifndef vtkFitFilter_h
#define vtkFitFilter_h

#include "vtkErrorCode.h"  // for UserError
#include "vtkFiltersGarmentModule.h"  // for export macro
#include "vtkFitParameterMacros.h"  // for subclasses
#include "vtkPolyDataAlgorithm.h"

#include <memory>  // for std::unique_ptr
#include <string>  // for std::string
#include <string_view>  // for std::string_view

namespace garmentfit {
class FilterState;
}

class VTKFILTERSGARMENT_EXPORT vtkFitFilter : public vtkPolyDataAlgorithm {
public:
    vtkTypeMacro(vtkFitFilter, vtkPolyDataAlgorithm);
    void PrintSelf(ostream& os, vtkIndent indent) override;

    /// What GetErrorCode() says after an error.
    enum ErrorCodes {
        InvalidInput = vtkErrorCode::UserError,  ///< an input or a parameter is wrong; the message says what to do
        SolverFailure  ///< no solution was found, or none within the time limit
    };

    /**
   * The kind of the last error for programs: "rig_mismatch", ... of garmentfit/error.h, "solver_failure", "time_limit",
   * or "" without one.
   */
    std::string GetErrorName() { return this->ErrorName; }

    ///@{
    /**
   * Any parameter by its name in the schema, "contact_distance", as text: "0.003", "on", "coat".
   */
    void SetParameter(const char* name, const char* value);
    std::string GetParameter(const char* name);
    ///@}

    ///@{
    /**
   * The names of all parameters of this filter, and one line on each: what it does, range and unit.
   */
    int GetNumberOfParameters();
    std::string GetParameterName(int index);
    std::string GetParameterHelp(const char* name);
    ///@}

    /**
   * The port of the skeleton: 1 of vtkRigBody, 2 of the others.
   */
    int GetSkeletonPort();

    vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
    /// @param name  of the filter in the table of filters/filters.h
    explicit vtkFitFilter(const char* name);
    ~vtkFitFilter() override;

    void SetNumber(const char* name, double value);
    double GetNumber(const char* name);
    double GetSmallest(const char* name);
    double GetLargest(const char* name);
    void SetChoice(const char* what, const char* value);
    const char* GetChoice(const char* what);
    void PutJoint(const char* name, double x, double y, double z);
    void ForgetJoints();

    int FillInputPortInformation(int port, vtkInformation* info) override;
    int FillOutputPortInformation(int port, vtkInformation* info) override;
    int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
    int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
    vtkFitFilter(const vtkFitFilter&) = delete;
    void operator=(const vtkFitFilter&) = delete;

    int RequestDataObject(vtkInformationVector**, vtkInformationVector*);
    void KeepTime(vtkInformationVector**);
    bool GoesOn(double fraction, const std::string& stage);
    void Write(vtkPolyData* body, vtkDataObject* garments, vtkInformationVector* outputs, double time);
    int Stop(vtkInformationVector* outputs);
    int Refuse(vtkInformationVector* outputs, unsigned long code, std::string_view name, const char* message);

    std::unique_ptr<garmentfit::FilterState> State;
    std::string ErrorName;
};

#endif
