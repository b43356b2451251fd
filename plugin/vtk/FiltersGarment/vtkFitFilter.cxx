// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkFitFilter.h"

#include "filter_state.h"
#include "garmentfit/error.h"
#include "named_parameters.h"
#include "scene_output.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVersionMacros.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace {

using garmentfit::Data;

/// Copies a composite's structure with shallow copies of its leaves, and returns the leaves in order.
std::vector<vtkPolyData*> copy_leaves(vtkDataObject& from, vtkDataObject& to)
{
    if (vtkPolyData* one = vtkPolyData::SafeDownCast(&to)) {
        one->ShallowCopy(&from);
        return { one };
    }
    auto* source = vtkCompositeDataSet::SafeDownCast(&from);
    auto* target = vtkCompositeDataSet::SafeDownCast(&to);
    target->CopyStructure(source);
    std::vector<vtkPolyData*> leaves;
    auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(source->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem()) {
        auto copy = vtkSmartPointer<vtkPolyData>::New();
        copy->ShallowCopy(leaf->GetCurrentDataObject());
        target->SetDataSet(leaf, copy);
        leaves.push_back(copy);
    }
    return leaves;
}

void empty(vtkInformationVector& outputs)
{
    for (int port = 0; port < outputs.GetNumberOfInformationObjects(); ++port)
        vtkDataObject::GetData(&outputs, port)->Initialize();
}

bool is_surface_or_several(vtkDataObject* data)
{
    return data && (data->IsA("vtkPolyData") || data->IsA("vtkCompositeDataSet"));
}

/// Whether a filter upstream was aborted.
bool is_aborted_upstream(vtkAlgorithm& filter)
{
    for (int port = 0; port < filter.GetNumberOfInputPorts(); ++port) {
        vtkAlgorithm* before
            = filter.GetNumberOfInputConnections(port) > 0 ? filter.GetInputAlgorithm(port, 0) : nullptr;
        if (before && (before->GetAbortExecute() || is_aborted_upstream(*before)))
            return true;
    }
    return false;
}

double requested_time(vtkInformation* request, vtkInformationVector* outputs)
{
    int port = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
    vtkInformation* info = outputs->GetInformationObject(std::max(port, 0));
    const auto key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    return info->Has(key) ? info->Get(key) : 1;
}

}  // namespace

vtkFitFilter::vtkFitFilter(const char* name) :
    State(std::make_unique<garmentfit::FilterState>(garmentfit::filter_of(name)))
{
    const bool dresses = this->State->filter.reads(Data::garments);
    this->SetNumberOfInputPorts(dresses ? 2 : 1);
    this->SetNumberOfOutputPorts(dresses ? 3 : 2);
}

vtkFitFilter::~vtkFitFilter() = default;

// ---- parameters ---------------------------------------------------------------------------------

void vtkFitFilter::SetNumber(const char* name, double number)
{
    if (garmentfit::set_number(this->State->filter, this->State->parameters, name, number))
        this->Modified();
}

double vtkFitFilter::GetNumber(const char* name)
{
    return garmentfit::number_of(this->State->filter, this->State->parameters, name);
}

double vtkFitFilter::GetSmallest(const char* name)
{
    return garmentfit::range_of_number(this->State->filter, name).first;
}

double vtkFitFilter::GetLargest(const char* name)
{
    return garmentfit::range_of_number(this->State->filter, name).second;
}

void vtkFitFilter::SetParameter(const char* name, const char* text)
{
    if (!garmentfit::has_parameter(this->State->filter, name)) {
        vtkErrorMacro("no parameter is called \"" << (name ? name : "") << "\"; GetParameterName lists them");
        return;
    }
    try {
        if (garmentfit::set_text(this->State->filter, this->State->parameters, name, text))
            this->Modified();
    } catch (const garmentfit::InvalidInput& error) {
        vtkErrorMacro(<< error.what());
    }
}

std::string vtkFitFilter::GetParameter(const char* name)
{
    return garmentfit::text_of(this->State->filter, this->State->parameters, name);
}

int vtkFitFilter::GetNumberOfParameters()
{
    return static_cast<int>(garmentfit::parameter_names(this->State->filter).size());
}

std::string vtkFitFilter::GetParameterName(int index)
{
    const std::vector<std::string> names = garmentfit::parameter_names(this->State->filter);
    return index >= 0 && index < static_cast<int>(names.size()) ? names[index] : "";
}

std::string vtkFitFilter::GetParameterHelp(const char* name) { return garmentfit::help_on(this->State->filter, name); }

int vtkFitFilter::GetSkeletonPort() { return this->GetNumberOfOutputPorts() - 1; }

void vtkFitFilter::SetChoice(const char* what, const char* value)
{
    std::string& choice = this->State->hints.choices.at(what);
    const std::string chosen = value ? value : "auto";
    if (choice == chosen)
        return;
    choice = chosen;
    this->Modified();
}

const char* vtkFitFilter::GetChoice(const char* what) { return this->State->hints.choices.at(what).c_str(); }

void vtkFitFilter::PutJoint(const char* name, double x, double y, double z)
{
    this->State->hints.joints[name ? name : ""] = { x, y, z };
    this->Modified();
}

void vtkFitFilter::ForgetJoints()
{
    this->State->hints.joints.clear();
    this->Modified();
}

void vtkFitFilter::PrintSelf(ostream& os, vtkIndent indent)
{
    this->Superclass::PrintSelf(os, indent);
    garmentfit::describe(this->State->filter, this->State->parameters,
                         [&](const auto& value, const garmentfit::About& about) {
                             os << indent << about.label << ": " << garmentfit::text_of(value, about)
                                << (about.unit.empty() ? "" : " ") << about.unit << "\n";
                         });
    for (const auto& [what, value] : this->State->hints.choices)
        os << indent << what << ": " << value << "\n";
    for (const auto& [name, place] : this->State->hints.joints)
        os << indent << "Joint " << name << ": " << place.transpose() << "\n";
}

// ---- the pipeline -------------------------------------------------------------------------------

int vtkFitFilter::FillInputPortInformation(int port, vtkInformation* info)
{
    if (port == 0)
        return this->Superclass::FillInputPortInformation(port, info);
    // the composite first: the executive iterates over blocks unless the first type accepts composites
    info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
    info->Append(INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    return 1;
}

int vtkFitFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
    const bool garments = port == 1 && port != this->GetSkeletonPort();
    info->Set(vtkDataObject::DATA_TYPE_NAME(), garments ? "vtkDataObject" : "vtkPolyData");
    return 1;
}

vtkTypeBool vtkFitFilter::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
    if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
        return this->RequestDataObject(inputs, outputs);
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    if (request->Has(Pipeline::REQUEST_UPDATE_TIME()) || request->Has(Pipeline::REQUEST_UPDATE_EXTENT()))
        this->KeepTime(inputs);
    return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkFitFilter::RequestDataObject(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port) {
        const bool garments = port == 1 && port != this->GetSkeletonPort();
        vtkDataObject* given = garments ? vtkDataObject::GetData(inputs[1]) : nullptr;
        vtkDataObject* like = is_surface_or_several(given) ? given : nullptr;
        vtkInformation* info = outputs->GetInformationObject(port);
        vtkDataObject* made = vtkDataObject::GetData(info);
        const char* type = like ? like->GetClassName() : "vtkPolyData";
        if (made && made->IsA(type))
            continue;
        auto output = vtkSmartPointer<vtkDataObject>::Take(like ? like->NewInstance() : vtkPolyData::New());
        info->Set(vtkDataObject::DATA_OBJECT(), output);
    }
    for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
        if (!is_surface_or_several(vtkDataObject::GetData(inputs[port]))) {  // the executive reports this and stops
            empty(*outputs);
            this->SetErrorCode(InvalidInput);
            this->ErrorName = name_of(garmentfit::ErrorCode::missing_input);
        }
    return 1;
}

/// Time steps on the pose path belong to this filter. Passed upstream, each would make a reader with time steps read
/// again, and this filter compute again.
void vtkFitFilter::KeepTime(vtkInformationVector** inputs)
{
    for (int port = 0; this->State->frames() > 0 && port < this->GetNumberOfInputPorts(); ++port)
        for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
            inputs[port]->GetInformationObject(i)->Remove(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
}

int vtkFitFilter::RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
    const int frames = this->State->frames();
    std::vector<double> steps;
    for (int i = 0; i < frames; ++i)
        steps.push_back(frames > 1 ? double(i) / (frames - 1) : 1);
    double range[2] = { 0, 1 };
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port) {
        vtkInformation* info = outputs->GetInformationObject(port);
        if (steps.empty()) {
            info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
            info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
            continue;
        }
        info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps.data(), frames);
        info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    }
    return 1;
}

bool vtkFitFilter::GoesOn(double fraction, const std::string& stage)
{
    this->SetProgressText(stage.c_str());
    this->UpdateProgress(fraction);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
    return !this->CheckAbort();
#else
    return !this->GetAbortExecute();
#endif
}

int vtkFitFilter::Stop(vtkInformationVector* outputs)
{
    empty(*outputs);
    return 1;
}

int vtkFitFilter::Refuse(vtkInformationVector* outputs, unsigned long code, std::string_view name, const char* message)
{
    empty(*outputs);
    this->SetErrorCode(code);
    this->ErrorName = name;
    vtkErrorMacro(<< message);
    return 0;
}

void vtkFitFilter::Write(vtkPolyData* body, vtkDataObject* garments, vtkInformationVector* outputs, double time)
{
    const garmentfit::Filter& filter = this->State->filter;
    const garmentfit::KnownScene& known = this->State->known();
    const garmentfit::Snapshot now = this->State->snapshot(time);
    vtkPolyData* dressed = vtkPolyData::GetData(outputs, 0);
    dressed->ShallowCopy(body);
    garmentfit::write_body(*dressed, filter, known, now);
    if (garments)
        garmentfit::write_garments(copy_leaves(*garments, *vtkDataObject::GetData(outputs, 1)), filter, known, now);
    garmentfit::write_skeleton(*vtkPolyData::GetData(outputs, this->GetSkeletonPort()), known, now);
    for (int port = 0; this->State->frames() > 0 && port < this->GetNumberOfOutputPorts(); ++port)
        vtkDataObject::GetData(outputs, port)->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
}

int vtkFitFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
    this->SetErrorCode(vtkErrorCode::NoError);
    this->ErrorName.clear();
    vtkPolyData* body = vtkPolyData::GetData(inputs[0]);
    vtkDataObject* garments = this->GetNumberOfInputPorts() > 1 ? vtkDataObject::GetData(inputs[1]) : nullptr;
    if (body->GetNumberOfPoints() == 0 && is_aborted_upstream(*this))
        return this->Stop(outputs);
    try {
        this->State->update(*body, garments, garmentfit::Progress([this](double fraction, std::string_view stage) {
            return this->GoesOn(fraction, std::string(stage));
        }));
        this->Write(body, garments, outputs, requested_time(request, outputs));
        for (const std::string& warning : this->State->warnings())
            vtkWarningMacro(<< warning);
        return 1;
    } catch (const garmentfit::Cancelled&) {
        return this->Stop(outputs);
    } catch (const garmentfit::InvalidInput& error) {
        return this->Refuse(outputs, InvalidInput, name_of(error.code()), error.what());
    } catch (const garmentfit::TimeLimitReached& error) {
        return this->Refuse(outputs, SolverFailure, "time_limit", error.what());
    } catch (const std::exception& error) {
        return this->Refuse(outputs, SolverFailure, "solver_failure", error.what());
    }
}
