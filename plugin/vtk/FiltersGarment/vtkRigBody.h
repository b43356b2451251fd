// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkRigBody
 * @brief   finds the skeleton and the skin weights of a body
 *
 * Input: a body, closed or not. Output 1 is the skeleton.
 *
 * @sa vtkFitFilter for ports, arrays and errors
 */
#ifndef vtkRigBody_h
#define vtkRigBody_h

#include "vtkFitFilter.h"

class VTKFILTERSGARMENT_EXPORT vtkRigBody : public vtkFitFilter {
public:
    vtkTypeMacro(vtkRigBody, vtkFitFilter);
    static vtkRigBody* New();

    /// Parameters of rigging.
    vtkFitRigParametersMacro();

    /// Units and axes of the body.
    vtkFitBodyChoicesMacro();

    /// Known joints.
    vtkFitJointsMacro();

    /// The time that an execution may take.
    vtkFitTimeLimitMacro();

protected:
    vtkRigBody();
    ~vtkRigBody() override = default;

private:
    vtkRigBody(const vtkRigBody&) = delete;
    void operator=(const vtkRigBody&) = delete;
};

#endif
