// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "attempt.h"
#include "garmentfit/stopwatch.h"
#include "named_garment.h"
#include "other_wearings.h"

namespace garmentfit {
namespace {

std::vector<GarmentMesh> meshes_of(const std::vector<GarmentInput>& garments)
{
    std::vector<GarmentMesh> meshes;
    for (const GarmentInput& garment : garments)
        meshes.push_back(garment.mesh);
    return meshes;
}

/// Finds one pose for all garments; where there is none, each keeps the pose of its fit.
void fit_together(Scene& scene, const Progress& progress)
{
    const CommonFit common = fit_common_pose(*scene.rig, meshes_of(scene.garments), scene.fits, progress);
    scene.fits = common.fits;
    scene.one_pose = common.one_pose;
    scene.conflicts = common.conflicts;
}

void put_in_layers(Scene& scene, LayerOrder order)
{
    if (scene.garments.size() < 2)
        return;
    scene.automatic_layers
        = order_layers(*scene.rig, scene.body->surface.positions, meshes_of(scene.garments), scene.fits);
    for (std::size_t i = 0; i < scene.fits.size(); ++i)
        scene.fits[i].layer = order == LayerOrder::automatic ? scene.automatic_layers[i] : int(i);
}

/// A fit of the same way of wearing as before, with what was known of that then. Nothing where it is another way.
std::optional<FitResult> as_before(FitResult fit, const FitResult& before)
{
    if (!is_within(fit, before) && !is_within(before, fit))
        return {};
    fit.type_probability = before.type_probability;
    fit.front_probability = before.front_probability;
    fit.up_probability = before.up_probability;
    fit.probability = before.probability;
    fit.front_given = before.front_given;
    fit.rejected = before.rejected;
    return fit;
}

}  // namespace

std::string prefix_of(const Scene& scene, std::size_t garment)
{
    const std::string& name = scene.garments[garment].name;
    if (!name.empty())
        return name + ": ";
    return scene.garments.size() > 1 ? "garment " + std::to_string(garment + 1) + ": " : "";
}

void require_wearable_sizes(const Scene& scene)
{
    for (std::size_t g = 0; g < scene.garments.size(); ++g)
        for_garment(scene, g, [&](std::size_t i) { require_wearable_size(*scene.rig, scene.garments[i].mesh); });
}

void rig_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    scene.rig = rig_body(*scene.body, p.rig, progress);
}

void fit_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    scene.fits.clear();
    scene.one_pose.reset();
    scene.conflicts.clear();
    scene.automatic_layers.clear();
    require_wearable_sizes(scene);
    const bool together = scene.garments.size() > 1 && p.fit.method == FitMethod::fast;
    const double n = double(scene.garments.size()) + (together ? 1 : 0);
    for (std::size_t g = 0; g < scene.garments.size(); ++g)
        scene.fits.push_back(for_garment(scene, g, [&](std::size_t i) {
            const GarmentInput& garment = scene.garments[i];
            FitOptions options = p.fit;
            if (garment.type != GarmentType::automatic)
                options.type = garment.type;
            if (garment.front)
                options.front = garment.front;
            options.as_placed = garment.as_placed.value_or(options.as_placed);
            options.skipped += garment.skipped;
            return fit_skeleton(*scene.rig, scene.body->surface, garment.mesh, options,
                                progress.part(double(i) / n, double(i + 1) / n));
        }));
    if (together)
        fit_together(scene, progress.part(1 - 1 / n, 1));
    put_in_layers(scene, p.layer_order);
}

bool fit_again(Scene& scene, const Parameters& p, const Progress& progress)
{
    const Stopwatch watch(scene.seconds[static_cast<int>(Stage::fit)]);
    Scene other = scene;
    for (std::size_t g = 0; g < other.garments.size(); ++g) {
        other.garments[g].type = scene.fits[g].type;
        other.garments[g].front = scene.fits[g].front;
        other.garments[g].skipped = 0;
    }
    if (!succeeds([&] { fit_stage(other, p, progress); }))
        return false;
    for (std::size_t g = 0; g < other.fits.size(); ++g) {
        std::optional<FitResult> fit = as_before(std::move(other.fits[g]), scene.fits[g]);
        if (!fit)
            return false;
        other.fits[g] = *std::move(fit);
    }
    other.garments = std::move(scene.garments);
    scene = std::move(other);
    return true;
}

}  // namespace garmentfit
