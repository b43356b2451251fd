// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"

#include <algorithm>

#include "nearest.h"

namespace fit {

void append(TriangleMesh& mesh, const TriangleMesh& more)
{
    const Eigen::Index vertices = mesh.positions.rows(), triangles = mesh.triangles.rows();
    mesh.positions.conservativeResize(vertices + more.positions.rows(), 3);
    mesh.positions.bottomRows(more.positions.rows()) = more.positions;
    mesh.triangles.conservativeResize(triangles + more.triangles.rows(), 3);
    mesh.triangles.bottomRows(more.triangles.rows()) = (more.triangles.array() + int(vertices)).matrix();
}

void append(SkinWeights& weights, const SkinWeights& more)
{
    const Eigen::Index rows = weights.bones.rows();
    weights.bones.conservativeResize(rows + more.bones.rows(), 4);
    weights.bones.bottomRows(more.bones.rows()) = more.bones;
    weights.weights.conservativeResize(rows + more.weights.rows(), 4);
    weights.weights.bottomRows(more.weights.rows()) = more.weights;
}

void put_positions(std::vector<WornGarment>& garments, const Positions& positions)
{
    Eigen::Index first = 0;
    for (WornGarment& garment : garments) {
        garment.positions = positions.middleRows(first, garment.rest.positions.rows());
        first += garment.rest.positions.rows();
    }
}

void add_slips(std::vector<WornGarment>& garments, const Positions& along)
{
    Eigen::Index first = 0;
    for (WornGarment& garment : garments) {
        const Eigen::Index vertices = garment.positions.rows();
        Eigen::VectorXd down = along.col(1).segment(first, vertices) - garment.positions.col(1);
        const auto middle = down.begin() + vertices / 2;
        std::nth_element(down.begin(), middle, down.end());
        garment.slipped += *middle;
        first += vertices;
    }
}

SkinWeights weights_of_nearest(const Positions& points, const Positions& body, const SkinWeights& weights)
{
    SkinWeights result;
    result.bones.resize(points.rows(), 4);
    result.weights.resize(points.rows(), 4);
    const NearestPoint nearest(body);
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
        const int there = nearest.index(points.row(v));
        result.bones.row(v) = weights.bones.row(there);
        result.weights.row(v) = weights.weights.row(there);
    }
    return result;
}

SkinWeights strongest_four(Eigen::MatrixXd dense)
{
    SkinWeights result;
    result.bones.resize(dense.rows(), 4);
    result.weights.resize(dense.rows(), 4);
    for (Eigen::Index v = 0; v < dense.rows(); ++v) {
        for (int k = 0; k < 4; ++k) {
            result.weights(v, k) = dense.row(v).maxCoeff(&result.bones(v, k));
            dense(v, result.bones(v, k)) = 0;
        }
        result.weights.row(v) /= result.weights.row(v).sum();
    }
    return result;
}

}  // namespace fit
