// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkRecoverPose
 * @brief   moves a dressed body and its garments back to the input pose of the body
 *
 * Inputs: body and garments of vtkDrapeGarment. Output 0 has the array of points that the body was given with.
 *
 * With SetFrames(n) the filter offers n time steps on the pose path from 0, the fitted pose, to 1, the input pose. All
 * of them are computed at once and kept; another time step computes nothing.
 *
 * @sa vtkFitFilter for ports, arrays and errors
 */
#ifndef vtkRecoverPose_h
#define vtkRecoverPose_h

#include "vtkFitFilter.h"

class VTKFILTERSGARMENT_EXPORT vtkRecoverPose : public vtkFitFilter {
public:
    vtkTypeMacro(vtkRecoverPose, vtkFitFilter);
    static vtkRecoverPose* New();

    /// Parameters of the cloth.
    vtkFitClothParametersMacro();

    /// Parameters of the return to the input pose.
    vtkFitRecoveryParametersMacro();
    vtkFitEndParametersMacro();

    /// The time that an execution may take.
    vtkFitTimeLimitMacro();

protected:
    vtkRecoverPose();
    ~vtkRecoverPose() override = default;

private:
    vtkRecoverPose(const vtkRecoverPose&) = delete;
    void operator=(const vtkRecoverPose&) = delete;
};

#endif
