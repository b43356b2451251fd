// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_map.h"

#include <algorithm>

#include "body_parts.h"
#include "cloth_energy.h"
#include "cloth_motion.h"
#include "nearest.h"
#include "parallel.h"
#include "prepared_cloth.h"
#include "skin_weights.h"
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
    const double density = material_of(options).density;
    const ClothEnergy energy(cloth.rest, cloth.topology, {}, options);
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

Overstretch overstretch(const SkinWeights& weights, const Positions& body, const WornGarment& worn)
{
    const auto edges = edges_of(worn.rest.triangles);
    Overstretch result;
    Vec3 place = Vec3::Zero();
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (worn.rest.positions.row(i) - worn.rest.positions.row(j)).norm();
        if (before == 0)
            continue;
        const double stretch = (worn.positions.row(i) - worn.positions.row(j)).norm() / before - 1;
        result.edges += stretch > k_overstretched;
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

}  // namespace garmentfit
