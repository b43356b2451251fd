// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkOutfitWriter
 * @brief   writes a dressed body and its garments as one skinned GLB, or VRM, that other programs can pose
 *
 * Inputs: body (port 0) and garments (port 1) of vtkRecoverPose or vtkDressBody, or files of them that were read again.
 * The file has one skeleton and skin weights for the body and each garment, in the body's own pose. Point coordinates
 * for textures (TCoords) are written as UVs. Only what is free of crossings is written, and never half a file. With
 * BodyFileName, the outfit is the avatar's own file with the garments added.
 *
 * @code
 * writer->SetInputConnection(0, dress->GetOutputPort(0));
 * writer->SetInputConnection(1, dress->GetOutputPort(1));
 * writer->SetFileName("outfit.glb");
 * writer->SetBones("mixamo");
 * writer->Write();
 * @endcode
 *
 * Write() returns 0 after an error: an ErrorEvent says in one line what is wrong, and the error code is set.
 *
 * @sa vtkFitFilter for the arrays that are read
 */
#ifndef vtkOutfitWriter_h
#define vtkOutfitWriter_h

#include "vtkFiltersGarmentModule.h"  // for export macro
#include "vtkWriter.h"

#include <string>  // for std::string

class VTKFILTERSGARMENT_EXPORT vtkOutfitWriter : public vtkWriter {
public:
    vtkTypeMacro(vtkOutfitWriter, vtkWriter);
    static vtkOutfitWriter* New();
    void PrintSelf(ostream& os, vtkIndent indent) override;

    ///@{
    /**
   * The file, .glb or .vrm. A missing folder is made.
   */
    vtkSetStdStringFromCharMacro(FileName);
    vtkGetCharFromStdStringMacro(FileName);
    ///@}

    ///@{
    /**
   * The skinned glTF, GLB or VRM that the body was read from, by any reader that left its vertices where they are. With
   * the bones `own`, the outfit is this file with the garments added: its joints, weights, materials, animations and
   * parts that the body lacks stay as they are. A file without a skin is a warning, and the joints are those of
   * garmentfit; a file without the body's vertices is an error. Empty by default: the file is not known.
   */
    vtkSetStdStringFromCharMacro(BodyFileName);
    vtkGetCharFromStdStringMacro(BodyFileName);
    ///@}

    ///@{
    /**
   * Names and number of the joints: own (default), garmentfit, vrm, mixamo, unreal or smpl. Own are those of the file
   * BodyFileName, or those of garmentfit without one. A .vrm file has those of VRM.
   */
    vtkSetStdStringFromCharMacro(Bones);
    vtkGetCharFromStdStringMacro(Bones);
    ///@}

    ///@{
    /**
   * Leaves out faces of the body that the garments cover in the rest pose and in poses of everyday movement, and, but
   * on the bones of BodyFileName, draws in skin under cloth by up to 6 cm (of an adult).
   */
    vtkSetMacro(HideCoveredSkin, bool);
    vtkGetMacro(HideCoveredSkin, bool);
    vtkBooleanMacro(HideCoveredSkin, bool);
    ///@}

    ///@{
    /**
   * At most so many joints move a vertex of the garments: 4 (default), which all programs read, up to 8, in a second set
   * of joints and weights.
   */
    vtkSetClampMacro(Influences, int, 1, 8);
    vtkGetMacro(Influences, int);
    ///@}

protected:
    vtkOutfitWriter();
    ~vtkOutfitWriter() override = default;

    int FillInputPortInformation(int port, vtkInformation* info) override;
    void WriteData() override;

private:
    vtkOutfitWriter(const vtkOutfitWriter&) = delete;
    void operator=(const vtkOutfitWriter&) = delete;

    std::string FileName;
    std::string BodyFileName;
    std::string Bones = "own";
    bool HideCoveredSkin = false;
    int Influences = 4;
};

#endif
