// SPDX-License-Identifier: GPL-3.0-or-later
#include "polydata.h"

#include "garmentfit/appearance.h"
#include "garmentfit/error.h"
#include "named_arrays.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

namespace garmentfit {
namespace {

std::string cells_of(vtkPolyData& data)
{
    return std::to_string(data.GetNumberOfPoints()) + " points, " + std::to_string(data.GetNumberOfVerts())
        + " vertices, " + std::to_string(data.GetNumberOfLines()) + " lines and "
        + std::to_string(data.GetNumberOfStrips()) + " strips";
}

Triangles fans_of(vtkCellArray& polygons)
{
    std::vector<int> corners;
    auto cell = vtkSmartPointer<vtkCellArrayIterator>::Take(polygons.NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
        vtkIdType size = 0;
        const vtkIdType* points = nullptr;
        cell->GetCurrentCell(size, points);
        for (vtkIdType k = 2; k < size; ++k)
            corners.insert(corners.end(), { int(points[0]), int(points[k - 1]), int(points[k]) });
    }
    return Eigen::Map<const Triangles>(corners.data(), Eigen::Index(corners.size() / 3), 3);
}

void update_normals(vtkPolyData& data, const Positions& positions, const Triangles& triangles)
{
    data.GetCellData()->SetNormals(nullptr);
    if (vtkDataArray* normals = data.GetPointData()->GetNormals()) {
        const std::string name = normals->GetName() ? normals->GetName() : "Normals";
        data.GetPointData()->SetNormals(array_of(name.c_str(), vertex_normals(positions, triangles)));
    }
}

/// Calls use(leaf, iterator) for each leaf of a composite.
template <class Use>
void for_each_leaf(vtkDataObject& composite, const Use& use)
{
    auto leaf
        = vtkSmartPointer<vtkCompositeDataIterator>::Take(vtkCompositeDataSet::SafeDownCast(&composite)->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
        use(*leaf->GetCurrentDataObject(), *leaf);
}

}  // namespace

TriangleMesh mesh_of(vtkPolyData& data, const std::string& what)
{
    if (data.GetNumberOfPolys() == 0 || data.GetNumberOfStrips() > 0 || data.GetNumberOfPoints() == 0)
        throw InvalidInput(ErrorCode::no_faces,
                           what + " has " + std::to_string(data.GetNumberOfPolys()) + " polygons, " + cells_of(data)
                               + "; give a surface of polygons, and convert strips with vtkTriangleFilter");
    return { rows_of(*data.GetPoints()->GetData()), fans_of(*data.GetPolys()) };
}

TriangleMesh mesh_at(vtkPolyData& data, const char* name, const std::string& what)
{
    TriangleMesh mesh = mesh_of(data, what);
    vtkDataArray* kept = data.GetPointData()->GetArray(name);
    if (kept && kept->GetNumberOfComponents() == 3 && kept->GetNumberOfTuples() == mesh.positions.rows())
        mesh.positions = rows_of(*kept);
    return mesh;
}

CornerUvs corner_uvs_of(vtkPolyData& data, const Triangles& triangles)
{
    vtkDataArray* at_points = data.GetPointData()->GetTCoords();
    if (!at_points || at_points->GetNumberOfComponents() < 2)
        return {};
    Appearance::Uvs uvs(at_points->GetNumberOfTuples(), 2);
    for (Eigen::Index i = 0; i < uvs.rows(); ++i)
        uvs.row(i) << at_points->GetComponent(i, 0), at_points->GetComponent(i, 1);
    return corner_uvs(uvs, triangles);
}

std::vector<vtkPolyData*> garments_in(vtkDataObject& data)
{
    if (vtkPolyData* one = vtkPolyData::SafeDownCast(&data))
        return { one };
    std::vector<vtkPolyData*> garments;
    for_each_leaf(data, [&](vtkDataObject& leaf, vtkCompositeDataIterator&) {
        garments.push_back(vtkPolyData::SafeDownCast(&leaf));
        if (!garments.back())
            throw InvalidInput(ErrorCode::wrong_call,
                               "garment " + std::to_string(garments.size()) + " is a " + leaf.GetClassName()
                                   + "; give vtkPolyData, for example from vtkGeometryFilter");
    });
    return garments;
}

std::vector<std::string> garment_names_in(vtkDataObject& data)
{
    if (vtkPolyData::SafeDownCast(&data))
        return { "the garment" };
    std::vector<std::string> names;
    for_each_leaf(data, [&](vtkDataObject&, vtkCompositeDataIterator& place) {
        const char* name
            = place.HasCurrentMetaData() ? place.GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
        names.push_back(name ? name : "garment " + std::to_string(names.size() + 1));
    });
    return names;
}

GarmentType given_type(vtkPolyData& garment)
{
    auto* type = vtkStringArray::SafeDownCast(garment.GetFieldData()->GetAbstractArray("GarmentType"));
    return type && type->GetNumberOfValues() > 0 ? garment_type_of(type->GetValue(0)) : GarmentType::automatic;
}

void move_points(vtkPolyData& data, const char* name, const Positions& metres, const Triangles& triangles,
                 const Frame& frame)
{
    if (!data.GetPointData()->HasArray(name))
        data.GetPointData()->AddArray(under_name(*data.GetPoints()->GetData(), name));
    const Positions moved = frame.to_file(metres);
    vtkNew<vtkPoints> points;
    points->SetData(array_of("Points", moved));
    data.SetPoints(points);
    update_normals(data, moved, triangles);
}

void restore_points(vtkPolyData& data, const char* name)
{
    if (vtkDataArray* kept = data.GetPointData()->GetArray(name)) {
        vtkNew<vtkPoints> points;
        points->SetData(under_name(*kept, "Points"));
        data.SetPoints(points);
        data.GetPointData()->RemoveArray(name);
    }
}

void draw_skeleton(vtkPolyData& skeleton, const Skeleton& joints, const Frame& frame)
{
    skeleton.Initialize();
    vtkNew<vtkPoints> points;
    points->SetData(array_of("Points", frame.to_file(rows_of(joints))));
    vtkNew<vtkCellArray> lines;
    for (const auto& [from, to] : skeleton_lines())
        lines->InsertNextCell({ from, to });
    skeleton.SetPoints(points);
    skeleton.SetLines(lines);
    put(skeleton, arrays_of_skeleton());
}

}  // namespace garmentfit
