// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkFitSkeleton
 * @brief   poses a rigged body so that its bones run through the middle of the garment's parts
 *
 * Inputs: the body of vtkRigBody and the garments. Output 0 is the body in the pose of the last garment, output 1 the
 * garments, unmoved.
 *
 * @sa vtkFitFilter for ports, arrays and errors
 */
#ifndef vtkFitSkeleton_h
#define vtkFitSkeleton_h

#include "vtkFitFilter.h"

class VTKFILTERSGARMENT_EXPORT vtkFitSkeleton : public vtkFitFilter {
public:
    vtkTypeMacro(vtkFitSkeleton, vtkFitFilter);
    static vtkFitSkeleton* New();

    /// Parameters of the fit.
    vtkFitFitParametersMacro();

    /// Units and axes of the garments.
    vtkFitGarmentChoicesMacro();

    /// The time that an execution may take.
    vtkFitTimeLimitMacro();

protected:
    vtkFitSkeleton();
    ~vtkFitSkeleton() override = default;

private:
    vtkFitSkeleton(const vtkFitSkeleton&) = delete;
    void operator=(const vtkFitSkeleton&) = delete;
};

#endif
