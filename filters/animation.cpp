// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/animation.h"

#include <cmath>

#include "garmentfit/animated_gltf.h"
#include "garmentfit/error.h"

namespace garmentfit {

void write_animation(const Scene& scene, const Dressing& dressing, const std::vector<std::string>& garments,
                     const std::filesystem::path& path, double seconds)
{
    if (dressing.frames.empty())
        throw InvalidInput(ErrorCode::missing_input,
                           "there are no frames; recover the pose with a number of frames, which takes place where it "
                           "is not the input pose from the start");
    if (!(seconds > 0) || !std::isfinite(seconds))
        throw InvalidInput(ErrorCode::out_of_range, "seconds: the length of an animation is above 0");
    const std::vector<std::size_t> worn = dressing.worn();
    std::vector<MovingMesh> meshes { { "body", scene.body->surface.triangles, {}, { 0.55, 0.35, 0.25 } } };
    for (const std::size_t i : worn)
        meshes.push_back({ garments.at(i), scene.garments[i].mesh.triangles, {}, { 0.1, 0.3 / double(i + 1), 0.5 } });
    for (const RecoverFrame& state : dressing.frames)
        for (std::size_t m = 0; m < meshes.size(); ++m)
            meshes[m].frames.push_back(m == 0 ? state.body : state.garments[worn[m - 1]]);
    write_animated_glb(path, meshes, seconds / double(dressing.frames.size()));
}

}  // namespace garmentfit
