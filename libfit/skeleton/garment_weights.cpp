// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/garment_weights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "barycentric.h"
#include "disjoint_sets.h"
#include "garmentfit/error.h"
#include "nearest.h"
#include "parallel.h"
#include "sewn_pieces.h"
#include "skin_inpainting.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"
#include "weld.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr double k_row_sum_precision = 1e-3;  // unit: weights of files come in single bytes
constexpr int k_most_joints = 8;  // unit: two sets of four, as files have them

void require_valid(const TriangleMesh& body, const JointWeights& weights, const GarmentMesh& garment,
                   const Positions& worn, const GarmentWeightOptions& options)
{
    if (weights.rows() != body.positions.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           "skin weights: " + std::to_string(weights.rows()) + " rows for "
                               + std::to_string(body.positions.rows())
                               + " vertices of the body; give a row for each vertex");
    if (worn.rows() != garment.positions.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           "garment: " + std::to_string(worn.rows()) + " vertices as worn, "
                               + std::to_string(garment.positions.rows())
                               + " as given; give the same vertices in the same order");
    if (!(options.largest_angle > 0 && options.largest_angle < 90) || options.joints_per_vertex < 1
        || options.joints_per_vertex > k_most_joints)
        throw InvalidInput(
            ErrorCode::out_of_range,
            "weights of a garment: give an angle between 0 and 90 degrees, and 1 to 8 joints per vertex");
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        if (!(std::abs(weights.row(v).sum() - 1) < k_row_sum_precision))
            throw InvalidInput(ErrorCode::bad_rig,
                               "skin weights of the body, vertex " + std::to_string(v) + ", sum to "
                                   + std::to_string(weights.row(v).sum()) + "; normalise them to 1");
}

/// The skin nearest to a vertex of the cloth.
struct Foot {
    int triangle = 0;
    Eigen::RowVector3d corners = { 1, 0, 0 };  // barycentric weights
    double distance = 0;
    double cosine = 0;  // between the normals of skin and cloth
};

std::vector<Foot> find_feet(const TriangleMesh& body, const Positions& cloth, const Positions& cloth_normals)
{
    const TriangleTree tree(body);
    const Positions normals = vertex_normals(body.positions, body.triangles);
    std::vector<Foot> feet(std::size_t(cloth.rows()));
    parallel_for(feet.size(), [&](std::size_t v) {
        const Vec3 place = cloth.row(Eigen::Index(v));
        const auto nearest = tree.nearest_triangle(place);
        if (!nearest)
            return;
        const Eigen::RowVector3i corners = body.triangles.row(nearest->triangle);
        const auto corner = [&](int k) { return Vec3(body.positions.row(corners[k])); };
        Foot& foot = feet[v];
        foot.triangle = nearest->triangle;
        foot.corners = Eigen::RowVector3d::Map(barycentric(nearest->point, corner(0), corner(1), corner(2)).data());
        foot.distance = (nearest->point - place).norm();
        const Vec3 normal = (foot.corners * normals(corners, Eigen::all)).transpose();
        foot.cosine = normal.normalized().dot(Vec3(cloth_normals.row(Eigen::Index(v))));
    });
    return feet;
}

/// Which side of a piece of cloth faces the skin.
struct Sides {
    int inside = 0, outside = 0;  // vertices with the normal of the skin, and with the opposite one

    bool is_two_sheets() const { return std::min(inside, outside) > k_second_sheet * (inside + outside); }
    /// Faces of garments may be oriented either way, so the larger number says which one it is.
    bool fits(double cosine) const { return is_two_sheets() || (cosine > 0) == (inside >= outside); }
};

/// Of each piece of cloth, by its root, which of its sides the skin within `reach` lies on.
std::vector<Sides> sides_of(const std::vector<Foot>& feet, DisjointSets& pieces, double reach, double least_cosine)
{
    std::vector<Sides> sides(feet.size());
    for (int v = 0; v < int(feet.size()); ++v)
        if (feet[v].distance < reach && std::abs(feet[v].cosine) > least_cosine)
            ++(feet[v].cosine > 0 ? sides[pieces.root(v)].inside : sides[pieces.root(v)].outside);
    return sides;
}

/// The weights of skin far away are smoothed more, as less is known which skin the cloth will follow.
double pull_of(double distance, double close)
{
    const double length = k_smoothing_of_distance * std::max(distance, close);
    return 1 / (length * length);
}

/// How firmly each vertex of the cloth is drawn to the weights of its foot: the nearer and the more alike in direction.
Eigen::VectorXd pulls_to_skin(const std::vector<Foot>& feet, DisjointSets& pieces, const std::vector<Sides>& sides,
                              double close, double least_cosine)
{
    Eigen::VectorXd pulls(Eigen::Index(feet.size()));
    for (int v = 0; v < int(feet.size()); ++v) {
        const double cosine = sides[pieces.root(v)].fits(feet[v].cosine) ? std::abs(feet[v].cosine) : 0;
        pulls[v] = std::max(0.0, cosine - least_cosine) / (1 - least_cosine) * pull_of(feet[v].distance, close);
    }
    return pulls;
}

DisjointSets pieces_of(const GarmentMesh& cloth)
{
    DisjointSets pieces(int(cloth.positions.rows()));
    for (const auto& corners : cloth.triangles.rowwise())
        for (int k = 1; k < 3; ++k)
            pieces.join(corners[0], corners[k]);
    return pieces;
}

/// What is held by other cloth, such as a button, follows that cloth and not the skin.
void release_held_pieces(const std::vector<Tie>& ties, DisjointSets& pieces, Eigen::VectorXd& pulls)
{
    std::vector<char> is_held(std::size_t(pulls.size()), 0);
    for (const Tie& tie : ties)
        if (!tie.is_seam)
            is_held[pieces.root(tie.vertex)] = 1;
    for (int v = 0; v < int(pulls.size()); ++v)
        if (is_held[pieces.root(v)])
            pulls[v] = 0;
}

/// Cloth that nothing draws follows the skin next to it.
void anchor_the_rest(const std::vector<Foot>& feet, const std::vector<Tie>& ties, DisjointSets pieces, double close,
                     Eigen::VectorXd& pulls)
{
    for (const Tie& tie : ties)
        for (const int corner : tie.corners)
            pieces.join(tie.vertex, corner);
    std::vector<char> is_drawn(feet.size(), 0);
    std::vector<int> nearest(feet.size(), -1);
    for (int v = 0; v < int(feet.size()); ++v) {
        int& best = nearest[pieces.root(v)];
        is_drawn[pieces.root(v)] |= pulls[v] > 0;
        if (best < 0 || feet[v].distance < feet[best].distance)
            best = v;
    }
    for (int v = 0; v < int(feet.size()); ++v)
        if (nearest[v] >= 0 && !is_drawn[v])
            pulls[nearest[v]] = pull_of(feet[nearest[v]].distance, close);
}

Eigen::MatrixXd weights_at(const std::vector<Foot>& feet, const TriangleMesh& body, const JointWeights& weights)
{
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Eigen::Index(feet.size()), weights.cols());
    for (std::size_t v = 0; v < feet.size(); ++v)
        for (int k = 0; k < 3; ++k)
            for (JointWeights::InnerIterator entry(weights, body.triangles(feet[v].triangle, k)); entry; ++entry)
                result(Eigen::Index(v), entry.col()) += feet[v].corners[k] * entry.value();
    return result;
}

using Entry = std::pair<double, int>;  // weight, joint

/// The largest weights of a row, scaled to sum to 1. Of equal ones, the first joints.
std::vector<Entry> largest_of(const Eigen::RowVectorXd& row, int count)
{
    std::vector<Entry> entries;
    for (int j = 0; j < int(row.size()); ++j)
        if (row[j] > k_least_weight)
            entries.emplace_back(row[j], j);
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.first > b.first; });
    entries.resize(std::min(entries.size(), std::size_t(count)));
    double sum = 0;
    for (const auto& [weight, joint] : entries)
        sum += weight;
    for (auto& [weight, joint] : entries)
        weight /= sum;
    return entries;
}

JointWeights spread(const Eigen::MatrixXd& cloth_weights, const Weld& weld, int joints_per_vertex)
{
    std::vector<std::vector<Entry>> rows(std::size_t(cloth_weights.rows()));
    parallel_for(rows.size(),
                 [&](std::size_t v) { rows[v] = largest_of(cloth_weights.row(Eigen::Index(v)), joints_per_vertex); });
    std::vector<Eigen::Triplet<double>> entries;
    for (int v = 0; v < weld.given(); ++v)
        for (const auto& [weight, joint] : rows[std::size_t(weld.cloth_vertex(v))])
            entries.emplace_back(v, joint, weight);
    JointWeights result(weld.given(), cloth_weights.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

}  // namespace

JointWeights joint_weights_of(const SkinWeights& weights)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index v = 0; v < weights.bones.rows(); ++v)
        for (int k = 0; k < 4; ++k)
            if (weights.weights(v, k) > 0)
                entries.emplace_back(int(v), weights.bones(v, k), weights.weights(v, k));
    JointWeights result(weights.bones.rows(), bone_count);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

SkinWeights skin_weights_of(const JointWeights& weights)
{
    SkinWeights result;
    result.bones.setZero(weights.rows(), 4);
    result.weights.setZero(weights.rows(), 4);
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        const std::vector<Entry> entries = largest_of(Eigen::RowVectorXd(weights.row(v)), 4);
        for (int k = 0; k < int(entries.size()); ++k) {
            result.bones(v, k) = entries[std::size_t(k)].second;
            result.weights(v, k) = entries[std::size_t(k)].first;
        }
    }
    return result;
}

JointWeights garment_weights(const TriangleMesh& body, const JointWeights& body_weights, const GarmentMesh& garment,
                             const Positions& worn, const GarmentWeightOptions& options)
{
    require_valid(body, body_weights, garment, worn, options);
    const Weld weld(garment);
    const GarmentMesh cloth = weld.gather(garment);
    const Positions worn_cloth = weld.gather(worn);
    const std::vector<Tie> ties
        = find_sewn_pieces(cloth, MeshTopology(cloth.triangles, int(cloth.positions.rows()))).ties;
    DisjointSets pieces = pieces_of(cloth);
    const double size = diagonal(body.positions), close = k_close_skin * size;
    const double least_cosine = std::cos(options.largest_angle * std::numbers::pi / 180);

    const std::vector<Foot> feet = find_feet(body, worn_cloth, vertex_normals(worn_cloth, cloth.triangles));
    const std::vector<Sides> sides = sides_of(feet, pieces, k_side_reach * size, least_cosine);
    Eigen::VectorXd pulls = pulls_to_skin(feet, pieces, sides, close, least_cosine);
    release_held_pieces(ties, pieces, pulls);
    anchor_the_rest(feet, ties, pieces, close, pulls);

    const Eigen::MatrixXd weights
        = inpaint(cloth, ties, pulls, weights_at(feet, body, body_weights), k_stiff_length * size);
    return spread(weights, weld, options.joints_per_vertex);
}

SkinWeights garment_weights(const TriangleMesh& body, const SkinWeights& body_weights, const GarmentMesh& garment,
                            const Positions& worn, const GarmentWeightOptions& options)
{
    GarmentWeightOptions at_most_four = options;
    if (options.joints_per_vertex <= k_most_joints)  // more than those is refused
        at_most_four.joints_per_vertex = std::min(options.joints_per_vertex, 4);
    return skin_weights_of(garment_weights(body, joint_weights_of(body_weights), garment, worn, at_most_four));
}

}  // namespace garmentfit
