// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkOutfitWriter.h"

#include "garmentfit/error.h"
#include "garmentfit/filters/outfit.h"
#include "garmentfit/filters/scene_arrays.h"
#include "garmentfit/filters/snapshot.h"
#include "polydata.h"
#include "scene_input.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <exception>
#include <vector>

vtkStandardNewMacro(vtkOutfitWriter);

namespace {

using namespace garmentfit;

/// UVs of the points. Those of glTF count from the top.
Appearance look_of(vtkPolyData& data, const Triangles& triangles)
{
    Appearance look;
    vtkDataArray* uvs = data.GetPointData()->GetTCoords();
    if (!uvs || uvs->GetNumberOfComponents() < 2)
        return look;
    look.uvs.resize(uvs->GetNumberOfTuples(), 2);
    for (vtkIdType i = 0; i < uvs->GetNumberOfTuples(); ++i)
        look.uvs.row(i) << uvs->GetComponent(i, 0), 1 - uvs->GetComponent(i, 1);
    look.uv_corners = triangles;
    return look;
}

void require_own_pose(vtkPolyData& body)
{
    const bool is_moved = body.GetPointData()->HasArray(k_input_position)
        && mesh_at(body, k_input_position, "the body").positions != mesh_of(body, "the body").positions;
    if (is_moved)
        throw InvalidInput(ErrorCode::missing_input,
                           "an outfit shows the body in its own pose; connect what Recover Pose or Dress Body made");
}

}  // namespace

vtkOutfitWriter::vtkOutfitWriter() { this->SetNumberOfInputPorts(2); }

int vtkOutfitWriter::FillInputPortInformation(int port, vtkInformation* info)
{
    if (port == 1)  // before vtkPolyData: the executive iterates over blocks unless the first type accepts composites
        info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    return 1;
}

void vtkOutfitWriter::WriteData()
{
    vtkPolyData* body = vtkPolyData::SafeDownCast(this->GetInput(0));
    vtkDataObject* garments = this->GetInput(1);
    try {
        if (!body || !garments)
            throw InvalidInput(ErrorCode::missing_input, "connect a dressed body to port 0 and its garments to port 1");
        OutfitRequest request { this->FileName, bone_names_called(this->Bones), this->HideCoveredSkin };
        request.influences = this->Influences;
        require_own_pose(*body);
        KnownScene known = scene_of_dressed(*body, *garments);
        if (!request.bones && !this->BodyFileName.empty()) {
            request.avatar = avatar_of_body(this->BodyFileName, known.scene.body->surface.positions, known.body_frame);
            if (!request.avatar)
                vtkWarningMacro(
                    << this->BodyFileName
                    << ": has no skin, so the outfit has the joints of garmentfit; give the skinned file of "
                       "the body, or no BodyFileName");
        }
        std::vector<OutfitPart> parts;
        const std::vector<vtkPolyData*> leaves = garments_in(*garments);
        for (std::size_t i = 0; i < leaves.size(); ++i)
            parts.push_back({ known.garment_names[i], look_of(*leaves[i], known.scene.garments[i].mesh.triangles) });
        known.scene.recovered = std::move(known.scene.draped);
        const Triangles& skin = known.scene.body->surface.triangles;
        write_outfit(known.scene, { "body", look_of(*body, skin) }, parts, request);
    } catch (const InvalidInput& error) {
        this->SetErrorCode(vtkErrorCode::UserError);
        vtkErrorMacro(<< error.what());
    } catch (const std::exception& error) {
        this->SetErrorCode(vtkErrorCode::UnknownError);
        vtkErrorMacro(<< error.what());
    }
}

void vtkOutfitWriter::PrintSelf(ostream& os, vtkIndent indent)
{
    this->Superclass::PrintSelf(os, indent);
    os << indent << "FileName: " << this->FileName << "\n";
    os << indent << "BodyFileName: " << this->BodyFileName << "\n";
    os << indent << "Bones: " << this->Bones << "\n";
    os << indent << "HideCoveredSkin: " << this->HideCoveredSkin << "\n";
    os << indent << "Influences: " << this->Influences << "\n";
}
