// SPDX-License-Identifier: GPL-3.0-or-later
#include "named_arrays.h"

#include <algorithm>

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedShortArray.h"

namespace garmentfit {
namespace {

template <class Array, class Matrix>
vtkNew<Array> filled(const char* name, const Matrix& rows)
{
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(int(rows.cols()));
    array->SetNumberOfTuples(rows.rows());
    std::copy_n(rows.data(), rows.size(), array->GetPointer(0));
    return array;
}

/// One kind of VTK's arrays for each kind of values.
struct PutInto {
    vtkFieldData& data;
    const char* name;

    void operator()(const Rows& rows) const { data.AddArray(filled<vtkDoubleArray>(name, rows)); }
    void operator()(const Counts& rows) const { data.AddArray(filled<vtkIntArray>(name, rows)); }
    void operator()(const BoneIndices& rows) const { data.AddArray(filled<vtkUnsignedShortArray>(name, rows)); }
    void operator()(const Texts& texts) const
    {
        vtkNew<vtkStringArray> array;
        array->SetName(name);
        for (const std::string& text : texts)
            array->InsertNextValue(text);
        data.AddArray(array);
    }
};

void put(vtkFieldData& data, const std::vector<NamedArray>& arrays)
{
    for (const NamedArray& array : arrays)
        std::visit(PutInto { data, array.name.c_str() }, array.values);
}

}  // namespace

Rows rows_of(vtkDataArray& array)
{
    Rows rows(array.GetNumberOfTuples(), array.GetNumberOfComponents());
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        array.GetTuple(i, rows.row(i).data());
    return rows;
}

vtkNew<vtkDoubleArray> array_of(const char* name, const Eigen::Ref<const Rows>& rows)
{
    return filled<vtkDoubleArray>(name, Rows(rows));
}

vtkSmartPointer<vtkDataArray> under_name(vtkDataArray& array, const char* name)
{
    auto same = vtkSmartPointer<vtkDataArray>::Take(array.NewInstance());
    same->ShallowCopy(&array);
    same->SetName(name);
    return same;
}

void put(vtkPolyData& data, const MeshArrays& arrays)
{
    put(*data.GetPointData(), arrays.points);
    put(*data.GetCellData(), arrays.cells);
    put(*data.GetFieldData(), arrays.field);
}

FindArray find_in(vtkPolyData& data)
{
    return [&data](const char* name) -> std::optional<Rows> {
        vtkDataArray* array = data.GetPointData()->GetArray(name);
        if (!array)
            array = data.GetFieldData()->GetArray(name);
        if (!array)
            return {};
        return rows_of(*array);
    };
}

}  // namespace garmentfit
