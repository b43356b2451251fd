// SPDX-License-Identifier: GPL-3.0-or-later
#include "panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextMapper.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace garmentfit::picture {
namespace {

using Colour = std::array<double, 3>;

// Looks. No result depends on them; all are matters of taste.

constexpr Colour k_skin { 0.87, 0.68, 0.55 }, k_paper { 1, 1, 1 }, k_ink { 0.15, 0.15, 0.2 };
constexpr Colour k_cloth[]
    = { { 0.25, 0.47, 0.70 }, { 0.93, 0.69, 0.26 }, { 0.35, 0.60, 0.42 } };  // outer sides, by layer
constexpr Colour k_bones[] = { { 0.25, 0.25, 0.3 }, { 0.1, 0.35, 0.85 }, { 0.85, 0.15, 0.1 } };  // middle, left, right
constexpr Colour k_uncovered_bone { 0.6, 0.6, 0.6 };  // not covered
constexpr double k_see_through_cloth = 0.3;  // opacity; of each of two or more sheets in front of a bone
constexpr double k_see_through = 0.45, k_bone_thickness = 0.012;  // opacity; of half the picture's height
constexpr Colour k_lining { 0.80, 0.30, 0.30 };  // back faces of all cloth
constexpr double k_narrowest = 0.42, k_widest = 1;  // width / height of a panel; a caption must fit under it
constexpr double k_legend_aspect = 0.22;  // width / height of the strip at the right
constexpr double k_margin = 1.06;  // space around the largest body
constexpr double k_text_height = 0.075;  // of the picture, above and below the figures

vtkNew<vtkPolyDataNormals> shaded(const TriangleMesh& mesh)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        points->InsertNextPoint(mesh.positions.row(v).data());
    vtkNew<vtkCellArray> faces;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        faces->InsertNextCell({ mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2) });
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(faces);
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputData(data);
    normals->SplittingOff();
    normals->ConsistencyOff();
    return normals;
}

vtkNew<vtkActor> actor_of(const TriangleMesh& mesh, const Colour& colour)
{
    const vtkNew<vtkPolyDataNormals> source = shaded(mesh);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
    actor->GetProperty()->SetAmbient(0.15);
    actor->GetProperty()->SetDiffuse(0.85);
    return actor;
}

vtkNew<vtkActor> cloth_of(const TriangleMesh& mesh, std::size_t layer)
{
    vtkNew<vtkActor> actor = actor_of(mesh, k_cloth[layer % std::size(k_cloth)]);
    vtkNew<vtkProperty> lining;
    lining->DeepCopy(actor->GetProperty());
    lining->SetColor(k_lining[0], k_lining[1], k_lining[2]);
    actor->SetBackfaceProperty(lining);
    return actor;
}

/// Between blue and red, white in the middle of the scale.
vtkNew<vtkColorTransferFunction> colours_of(const Scale& scale)
{
    vtkNew<vtkColorTransferFunction> colours;
    colours->SetColorSpaceToDiverging();
    colours->AddRGBPoint(scale.red_is_low ? scale.high : scale.low, 0.23, 0.30, 0.75);
    colours->AddRGBPoint(scale.red_is_low ? scale.low : scale.high, 0.71, 0.02, 0.15);
    return colours;
}

vtkNew<vtkActor> coloured_cloth(const TriangleMesh& mesh, const Eigen::VectorXd& values, const Scale& scale)
{
    vtkNew<vtkActor> actor = actor_of(mesh, k_cloth[0]);
    vtkNew<vtkDoubleArray> scalars;
    for (const double value : values)
        scalars->InsertNextValue(value);
    auto* normals = vtkPolyDataNormals::SafeDownCast(actor->GetMapper()->GetInputAlgorithm());
    vtkPolyData::SafeDownCast(normals->GetInput())->GetPointData()->SetScalars(scalars);
    actor->GetMapper()->SetLookupTable(colours_of(scale));
    actor->GetMapper()->UseLookupTableScalarRangeOn();
    actor->GetMapper()->ScalarVisibilityOn();
    return actor;
}

vtkNew<vtkScalarBarActor> legend_of(const Scale& scale, int font)
{
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(colours_of(scale));
    bar->SetTitle(scale.title.c_str());
    bar->SetNumberOfLabels(5);
    bar->SetLabelFormat("%-#.3g");
    bar->UnconstrainedFontSizeOn();
    for (vtkTextProperty* text : { bar->GetTitleTextProperty(), bar->GetLabelTextProperty() }) {
        text->SetColor(k_ink[0], k_ink[1], k_ink[2]);
        text->SetFontSize(font);
        text->ShadowOff();
        text->ItalicOff();
        text->BoldOff();
    }
    bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedDisplay();
    return bar;
}

/// Transparent, in the colours of the bones that move each vertex.
vtkNew<vtkActor> transparent_body(const State& state)
{
    vtkNew<vtkActor> actor = actor_of(state.body, k_skin);
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    for (Eigen::Index v = 0; v < state.colours.rows(); ++v)
        colours->InsertNextTuple3(255 * state.colours(v, 0), 255 * state.colours(v, 1), 255 * state.colours(v, 2));
    auto* normals = vtkPolyDataNormals::SafeDownCast(actor->GetMapper()->GetInputAlgorithm());
    vtkPolyData::SafeDownCast(normals->GetInput())->GetPointData()->SetScalars(colours);
    actor->GetMapper()->ScalarVisibilityOn();
    actor->GetProperty()->SetOpacity(k_see_through);
    actor->GetProperty()->BackfaceCullingOn();  // one layer of skin in front of the bones
    return actor;
}

vtkNew<vtkActor> bone_actor(const ShownBone& bone, const Colour& colour, double thickness)
{
    vtkNew<vtkLineSource> line;
    line->SetPoint1(bone.head.x(), bone.head.y(), bone.head.z());
    line->SetPoint2(bone.tail.x(), bone.tail.y(), bone.tail.z());
    vtkNew<vtkTubeFilter> tube;
    tube->SetInputConnection(line->GetOutputPort());
    tube->SetRadius(thickness);
    tube->SetNumberOfSides(12);
    tube->CappingOn();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(tube->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
    return actor;
}

vtkNew<vtkActor2D> text_of(const std::string& words, int size, double x, double y)
{
    vtkNew<vtkTextMapper> mapper;
    mapper->SetInput(words.c_str());
    mapper->GetTextProperty()->SetFontSize(size);
    mapper->GetTextProperty()->SetColor(k_ink[0], k_ink[1], k_ink[2]);
    mapper->GetTextProperty()->SetJustificationToCentered();
    mapper->GetTextProperty()->SetVerticalJustificationToCentered();
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedDisplay();
    actor->SetPosition(x, y);
    return actor;
}

Colour colour_of(const ShownBone& bone, const State& state)
{
    if (!bone.value)
        return state.scale.title.empty() ? k_bones[bone.side] : k_uncovered_bone;
    Colour colour;
    colours_of(state.scale)->GetColor(*bone.value, colour.data());
    return colour;
}

vtkNew<vtkActor> garment_actor(const State& state, std::size_t i)
{
    if (!state.values.empty())
        return coloured_cloth(state.garments[i], state.values[i], state.scale);
    if (state.bones.empty())
        return cloth_of(state.garments[i], i);
    vtkNew<vtkActor> actor = actor_of(state.garments[i], k_cloth[i % std::size(k_cloth)]);
    actor->GetProperty()->SetOpacity(k_see_through_cloth);
    return actor;
}

/// The level direction from the figure to the viewer.
Vec3 towards_viewer(const Panel& panel)
{
    Vec3 front(panel.state->front.x(), 0, panel.state->front.z());
    if (front.norm() < 1e-6)  // lying on the back or the belly
        front = Vec3::UnitZ();
    return Eigen::AngleAxisd(panel.turn, Vec3::UnitY()) * front.normalized();
}

struct Extent {
    Vec3 centre = Vec3::Zero();
    double half_width = 0, half_height = 0;  ///< as seen by the viewer
};

Extent extent_of(const Panel& panel)
{
    const Vec3 right = Vec3::UnitY().cross(towards_viewer(panel));
    Eigen::AlignedBox3d box;
    double low = 1e30, high = -1e30;
    const auto add = [&](const Vec3& p) {
        box.extend(p);
        low = std::min(low, right.dot(p));
        high = std::max(high, right.dot(p));
    };
    const auto add_mesh = [&](const TriangleMesh& mesh) {
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
            add(mesh.positions.row(v));
    };
    add_mesh(panel.state->body);
    for (const TriangleMesh& garment : panel.state->garments)
        add_mesh(garment);
    for (const ShownBone& bone : panel.state->bones) {
        add(bone.head);
        add(bone.tail);
    }
    if (box.isEmpty())
        return {};
    Vec3 centre = box.center();
    centre += (0.5 * (low + high) - right.dot(centre)) * right;
    return { centre, 0.5 * (high - low), 0.5 * box.sizes().y() };
}

/// Half the height of the world that every panel shows.
double common_scale(const std::vector<Panel>& panels)
{
    double scale = 0;
    for (const Panel& panel : panels) {
        const Extent extent = extent_of(panel);
        scale = std::max({ scale, extent.half_height, extent.half_width / k_widest });
    }
    return k_margin * scale;
}

/// Width / height of each panel, wider for a wide body.
std::vector<double> aspects_of(const std::vector<Panel>& panels, double scale)
{
    std::vector<double> aspects;
    for (const Panel& panel : panels)
        aspects.push_back(std::clamp(k_margin * extent_of(panel).half_width / scale, k_narrowest, k_widest));
    return aspects;
}

void light(vtkRenderer* renderer)
{
    const auto add = [&](double x, double y, double intensity) {
        vtkNew<vtkLight> lamp;
        lamp->SetLightTypeToCameraLight();
        lamp->SetPosition(x, y, 1);
        lamp->SetIntensity(intensity);
        renderer->AddLight(lamp);
    };
    add(-0.6, 0.8, 0.8);
    add(0.8, 0.2, 0.35);
}

vtkNew<vtkRenderer> renderer_of(const Panel& panel, double scale)
{
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(k_paper.data());
    if (panel.state->body.triangles.rows() > 0 && !panel.state->bones.empty())
        renderer->AddActor(transparent_body(*panel.state));
    else if (panel.state->body.triangles.rows() > 0)
        renderer->AddActor(actor_of(panel.state->body, k_skin));
    for (const ShownBone& bone : panel.state->bones)
        renderer->AddActor(bone_actor(bone, colour_of(bone, *panel.state), k_bone_thickness * scale));
    for (std::size_t i = 0; i < panel.state->garments.size(); ++i)
        renderer->AddActor(garment_actor(*panel.state, i));
    light(renderer);
    const Extent extent = extent_of(panel);
    const Vec3 eye = extent.centre + 10 * towards_viewer(panel);  // parallel projection: any distance beyond the figure
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(scale);
    camera->SetFocalPoint(extent.centre.x(), extent.centre.y(), extent.centre.z());
    camera->SetPosition(eye.x(), eye.y(), eye.z());
    camera->SetViewUp(0, 1, 0);
    renderer->ResetCameraClippingRange();
    return renderer;
}

/// The background of the panels, and the texts.
vtkNew<vtkRenderer> page_of(const std::string& headline, int font)
{
    vtkNew<vtkRenderer> page;
    page->SetBackground(k_paper.data());
    page->AddActor2D(text_of(headline, font, 0.5, 1 - 0.5 * k_text_height));
    return page;
}

/// Right of the panels, which end at `left`.
void add_legend(vtkRenderer* page, const Scale& scale, int font, double left)
{
    const vtkNew<vtkScalarBarActor> legend = legend_of(scale, font);
    legend->SetPosition(left + 0.2 * (1 - left), 0.2);
    legend->SetPosition2(0.6 * (1 - left), 0.6);
    page->AddActor2D(legend);
}

void write_png(vtkRenderWindow* window, const std::filesystem::path& png)
{
    vtkNew<vtkWindowToImageFilter> pixels;
    pixels->SetInput(window);
    pixels->ReadFrontBufferOff();
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(png.c_str());
    writer->SetInputConnection(pixels->GetOutputPort());
    writer->Write();
}

}  // namespace

void draw(const std::vector<Panel>& panels, const std::string& headline, int height, const std::filesystem::path& png)
{
    const double scale = common_scale(panels), figure_height = 1 - 2 * k_text_height;
    const std::vector<double> aspects = aspects_of(panels, scale);
    const bool has_legend = !panels.empty() && !panels.front().state->scale.title.empty();
    const double all_aspects
        = std::accumulate(aspects.begin(), aspects.end(), 0.0) + (has_legend ? k_legend_aspect : 0);
    const int font = std::max(8, height / 40);
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(8);
    window->SetSize(static_cast<int>(std::lround(all_aspects * figure_height * height)), height);

    const vtkNew<vtkRenderer> page = page_of(headline, font);
    window->AddRenderer(page);

    double left = 0;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const double right = left + aspects[i] / all_aspects;
        page->AddActor2D(text_of(panels[i].caption, font, 0.5 * (left + right), 0.5 * k_text_height));
        const vtkNew<vtkRenderer> renderer = renderer_of(panels[i], scale);
        renderer->SetViewport(left, k_text_height, right, 1 - k_text_height);
        window->AddRenderer(renderer);
        left = right;
    }
    if (has_legend)
        add_legend(page, panels.front().state->scale, font, left);
    window->Render();
    write_png(window, png);
}

}  // namespace garmentfit::picture
