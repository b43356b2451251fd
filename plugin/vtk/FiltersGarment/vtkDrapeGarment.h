// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkDrapeGarment
 * @brief   puts the posed body into the garment without letting cloth and body cross
 *
 * Inputs: the body of vtkFitSkeleton and the garments it was fitted to. Outputs 0 and 1 are body and garments in the pose of the
 * last garment.
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

    /// How garments already worn move on to the pose of the next one; of that way no frames are handed out.
    vtkFitRecoveryParametersMacro();

protected:
    vtkDrapeGarment();
    ~vtkDrapeGarment() override = default;

private:
    vtkDrapeGarment(const vtkDrapeGarment&) = delete;
    void operator=(const vtkDrapeGarment&) = delete;
};

#endif
