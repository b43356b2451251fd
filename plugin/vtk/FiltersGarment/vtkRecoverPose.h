// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkRecoverPose
 * @brief   brings a dressed body back to its own pose, the garments along
 *
 * Inputs: body and garments of vtkDrapeGarment. Output 0 has the points that the body was given with, the very same array.
 *
 * With SetFrames(n) the filter offers n time steps from 0, the pose fitted, to 1, the body's own pose, so that the way can be
 * scrubbed and written as a series. All of them are computed at once and kept; another time computes nothing again.
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

    /// Parameters of the way back.
    vtkFitRecoveryParametersMacro();
    vtkFitFramesParameterMacro();

protected:
    vtkRecoverPose();
    ~vtkRecoverPose() override = default;

private:
    vtkRecoverPose(const vtkRecoverPose&) = delete;
    void operator=(const vtkRecoverPose&) = delete;
};

#endif
