// SPDX-License-Identifier: GPL-3.0-or-later
#include "pressed_skin.h"

#include "garmentfit/mesh.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {

Positions give_way(const Positions& pressed, const Positions& own, const Triangles& triangles, double by)
{
    const Edges edges = edges_of(triangles);
    const Eigen::ArrayXd neighbours = edge_counts(edges, own.rows()).array().max(1);
    const Eigen::VectorXd held = ((pressed - own).rowwise().squaredNorm().array() > 0).cast<double>();
    Eigen::VectorXd share = held;
    for (int ring = 0; ring < k_rings_round_pressed; ++ring) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(own.rows());
        add_neighbours(edges, share, sum);
        share = held.array().max(sum.array() / neighbours);
    }
    return pressed - by * (share.asDiagonal() * vertex_normals(own, triangles));
}

}  // namespace garmentfit
