// SPDX-License-Identifier: GPL-3.0-or-later
#include "skin_weights.h"

#include "nearest.h"

namespace garmentfit {

void append(SkinWeights& weights, const SkinWeights& more)
{
    const Eigen::Index rows = weights.bones.rows();
    weights.bones.conservativeResize(rows + more.bones.rows(), 4);
    weights.bones.bottomRows(more.bones.rows()) = more.bones;
    weights.weights.conservativeResize(rows + more.weights.rows(), 4);
    weights.weights.bottomRows(more.weights.rows()) = more.weights;
}

std::vector<int> strongest_bones(const SkinWeights& weights)
{
    std::vector<int> result(weights.bones.rows());
    for (std::size_t v = 0; v < result.size(); ++v) {
        int k;
        weights.weights.row(v).maxCoeff(&k);
        result[v] = weights.bones(v, k);
    }
    return result;
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

}  // namespace garmentfit
