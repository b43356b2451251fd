// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_data.h"

#include <algorithm>

#include "filters/joint_names.h"
#include "filters/rig_arrays.h"
#include "fit/error.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnsignedShortArray.h"

namespace fit {
namespace {

// ---- arrays ----------------------------------------------------------------------------------------------------

Rows rows_of(vtkDataArray& array)
{
    Rows rows(array.GetNumberOfTuples(), array.GetNumberOfComponents());
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        array.GetTuple(i, rows.row(i).data());
    return rows;
}

vtkNew<vtkDoubleArray> array_of(const char* name, const Eigen::Ref<const Rows>& rows)
{
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(int(rows.cols()));
    array->SetNumberOfTuples(rows.rows());
    Eigen::Map<Rows>(array->GetPointer(0), rows.rows(), rows.cols()) = rows;
    return array;
}

void put_numbers(vtkFieldData& data, const char* name, const std::vector<double>& numbers)
{
    data.AddArray(array_of(name, Eigen::Map<const Rows>(numbers.data(), Eigen::Index(numbers.size()), 1)));
}

void put_count(vtkFieldData& data, const char* name, int count)
{
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->InsertNextValue(count);
    data.AddArray(array);
}

void put_texts(vtkFieldData& data, const char* name, const std::vector<std::string>& texts)
{
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& text : texts)
        array->InsertNextValue(text);
    data.AddArray(array);
}

/// The same memory under another name; renaming the array itself would rename it in the input, too.
vtkSmartPointer<vtkDataArray> under_name(vtkDataArray& array, const char* name)
{
    auto same = vtkSmartPointer<vtkDataArray>::Take(array.NewInstance());
    same->ShallowCopy(&array);
    same->SetName(name);
    return same;
}

/// @throws InvalidInput where there is no such array of that many columns, finite.
Rows field_rows(vtkPolyData& data, const char* name, int columns, const char* remedy)
{
    vtkDataArray* array = data.GetFieldData()->GetArray(name);
    if (!array || array->GetNumberOfComponents() != columns || array->GetNumberOfTuples() == 0)
        throw InvalidInput(std::string("the input has no field data ") + name + " of " + std::to_string(columns)
                           + " components; " + remedy);
    Rows rows = rows_of(*array);
    if (!rows.allFinite())
        throw InvalidInput(std::string("field data ") + name + " is not finite; " + remedy);
    return rows;
}

// ---- meshes ----------------------------------------------------------------------------------------------------

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

void turn_normals(vtkPolyData& data, const Positions& positions, const Triangles& triangles)
{
    data.GetCellData()->SetNormals(nullptr);
    if (vtkDataArray* normals = data.GetPointData()->GetNormals()) {
        const std::string name = normals->GetName() ? normals->GetName() : "Normals";
        data.GetPointData()->SetNormals(array_of(name.c_str(), vertex_normals(positions, triangles)));
    }
}

// ---- rigs ------------------------------------------------------------------------------------------------------

constexpr const char* k_rig_first = "connect the body that vtkRigBody made";
constexpr const char* k_fit_first = "connect the body that vtkFitSkeleton made";
constexpr const char* k_drape_first = "connect the body that vtkDrapeGarment made";

vtkDataArray& point_array(vtkPolyData& body, const char* name)
{
    vtkDataArray* array = body.GetPointData()->GetArray(name);
    if (!array || array->GetNumberOfComponents() != 4)
        throw InvalidInput(std::string("the body has no point data ") + name + " of 4 components; " + k_rig_first);
    if (array->GetNumberOfTuples() != body.GetNumberOfPoints())
        throw InvalidInput(std::string("the rig belongs to a body of ") + std::to_string(array->GetNumberOfTuples())
                           + " points, this one has " + std::to_string(body.GetNumberOfPoints()) + "; " + k_rig_first);
    return *array;
}

Rows field_rows(vtkPolyData& body, const char* name, int rows, int columns)
{
    const Rows values = field_rows(body, name, columns, k_rig_first);
    if (values.rows() != rows)
        throw InvalidInput(std::string("field data ") + name + " has " + std::to_string(values.rows())
                           + " rows instead of " + std::to_string(rows) + "; " + k_rig_first);
    return values;
}

// ---- what users look at ----------------------------------------------------------------------------------------

void put_certificate(vtkFieldData& data, const Certificate& c, double metres_per_unit)
{
    put_count(data, "BodyCrossings", c.body_crossings);
    put_count(data, "SelfCrossings", c.self_crossings);
    put_count(data, "InputSelfCrossings", c.input_self_crossings);
    put_count(data, "LayerCrossings", c.layer_crossings);
    put_count(data, "VerticesInside", c.vertices_inside);
    put_numbers(data, "GarmentGap", { c.smallest_gap / metres_per_unit });
    put_numbers(data, "StrainMedian", { c.strain.median });
    put_numbers(data, "StrainP95", { c.strain.p95 });
    put_numbers(data, "StrainMax", { c.strain.max });
}

void put_girths(vtkFieldData& data, const std::vector<Girth>& girths, double metres_per_unit)
{
    std::vector<std::string> places;
    std::vector<double> body, garment;
    for (const Girth& girth : girths) {
        places.push_back(girth.place);
        body.push_back(girth.body / metres_per_unit);
        garment.push_back(girth.garment / metres_per_unit);
    }
    put_texts(data, "GirthPlace", places);
    put_numbers(data, "GirthBody", body);
    put_numbers(data, "GirthGarment", garment);
}

void put_too_tight(vtkFieldData& data, const Dressing& dressing, std::size_t i, double metres_per_unit)
{
    std::vector<std::string> parts;
    std::vector<double> girths;
    for (const TooTight& tight : dressing.too_tight)
        if (tight.garment == int(i)) {
            parts.push_back(tight.part);
            girths.push_back(tight.missing_girth / metres_per_unit);
        }
    put_texts(data, "TooTightPart", parts);
    put_numbers(data, "MissingGirth", girths);
}

/// A bone or a tip as a line between two rows of a skeleton.
struct Line {
    int from, to;
    std::string name;
};

std::vector<Line> lines_of_skeleton()
{
    const auto tail_row = [](int bone) { return 1 + bone; };  // of the root: -1 + 1
    std::vector<Line> lines;
    for (int b = 0; b < bone_count; ++b)
        lines.push_back({ tail_row(parent_of(b)), tail_row(b), std::string(bone_name(b)) });
    for (int e = 0; e < extremity_count; ++e)
        lines.push_back(
            { tail_row(bone_before(Extremity(e))), 1 + int(bone_count) + e, std::string(joint_name(Extremity(e))) });
    return lines;
}

void put_joint_names(vtkPolyData& skeleton, const std::vector<Line>& lines)
{
    std::vector<std::string> names { "root" };
    for (int b = 0; b < bone_count; ++b)
        names.emplace_back(joint_name(Bone(b)));
    for (int e = 0; e < extremity_count; ++e)
        names.emplace_back(joint_name(Extremity(e)));
    vtkNew<vtkIntArray> ids, parents;
    ids->SetName("JointId");
    parents->SetName("JointParent");
    ids->InsertNextValue(0);
    parents->InsertNextValue(-1);
    for (const Line& line : lines) {
        ids->InsertNextValue(line.to);
        parents->InsertNextValue(line.from);
    }
    put_texts(*skeleton.GetPointData(), "JointName", names);
    skeleton.GetPointData()->AddArray(ids);
    skeleton.GetPointData()->AddArray(parents);
}

void put_lines(vtkPolyData& skeleton, const std::vector<Line>& lines)
{
    vtkNew<vtkCellArray> cells;
    vtkNew<vtkIntArray> ids;
    ids->SetName("BoneId");
    std::vector<std::string> names;
    for (const Line& line : lines) {
        cells->InsertNextCell({ line.from, line.to });
        ids->InsertNextValue(bone_of(line.name));
        names.push_back(line.name);
    }
    skeleton.SetLines(cells);
    skeleton.GetCellData()->AddArray(ids);
    put_texts(*skeleton.GetCellData(), "BoneName", names);
}

}  // namespace

TriangleMesh mesh_of(vtkPolyData& data, const std::string& what)
{
    if (data.GetNumberOfPolys() == 0 || data.GetNumberOfStrips() > 0)
        throw InvalidInput(what + " has " + std::to_string(data.GetNumberOfPolys()) + " polygons, " + cells_of(data)
                           + "; give a surface of polygons, of strips vtkTriangleFilter makes one");
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

std::vector<vtkPolyData*> garments_in(vtkDataObject& data)
{
    if (vtkPolyData* one = vtkPolyData::SafeDownCast(&data))
        return { one };
    std::vector<vtkPolyData*> garments;
    auto leaf
        = vtkSmartPointer<vtkCompositeDataIterator>::Take(vtkCompositeDataSet::SafeDownCast(&data)->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem()) {
        garments.push_back(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
        if (!garments.back())
            throw InvalidInput("garment " + std::to_string(garments.size()) + " is a "
                               + leaf->GetCurrentDataObject()->GetClassName()
                               + "; give vtkPolyData, vtkGeometryFilter makes it");
    }
    return garments;
}

std::vector<std::string> garment_names_in(vtkDataObject& data)
{
    if (vtkPolyData::SafeDownCast(&data))
        return { "the garment" };
    std::vector<std::string> names;
    auto leaf
        = vtkSmartPointer<vtkCompositeDataIterator>::Take(vtkCompositeDataSet::SafeDownCast(&data)->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem()) {
        const char* name
            = leaf->HasCurrentMetaData() ? leaf->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME()) : nullptr;
        names.push_back(name ? name : "garment " + std::to_string(names.size() + 1));
    }
    return names;
}

GarmentType given_type(vtkPolyData& garment)
{
    auto* type = vtkStringArray::SafeDownCast(garment.GetFieldData()->GetAbstractArray("GarmentType"));
    return type && type->GetNumberOfValues() > 0 ? garment_type_of(type->GetValue(0)) : GarmentType::automatic;
}

void put_frame(vtkPolyData& data, const char* name, const Frame& frame)
{
    Eigen::RowVector4d row;
    row << frame.metres_per_unit, frame.up.transpose();
    data.GetFieldData()->AddArray(array_of(name, row));
}

Frame frame_in(vtkPolyData& data, const char* name)
{
    const Rows row = field_rows(data, name, 4, "connect what the filter before this one made");
    const Frame frame { row(0, 0), row.block<1, 3>(0, 1).transpose() };
    if (!(frame.metres_per_unit > 0) || frame.up.cwiseAbs().sum() != 1 || frame.up.cwiseAbs().maxCoeff() != 1)
        throw InvalidInput(std::string("field data ") + name + " is no unit and up axis");
    return frame;
}

bool has_frame(vtkPolyData& data, const char* name) { return data.GetFieldData()->HasArray(name); }

void put_rig(vtkPolyData& body, const Rig& rig)
{
    vtkNew<vtkUnsignedShortArray> bones;
    bones->SetName("JointIndices");
    bones->SetNumberOfComponents(4);
    bones->SetNumberOfTuples(rig.weights.bones.rows());
    std::copy_n(rig.weights.bones.data(), rig.weights.bones.size(), bones->GetPointer(0));
    body.GetPointData()->AddArray(bones);
    body.GetPointData()->AddArray(array_of("JointWeights", rig.weights.weights));
    body.GetFieldData()->AddArray(array_of("RigJoints", rows_of(rig.skeleton)));
    Rows axes(2, 3);
    axes << rig.up.transpose(), rig.front.transpose();
    body.GetFieldData()->AddArray(array_of("RigAxes", axes));
    put_numbers(*body.GetFieldData(), "RigRadii", { rig.radii.begin(), rig.radii.end() });
    put_numbers(*body.GetFieldData(), "RigSideMargin", { rig.side_margin });
}

Rig rig_in(vtkPolyData& body)
{
    Rig rig;
    rig.weights = weights_of(rows_of(point_array(body, "JointIndices")), rows_of(point_array(body, "JointWeights")));
    rig.skeleton = skeleton_of(field_rows(body, "RigJoints", k_joint_rows, 3));
    const Rows axes = field_rows(body, "RigAxes", 2, 3), radii = field_rows(body, "RigRadii", bone_count, 1);
    rig.up = axes.row(0);
    rig.front = axes.row(1);
    std::copy_n(radii.data(), radii.size(), rig.radii.begin());
    rig.side_margin = field_rows(body, "RigSideMargin", 1, 1)(0, 0);
    return rig;
}

void put_fits(vtkPolyData& body, const std::vector<FitResult>& fits)
{
    Rows poses(fits.size(), k_pose_columns);
    for (std::size_t i = 0; i < fits.size(); ++i)
        poses.row(Eigen::Index(i)) = row_of(fits[i].pose);
    body.GetFieldData()->AddArray(array_of("FitPoses", poses));
}

std::vector<FitResult> fits_in(vtkPolyData& body)
{
    const Rows poses = field_rows(body, "FitPoses", k_pose_columns, k_fit_first);
    std::vector<FitResult> fits(poses.rows());
    for (std::size_t i = 0; i < fits.size(); ++i)
        fits[i].pose = pose_of(poses.row(Eigen::Index(i)));
    return fits;
}

void put_pose(vtkPolyData& body, const Pose& pose)
{
    body.GetFieldData()->AddArray(array_of("DressedPose", row_of(pose)));
}

Pose pose_in(vtkPolyData& body)
{
    return pose_of(field_rows(body, "DressedPose", k_pose_columns, k_drape_first).row(0));
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

void move_points(vtkPolyData& data, const char* name, const Positions& metres, const Triangles& triangles,
                 const Frame& frame)
{
    if (!data.GetPointData()->HasArray(name))
        data.GetPointData()->AddArray(under_name(*data.GetPoints()->GetData(), name));
    const Positions moved = frame.to_file(metres);
    vtkNew<vtkPoints> points;
    points->SetData(array_of("Points", moved));
    data.SetPoints(points);
    turn_normals(data, moved, triangles);
}

void put_dressing(vtkPolyData& body, const Dressing& dressing, const std::string& note, double metres_per_unit)
{
    vtkFieldData& data = *body.GetFieldData();
    put_count(data, "Certified", dressing.certified ? 1 : 0);
    put_numbers(data, "SizeReached", { dressing.size_reached });
    put_numbers(data, "PoseReached", { dressing.pose_reached });
    put_numbers(data, "Speed", { dressing.speed });
    put_texts(data, "Note", { note });
    std::vector<std::string> parts;
    std::vector<double> distances;
    for (const HeldBack& held : dressing.held_back) {
        parts.push_back(held.part);
        distances.push_back(held.distance / metres_per_unit);
    }
    put_texts(data, "HeldBackPart", parts);
    put_numbers(data, "HeldBackDistance", distances);
}

void put_fit(vtkPolyData& garment, const FitResult& fit)
{
    put_texts(*garment.GetFieldData(), "FoundType", { std::string(name_of(fit.type)) });
    put_numbers(*garment.GetFieldData(), "FoundTypeMargin", { fit.type_margin });
}

void put_worn(vtkPolyData& garment, const Dressing& dressing, std::size_t i, double metres_per_unit)
{
    vtkFieldData& data = *garment.GetFieldData();
    const bool worn = i < dressing.garments.size();
    put_count(data, "Worn", worn ? 1 : 0);
    if (!worn)
        return;
    put_certificate(data, dressing.garments[i].certificate, metres_per_unit);
    put_girths(data, dressing.girths[i], metres_per_unit);
    put_too_tight(data, dressing, i, metres_per_unit);
}

void put_map(vtkPolyData& garment, const FitMap& map, double metres_per_unit)
{
    garment.GetPointData()->AddArray(array_of("Ease", map.ease / metres_per_unit));
    garment.GetPointData()->AddArray(array_of("Strain", map.strain));
    garment.GetPointData()->AddArray(array_of("Pressure", map.pressure));
}

void draw_skeleton(vtkPolyData& skeleton, const Skeleton& joints, const Frame& frame)
{
    skeleton.Initialize();
    vtkNew<vtkPoints> points;
    points->SetData(array_of("Points", frame.to_file(rows_of(joints))));
    skeleton.SetPoints(points);
    const std::vector<Line> lines = lines_of_skeleton();
    put_lines(skeleton, lines);
    put_joint_names(skeleton, lines);
}

}  // namespace fit
