// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkDrapeGarment
 * @brief   drapes the garment on the posed body; cloth and body never cross
 *
 * Inputs: the body of vtkFitSkeleton and the garments it was fitted to. Outputs 0 and 1 are body and garments in the
 * pose of the last garment.
 *
 * @sa vtkFitFilter for ports, arrays and errors
 */
#ifndef vtkDrapeGarment_h
#define vtkDrapeGarment_h

#include "vtkFitFilter.h"

class VTKFILTERSGARMENT_EXPORT vtkDrapeGarment : public vtkFitFilter {
public:
    vtkTypeMacro(vtkDrapeGarment, vtkFitFilter);
    static vtkDrapeGarment* New();

    /// Parameters of the cloth and of draping.
    vtkFitDrapeParametersMacro();

    /// Parameters of the motion of worn garments to the pose of the next one. It has no frames.
    vtkFitRecoveryParametersMacro();

    /// The time that an execution may take.
    vtkFitTimeLimitMacro();

protected:
    vtkDrapeGarment();
    ~vtkDrapeGarment() override = default;

private:
    vtkDrapeGarment(const vtkDrapeGarment&) = delete;
    void operator=(const vtkDrapeGarment&) = delete;
};

#endif
