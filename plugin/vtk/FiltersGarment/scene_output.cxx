// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_output.h"

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/scene_arrays.h"
#include "named_arrays.h"
#include "polydata.h"

#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace garmentfit {
namespace {

void write_worn(vtkPolyData& garment, std::size_t i, const Dressing& dressing, const KnownScene& known,
                const Snapshot& now)
{
    put(garment, arrays_of_worn(dressing, i, known.body_frame));
    if (!dressing.is_worn(i))
        return;
    move_points(garment, k_rest_position, now.garments[i], known.scene.garments[i].mesh.triangles, known.body_frame);
    put(garment, arrays_of(now.maps[i], known.body_frame));
}

}  // namespace

void write_body(vtkPolyData& body, const Filter& filter, const KnownScene& known, const Snapshot& now)
{
    const TriangleMesh& own = known.scene.body->surface;
    if (filter.makes(Data::rig)) {
        body.GetPointData()->RemoveArray(k_input_position);  // of an earlier dressing
        put(body, arrays_of(*known.scene.rig, known.body_frame));
    } else {
        restore_points(body, k_input_position);
    }
    if (filter.makes(Data::fits))
        put(body, arrays_of_fits(known.scene));
    if (now.body != own.positions)
        move_points(body, k_input_position, now.body, own.triangles, known.body_frame);
    if (const Dressing* dressing = final_dressing(known.scene))
        put(body, arrays_of(*dressing, now.pose, known.garment_names, known.body_frame));
}

void write_garments(const std::vector<vtkPolyData*>& garments, const Filter& filter, const KnownScene& known,
                    const Snapshot& now)
{
    for (std::size_t i = 0; i < garments.size(); ++i) {
        put(*garments[i], arrays_of(known.garment_frames[i]));
        if (filter.reads(Data::fits) || filter.reads(Data::draped))
            restore_points(*garments[i], k_rest_position);
        else
            garments[i]->GetPointData()->RemoveArray(k_rest_position);  // of an earlier dressing
        if (filter.makes(Data::fits))
            put(*garments[i], arrays_of(known.scene.fits[i]));
        if (const Dressing* dressing = final_dressing(known.scene))
            write_worn(*garments[i], i, *dressing, known, now);
    }
}

void write_skeleton(vtkPolyData& skeleton, const KnownScene& known, const Snapshot& now)
{
    draw_skeleton(skeleton, pose_skeleton(known.scene.rig->skeleton, now.pose), known.body_frame);
}

}  // namespace garmentfit
