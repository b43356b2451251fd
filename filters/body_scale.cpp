// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/body_scale.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/filters/frame_choice.h"
#include "moved_scene.h"
#include "near_origin.h"

namespace garmentfit {
namespace {

// derived: a human of height h, m, and body mass index 24 weighs 24 h^2 kg and displaces a litre a kilogram. At 1.7 m
// that is 0.069 m^3, whose cube root goes 4.1 times into the height; 4.7 times at an index of 16, 3.6 times at one of
// 36.
constexpr double k_height_by_volume = 4.1, k_least_by_volume = 3.6, k_most_by_volume = 4.7;
// derived: 0.5 m and 2.5 m tall, with the spread above and rounded outwards, so that no body between them is scaled. m
constexpr double k_smallest = 0.4, k_largest = 3;
// unit: where a power of ten makes an adult of the body it is taken, and a body at a tenth of its size gets the result
// of the whole one; else the body becomes one of k_middle. m
constexpr double k_shortest_adult = 1, k_tallest_adult = 2.5, k_middle = 1.7;

/// Enclosed by a closed surface, m^3.
double volume_of(const TriangleMesh& closed)
{
    const Vec3 origin = origin_of(closed.positions);  // far from it, the volumes of the tetrahedra would hide the sum
    double sum = 0;
    for (Eigen::Index f = 0; f < closed.triangles.rows(); ++f) {
        const auto corner = [&](int k) { return Vec3(Vec3(closed.positions.row(closed.triangles(f, k))) - origin); };
        sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
    }
    return std::abs(sum);
}

void scale(Skeleton& skeleton, double factor)
{
    skeleton.root *= factor;
    for (Vec3& tail : skeleton.tails)
        tail *= factor;
    for (Vec3& tip : skeleton.tips)
        tip *= factor;
}

void scale(Rig& rig, double factor)
{
    scale(rig.skeleton, factor);
    for (double& radius : rig.radii)
        radius *= factor;
}

void scale(FitResult& fit, double factor)
{
    fit.pose.root_translation *= factor;
    for (auto* scores : { &fit.scores_before, &fit.scores })
        for (double& score : *scores)
            score *= factor;
    fit.score_before *= factor;
    fit.score_after *= factor;
}

void scale(WornGarment& garment, double factor)
{
    garment.rest.positions *= factor;
    garment.positions *= factor;
    garment.certificate.min_distance *= factor;
    garment.slipped *= factor;
    garment.piece_shift *= factor;
    if (garment.stand_in) {
        garment.stand_in->rest.positions *= factor;
        garment.stand_in->positions *= factor;
    }
}

void scale(RecoverFrame& frame, double factor)
{
    frame.body *= factor;
    for (Positions& garment : frame.garments)
        garment *= factor;
}

void scale_measures(Dressing& dressing, double factor)
{
    for (TooTight& part : dressing.too_tight)
        part.missing_girth *= factor;
    for (HeldBack& part : dressing.held_back)
        part.distance *= factor;
    for (Overlap& overlap : dressing.overlaps)
        overlap.depth *= factor;
    for (Overstretch& stretch : dressing.overstretches)
        stretch.longer *= factor;
    dressing.spikes.longer *= factor;
    for (FitMap& map : dressing.maps)
        map.ease *= factor;
    for (std::vector<PartLoad>& loads : dressing.loads)
        for (PartLoad& load : loads)
            load.girth *= factor;
    for (std::vector<Girth>& girths : dressing.girths)
        for (Girth& girth : girths) {
            girth.body *= factor;
            girth.garment *= factor;
        }
}

void scale(Dressing& dressing, double factor)
{
    dressing.to_human_size /= factor;
    dressing.unit.metres *= factor;
    dressing.pose.root_translation *= factor;
    dressing.body *= factor;
    for (WornGarment& garment : dressing.garments)
        scale(garment, factor);
    for (RecoverFrame& frame : dressing.frames)
        scale(frame, factor);
    scale_measures(dressing, factor);
}

}  // namespace

double stature_of(const BodyMesh& body)
{
    const double root = std::cbrt(volume_of(body.closed)),
                 height = height_of(body.surface.positions, body.surface.triangles, {});
    return std::clamp(height, k_least_by_volume * root, k_most_by_volume * root);
}

double factor_to_human_size(const BodyMesh& body)
{
    const double height = k_height_by_volume * std::cbrt(volume_of(body.closed));
    if (!(height > 0) || (height >= k_smallest && height <= k_largest))
        return 1;
    const double ten = std::pow(10, std::round(std::log10(k_middle / height)));
    return height * ten >= k_shortest_adult && height * ten <= k_tallest_adult ? ten : k_middle / height;
}

Scene scale_scene(Scene scene, double factor)
{
    scene.unit.metres *= factor;
    scene.body->surface.positions *= factor;
    scene.body->closed.positions *= factor;
    for (GarmentInput& garment : scene.garments) {
        garment.mesh.positions *= factor;
        if (garment.stand_in && *garment.stand_in)
            (*garment.stand_in)->mesh.positions *= factor;
    }
    if (scene.rig)
        scale(*scene.rig, factor);
    for (FitResult& fit : scene.fits)
        scale(fit, factor);
    for (std::optional<Dressing>* dressing : { &scene.draped, &scene.recovered })
        if (*dressing)
            scale(**dressing, factor);
    return scene;
}

GivenJoints scale_joints(GivenJoints joints, double factor)
{
    const auto scale_one = [factor](std::optional<Vec3>& joint) {
        if (joint)
            *joint *= factor;
    };
    scale_one(joints.root);
    std::for_each(joints.tails.begin(), joints.tails.end(), scale_one);
    std::for_each(joints.tips.begin(), joints.tips.end(), scale_one);
    return joints;
}

void restore_size(Scene& scene, const Scene& at_human_size, double factor, const std::vector<Data>& outputs)
{
    take_outputs(scene, scale_scene(at_human_size, 1 / factor), at_human_size, outputs);
}

FitMap fit_map_on(const BodyMesh& body, const TriangleMesh& posed, const WornGarment& worn, const ClothOptions& cloth)
{
    const double factor = factor_to_human_size(body);
    if (factor == 1)
        return fit_map(posed, worn, cloth);
    WornGarment garment = worn;
    scale(garment, factor);
    FitMap map = fit_map({ posed.positions * factor, posed.triangles }, garment, cloth);
    map.ease /= factor;
    return map;
}

}  // namespace garmentfit
