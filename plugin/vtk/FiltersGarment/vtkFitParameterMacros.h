// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Set and Get of every parameter of garmentfit/filters/schema.h. A value out of its range is moved to the nearer end,
 * as by vtkSetClampMacro. Range, unit, default and meaning are in the schema only (vtkFitFilter::GetParameterHelp). A
 * test fails when the schema has a parameter that is missing here.
 */
#ifndef vtkFitParameterMacros_h
#define vtkFitParameterMacros_h

#define vtkFitNumberMacro(Name, type, name)                                                                            \
    virtual void Set##Name(type value) { this->SetNumber(#name, value); }                                              \
    virtual type Get##Name() { return static_cast<type>(this->GetNumber(#name)); }                                     \
    virtual type Get##Name##MinValue() { return static_cast<type>(this->GetSmallest(#name)); }                         \
    virtual type Get##Name##MaxValue() { return static_cast<type>(this->GetLargest(#name)); }

#define vtkFitSwitchMacro(Name, name)                                                                                  \
    virtual void Set##Name(bool value) { this->SetNumber(#name, value); }                                              \
    virtual bool Get##Name() { return this->GetNumber(#name) != 0; }                                                   \
    virtual void Name##On() { this->Set##Name(true); }                                                                 \
    virtual void Name##Off() { this->Set##Name(false); }

/// One of several named values: the number in the order of the names, or the name itself.
#define vtkFitChoiceMacro(Name, name)                                                                                  \
    virtual void Set##Name(int value) { this->SetNumber(#name, value); }                                               \
    virtual int Get##Name() { return static_cast<int>(this->GetNumber(#name)); }                                       \
    virtual void Set##Name##ByName(const char* value) { this->SetParameter(#name, value); }                            \
    virtual std::string Get##Name##AsString() { return this->GetParameter(#name); }

#define vtkFitRigParametersMacro()                                                                                     \
    vtkFitNumberMacro(ProxyVertices, int, proxy_vertices);                                                             \
    vtkFitSwitchMacro(SwapSides, swap_sides);                                                                          \
    vtkFitChoiceMacro(Humanlike, humanlike);                                                                           \
    vtkFitNumberMacro(Height, double, height)

#define vtkFitFitParametersMacro()                                                                                     \
    vtkFitChoiceMacro(Type, type);                                                                                     \
    vtkFitChoiceMacro(Method, method);                                                                                 \
    vtkFitNumberMacro(Iterations, int, iterations);                                                                    \
    vtkFitChoiceMacro(Nearest, nearest);                                                                               \
    vtkFitSwitchMacro(AsPlaced, as_placed);                                                                            \
    vtkFitNumberMacro(GarmentScale, double, garment_scale);                                                            \
    vtkFitChoiceMacro(LayerOrder, layer_order)

#define vtkFitClothParametersMacro()                                                                                   \
    vtkFitChoiceMacro(Fabric, fabric);                                                                                 \
    vtkFitNumberMacro(ContactDistance, double, contact_distance);                                                      \
    vtkFitNumberMacro(MinDistance, double, min_distance);                                                              \
    vtkFitNumberMacro(Density, double, density);                                                                       \
    vtkFitNumberMacro(StretchStiffness, double, stretch_stiffness);                                                    \
    vtkFitNumberMacro(WeftToWarp, double, weft_to_warp);                                                               \
    vtkFitNumberMacro(ShearStiffness, double, shear_stiffness);                                                        \
    vtkFitNumberMacro(BendStiffness, double, bend_stiffness);                                                          \
    vtkFitNumberMacro(Friction, double, friction);                                                                     \
    vtkFitNumberMacro(LargestStretch, double, largest_stretch)

#define vtkFitDrapeParametersMacro()                                                                                   \
    vtkFitClothParametersMacro();                                                                                      \
    vtkFitNumberMacro(Enlarge, double, enlarge);                                                                       \
    vtkFitNumberMacro(GrowingSteps, int, growing_steps);                                                               \
    vtkFitNumberMacro(SettlingSteps, int, settling_steps)

#define vtkFitRecoveryParametersMacro()                                                                                \
    vtkFitNumberMacro(RecoverySteps, int, recovery_steps);                                                             \
    vtkFitNumberMacro(RecoveryStepLength, double, recovery_step_length);                                               \
    vtkFitNumberMacro(RecoverySettlingSteps, int, recovery_settling_steps)

#define vtkFitEndParametersMacro()                                                                                     \
    vtkFitChoiceMacro(Quality, quality);                                                                               \
    vtkFitNumberMacro(SettleTime, double, settle_time);                                                                \
    vtkFitNumberMacro(Press, double, press);                                                                           \
    vtkFitNumberMacro(Frames, int, frames)

#define vtkFitTimeLimitMacro() vtkFitNumberMacro(TimeLimit, double, time_limit)

/// Unit and axes of a body: "auto", or "m", "dm", "cm", "mm", "in", "ft" for the unit, "+x" to "-z" for the axes up and
/// front (where the chest faces).
#define vtkFitBodyChoicesMacro()                                                                                       \
    virtual void SetUnit(const char* unit) { this->SetChoice("Unit", unit); }                                          \
    virtual const char* GetUnit() { return this->GetChoice("Unit"); }                                                  \
    virtual void SetUp(const char* axis) { this->SetChoice("Up", axis); }                                              \
    virtual const char* GetUp() { return this->GetChoice("Up"); }                                                      \
    virtual void SetFront(const char* axis) { this->SetChoice("Front", axis); }                                        \
    virtual const char* GetFront() { return this->GetChoice("Front"); }

/// The same of garments; the front is where a garment's front faces.
#define vtkFitGarmentChoicesMacro()                                                                                    \
    virtual void SetGarmentUnit(const char* unit) { this->SetChoice("GarmentUnit", unit); }                            \
    virtual const char* GetGarmentUnit() { return this->GetChoice("GarmentUnit"); }                                    \
    virtual void SetGarmentUp(const char* axis) { this->SetChoice("GarmentUp", axis); }                                \
    virtual const char* GetGarmentUp() { return this->GetChoice("GarmentUp"); }                                        \
    virtual void SetGarmentFront(const char* axis) { this->SetChoice("GarmentFront", axis); }                          \
    virtual const char* GetGarmentFront() { return this->GetChoice("GarmentFront"); }

/// Joints set by the user ("lelbow", ...; docs/rig.md has the names), in the body's units and axes.
#define vtkFitJointsMacro()                                                                                            \
    virtual void SetJoint(const char* name, double x, double y, double z) { this->PutJoint(name, x, y, z); }           \
    virtual void RemoveAllJoints() { this->ForgetJoints(); }

#endif
