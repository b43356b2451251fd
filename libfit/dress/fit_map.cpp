// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_map.h"

#include <algorithm>
#include <cmath>

#include "body_parts.h"
#include "cloth_energy.h"
#include "cloth_motion.h"
#include "nearest.h"
#include "parallel.h"
#include "prepared_cloth.h"
#include "skin_weights.h"
#include "surface_measures.h"
#include "tightness.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// At each vertex the mean of l / l0 - 1 over its edges.
Eigen::VectorXd mean_stretches(const PreparedCloth& cloth)
{
    const Positions &rest = cloth.rest.positions, &positions = cloth.positions;
    const Edges& edges = cloth.topology.edges();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(positions.rows()), count = sum;
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (rest.row(i) - rest.row(j)).norm();
        if (before == 0)
            continue;
        for (const int v : { i, j }) {
            sum[v] += (positions.row(i) - positions.row(j)).norm() / before - 1;
            count[v] += 1;
        }
    }
    return sum.array() / count.array().max(1);
}

}  // namespace

FitMap fit_map(const TriangleMesh& body, const WornGarment& worn, const ClothOptions& options)
{
    const PreparedCloth cloth = prepare_cloth(worn.rest, worn.positions);
    const Positions& x = cloth.positions;
    ClothOptions own = options;
    own.fabric = worn.fabric.value_or(options.fabric);
    const double density = material_of(own).density;
    const ClothEnergy energy(cloth.rest, cloth.topology, {}, own);
    const Positions forces = energy.elastic_forces(x);
    const TriangleTree skin(body);

    Positions map(x.rows(), 3);  // ease, strain, pressure
    map.col(1) = mean_stretches(cloth);
    parallel_for(x.rows(), [&](Eigen::Index v) {
        const Vec3 out = x.row(v).transpose() - skin.nearest(x.row(v));
        const double ease = out.norm(), mass = energy.masses()[v];
        const Vec3 force = forces.row(v).transpose() - mass * k_gravity * Vec3::UnitY();
        const double inwards = ease > 0 ? -force.dot(out) / ease : 0;
        map(v, 0) = ease;
        map(v, 2)
            = ease < k_pressing_distance * options.contact_distance ? std::max(inwards, 0.0) / (mass / density) : 0;
    });
    const Positions result = cloth.weld.spread(map);
    return { result.col(0), result.col(1), result.col(2) };
}

std::vector<PartLoad> part_loads(const Skeleton& skeleton, const SkinWeights& weights, const Positions& body,
                                 const WornGarment& worn, const ClothOptions& options)
{
    const Material material = material_of(options, worn);
    const double stiffness = worn.rest.warps.rows() > 0 ? stiffness_along_weft(material) : material.stretch_stiffness;
    const Edges edges = edges_of(worn.rest.triangles);
    const Tightness tightness(worn.rest.positions, edges, weights_of_nearest(worn.positions, body, weights), skeleton,
                              material.largest_stretch);
    std::vector<PartLoad> result;
    for (const auto& part : tightness.measure_parts(worn.positions)) {
        const double tension = stiffness * std::max(0.0, part.mean);
        result.push_back({ part_name(part.part), part.girth, part.mean, 2 * M_PI * tension / part.girth });
    }
    return result;
}

namespace {

double area_gained(const WornGarment& worn)
{
    double gained = 0, all = 0;
    for (Eigen::Index f = 0; f < worn.rest.triangles.rows(); ++f) {
        const auto area_in
            = [&](const Positions& positions) { return area_vector(positions, worn.rest.triangles, f).norm(); };
        const double before = area_in(worn.rest.positions), now = area_in(worn.positions);
        all += before;
        gained += now > 2 * before ? now - before : 0;
    }
    return all > 0 ? gained / all : 0;
}

}  // namespace

Overstretch overstretch(const SkinWeights& weights, const Positions& body, const WornGarment& worn, double limit)
{
    const auto edges = edges_of(worn.rest.triangles);
    Overstretch result;
    result.limit = limit;
    result.gained = area_gained(worn);
    Vec3 place = Vec3::Zero();
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (worn.rest.positions.row(i) - worn.rest.positions.row(j)).norm();
        if (before == 0)
            continue;
        const double longer = (worn.positions.row(i) - worn.positions.row(j)).norm() - before,
                     stretch = longer / before;
        result.longer = std::max(result.longer, longer);
        result.edges += stretch > limit;
        if (stretch > result.largest) {
            result.largest = stretch;
            place = 0.5 * (worn.positions.row(i) + worn.positions.row(j));
        }
    }
    if (result.edges == 0)
        return result;
    const int bone = strongest_bones(weights_of_nearest(Positions(place.transpose()), body, weights))[0];
    if (const int part = part_of(bone); part >= 0)
        result.part = part_name(part);
    return result;
}

Overstretch find_spikes(const Rig& rig, const BodyMesh& body, const DressedBody& dressed)
{
    Overstretch result;
    if (dressed.body.rows() == 0)
        return result;
    const Positions posed = skin(body.surface.positions, rig.weights, bone_transforms(rig.skeleton, dressed.pose));
    const std::vector<int> bones = strongest_bones(rig.weights);
    const Edges edges = edges_of(body.surface.triangles);
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (posed.row(i) - posed.row(j)).norm(),
                     now = (dressed.body.row(i) - dressed.body.row(j)).norm();
        if (now <= (1 + k_spike_stretch) * before || now - before <= k_least_spike)
            continue;
        ++result.edges;
        if (const double stretch = now / std::max(before, k_least_spike) - 1; stretch > result.largest) {
            result.largest = stretch;
            result.part = part_of(bones[i]) < 0 ? "hand, foot or head" : part_name(part_of(bones[i]));
        }
    }
    return result;
}

}  // namespace garmentfit
