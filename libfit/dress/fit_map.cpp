// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_map.h"

#include <algorithm>

#include "body_parts.h"
#include "cloth_energy.h"
#include "cloth_motion.h"
#include "nearest.h"
#include "parallel.h"
#include "skin_weights.h"
#include "tuning.h"
#include "weld.h"

namespace garmentfit {
namespace {

/// At each vertex the mean of l / l0 - 1 over its edges.
Eigen::VectorXd mean_stretches(const GarmentMesh& rest, const Positions& positions)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(positions.rows()), count = sum;
    const auto edges = edges_of(rest.triangles);
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (rest.positions.row(i) - rest.positions.row(j)).norm();
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
    const Weld weld(worn.rest);
    const GarmentMesh rest = weld.gathered(worn.rest);
    const Positions x = weld.gathered(worn.positions);
    const double density = material_of(options).density;
    const ClothEnergy energy(rest, MeshTopology(rest.triangles, int(rest.positions.rows())), {}, options);
    const Positions forces = energy.elastic_forces(x);
    const TriangleTree skin(body);

    Positions cloth(x.rows(), 3);  // ease, strain, pressure
    cloth.col(1) = mean_stretches(rest, x);
    parallel_for(x.rows(), [&](Eigen::Index v) {
        const Vec3 out = x.row(v).transpose() - skin.nearest(x.row(v));
        const double ease = out.norm(), mass = energy.masses()[v];
        const Vec3 force = forces.row(v).transpose() - mass * k_gravity * Vec3::UnitY();
        const double inwards = ease > 0 ? -force.dot(out) / ease : 0;
        cloth(v, 0) = ease;
        cloth(v, 2)
            = ease < k_pressing_distance * options.contact_distance ? std::max(inwards, 0.0) / (mass / density) : 0;
    });
    const Positions result = weld.spread(cloth);
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
