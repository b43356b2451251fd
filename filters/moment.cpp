// SPDX-License-Identifier: GPL-3.0-or-later
#include "filters/moment.h"

#include <algorithm>
#include <cmath>

#include "filters/outcome.h"
#include "fit/error.h"

namespace fit {
namespace {

Positions skinned(const Scene& scene, const Pose& pose)
{
    return skin(scene.body->surface.positions, scene.rig->weights, bone_transforms(scene.rig->skeleton, pose));
}

Moment moment_before_dressing(const Scene& scene)
{
    if (scene.fits.empty())
        return { {}, scene.body->surface.positions, {}, {} };
    const Pose& pose = scene.fits.back().pose;
    return { pose, skinned(scene, pose), {}, {} };
}

Moment end_of(const Dressing& dressing)
{
    Moment moment { dressing.pose, dressing.body, {}, dressing.maps };
    for (const WornGarment& garment : dressing.garments)
        moment.garments.push_back(garment.positions);
    return moment;
}

const RecoverFrame& nearest_frame(const std::vector<RecoverFrame>& frames, double share)
{
    return *std::min_element(frames.begin(), frames.end(), [share](const RecoverFrame& a, const RecoverFrame& b) {
        return std::abs(a.share - share) < std::abs(b.share - share);
    });
}

Moment moment_of(const Scene& scene, const Dressing& dressing, const RecoverFrame& frame, const ClothOptions& cloth)
{
    Moment moment { slerp(scene.draped->pose, Pose(), frame.share), frame.body, frame.garments, {} };
    const TriangleMesh body { frame.body, scene.body->surface.triangles };
    for (std::size_t i = 0; i < frame.garments.size(); ++i) {
        WornGarment worn = dressing.garments[i];
        worn.positions = frame.garments[i];
        moment.maps.push_back(fit_map(body, worn, cloth));
    }
    return moment;
}

void require_same_count(const GarmentMesh& rest, const Positions& worn, const std::string& name)
{
    if (worn.rows() != rest.positions.rows())
        throw InvalidInput(name + " is worn with " + std::to_string(worn.rows()) + " vertices, as given it has "
                           + std::to_string(rest.positions.rows()) + "; give what draping made");
}

}  // namespace

Moment moment_of(const Scene& scene, double share, const ClothOptions& cloth)
{
    const Dressing* end = final_dressing(scene);
    if (!end)
        return moment_before_dressing(scene);
    if (share >= 1 || end->frames.empty())
        return end_of(*end);
    return moment_of(scene, *end, nearest_frame(end->frames, share), cloth);
}

Dressing dressing_from(const Scene& scene, const Pose& pose, const std::vector<Positions>& worn,
                       const std::vector<std::string>& names)
{
    Dressing dressing;
    dressing.pose = pose;
    dressing.body = skinned(scene, pose);
    const TriangleMesh body { dressing.body, scene.body->surface.triangles };
    std::vector<TriangleMesh> under;
    for (std::size_t i = 0; i < worn.size(); ++i) {
        const GarmentMesh& rest = scene.garments[i].mesh;
        require_same_count(rest, worn[i], names[i]);
        dressing.garments.push_back({ rest, worn[i], certify(body, rest, worn[i], under) });
        under.push_back({ worn[i], rest.triangles });
    }
    dressing.certified = all_clean(dressing.garments);
    return dressing;
}

}  // namespace fit
