// SPDX-License-Identifier: GPL-3.0-or-later

// Dresses a body in a garment, and draws the ease on the cloth and the skeleton inside into a picture.
//   DressAndDraw BODY.ply GARMENT.ply TYPE PICTURE.png

#include <cstdlib>
#include <iostream>

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDressBody.h"
#include "vtkFieldData.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTubeFilter.h"
#include "vtkWindowToImageFilter.h"

namespace {

constexpr double k_widest_ease = 0.05;  // m, at the red end of the colours

vtkNew<vtkActor> actor_of(vtkAlgorithmOutput* port, double red, double green, double blue)
{
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputConnection(port);
    normals->SplittingOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(normals->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(red, green, blue);
    return actor;
}

vtkNew<vtkActor> heat_map_of(vtkAlgorithmOutput* port)
{
    vtkNew<vtkLookupTable> colours;
    colours->SetHueRange(0.667, 0);  // tight is blue, wide is red
    vtkNew<vtkActor> actor = actor_of(port, 1, 1, 1);
    auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
    mapper->ScalarVisibilityOn();
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray("Ease");
    mapper->SetLookupTable(colours);
    mapper->SetScalarRange(0, k_widest_ease);
    return actor;
}

vtkNew<vtkActor> bones_of(vtkAlgorithmOutput* port)
{
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputConnection(port);
    tubes->SetRadius(0.012);
    tubes->SetNumberOfSides(12);
    return actor_of(tubes->GetOutputPort(), 0.9, 0.6, 0.1);
}

void draw(vtkRenderer* renderer, const char* picture)
{
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(8);
    window->SetSize(700, 900);
    window->AddRenderer(renderer);
    renderer->SetBackground(1, 1, 1);
    renderer->GetActiveCamera()->SetPosition(0.8, 0.5, 3);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Zoom(1.3);
    window->Render();
    vtkNew<vtkWindowToImageFilter> pixels;
    pixels->SetInput(window);
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(pixels->GetOutputPort());
    writer->SetFileName(picture);
    writer->Write();
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 5) {
        std::cerr << "usage: DressAndDraw BODY.ply GARMENT.ply TYPE PICTURE.png\n";
        return EXIT_FAILURE;
    }
    vtkNew<vtkPLYReader> body, garment;
    body->SetFileName(argv[1]);
    garment->SetFileName(argv[2]);

    vtkNew<vtkDressBody> dress;
    dress->SetInputConnection(0, body->GetOutputPort());
    dress->SetInputConnection(1, garment->GetOutputPort());
    dress->SetTypeByName(argv[3]);
    dress->Update();
    vtkFieldData* verdict = dress->GetOutput()->GetFieldData();
    if (!verdict->HasArray("Certified") || verdict->GetArray("Certified")->GetComponent(0, 0) == 0)
        return EXIT_FAILURE;

    vtkNew<vtkActor> skin = actor_of(dress->GetOutputPort(0), 0.87, 0.72, 0.6);
    skin->GetProperty()->SetOpacity(0.35);
    vtkNew<vtkRenderer> renderer;
    renderer->AddActor(skin);
    renderer->AddActor(heat_map_of(dress->GetOutputPort(1)));
    renderer->AddActor(bones_of(dress->GetOutputPort(dress->GetSkeletonPort())));
    draw(renderer, argv[4]);
    return EXIT_SUCCESS;
}
