// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkDressBody
 * @brief   dresses a body in garments made for somebody else: rig, fit, drape, recover
 *
 * Inputs: the body and the garments as given. A changed parameter or garment repeats only the steps that depend on it.
 * SetFrames(n) adds time steps, as in vtkRecoverPose.
 *
 * @sa vtkFitFilter for ports, arrays and errors
 */
#ifndef vtkDressBody_h
#define vtkDressBody_h

#include "vtkFitFilter.h"

class VTKFILTERSGARMENT_EXPORT vtkDressBody : public vtkFitFilter {
public:
    vtkTypeMacro(vtkDressBody, vtkFitFilter);
    static vtkDressBody* New();

    /// Parameters of rigging.
    vtkFitRigParametersMacro();

    /// Units and axes of the body.
    vtkFitBodyChoicesMacro();

    /// Known joints.
    vtkFitJointsMacro();

    /// Parameters of the fit.
    vtkFitFitParametersMacro();

    /// Units and axes of the garments.
    vtkFitGarmentChoicesMacro();

    /// Parameters of the cloth and of draping.
    vtkFitDrapeParametersMacro();

    /// Parameters of the return to the input pose.
    vtkFitRecoveryParametersMacro();
    vtkFitEndParametersMacro();

    /// The time that an execution may take.
    vtkFitTimeLimitMacro();

protected:
    vtkDressBody();
    ~vtkDressBody() override = default;

private:
    vtkDressBody(const vtkDressBody&) = delete;
    void operator=(const vtkDressBody&) = delete;
};

#endif
