// SPDX-License-Identifier: GPL-3.0-or-later
#include "untangle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "disjoint_sets.h"
#include "nearest.h"

namespace garmentfit {
namespace {

constexpr int k_rounds = 300;
constexpr int k_patience = 60;  // rounds without fewer crossings than ever before
// Lengths in mean edges of the tangled cloth: the way of a vertex in one round, and how far round a tangle cloth gives way.
constexpr double k_step = 0.3, k_reach = 5;
// A tangle goes apart as a piece of cloth and not vertex by vertex: passes over the edges that even its motion out.
constexpr int k_smoothing_passes = 4;
// An edge that grazes a triangle has its crossing point slide along for ever; the slope counts as at least this.
constexpr double k_least_slope = 1e-3;

using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The cloth about its tangles.
struct Region {
    std::vector<int> vertices;  // of the whole cloth
    TriangleMesh mesh;
    std::vector<char> free;  // vertices that may move; the rim may not
};

double mean_length(const Positions& x, const Edges& edges)
{
    double sum = 0;
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        sum += (x.row(edges(e, 0)) - x.row(edges(e, 1))).norm();
    return sum / double(edges.rows());
}

Region region_about(const std::vector<Crossing>& tangles, const TriangleMesh& cloth)
{
    const Edges edges = edges_of(cloth.triangles);
    Positions corners(5 * Eigen::Index(tangles.size()), 3);
    for (std::size_t i = 0; i < tangles.size(); ++i) {
        const auto& [e, f] = tangles[i];
        for (int k = 0; k < 5; ++k)
            corners.row(5 * Eigen::Index(i) + k) = cloth.positions.row(k < 2 ? edges(e, k) : cloth.triangles(f, k - 2));
    }
    const NearestPoint tangled(corners);
    const double reach = k_reach * mean_length(cloth.positions, edges);
    std::vector<char> near(cloth.positions.rows());
    for (Eigen::Index v = 0; v < cloth.positions.rows(); ++v)
        near[v] = tangled.distance(cloth.positions.row(v)) < reach;

    Region result;
    std::vector<int> row(cloth.positions.rows(), -1);
    std::vector<Eigen::RowVector3i> triangles;
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        const auto corner = cloth.triangles.row(f);
        if (!near[corner[0]] && !near[corner[1]] && !near[corner[2]])
            continue;
        for (int v : corner)
            if (row[v] < 0) {
                row[v] = int(result.vertices.size());
                result.vertices.push_back(v);
                result.free.push_back(near[v]);
            }
        triangles.emplace_back(row[corner[0]], row[corner[1]], row[corner[2]]);
    }
    result.mesh.triangles.resize(Eigen::Index(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        result.mesh.triangles.row(Eigen::Index(f)) = triangles[f];
    result.mesh.positions = cloth.positions(result.vertices, Eigen::all);
    return result;
}

class Untangling {
public:
    explicit Untangling(Region region) :
        region_(std::move(region)), given_(region_.mesh.positions), edges_(edges_of(region_.mesh.triangles)),
        step_(k_step * mean_length(given_, edges_))
    {
        for (const auto& corners : region_.mesh.triangles.rowwise())
            for (int k = 0; k < 3; ++k)
                opposite_[std::minmax({ corners[k], corners[(k + 1) % 3] })].push_back(corners[(k + 2) % 3]);
    }

    /// Moves the region's vertices until nothing crosses, and puts those of tangles that are left back.
    const Region& run()
    {
        std::vector<Crossing> left = self_crossings(region_.mesh);
        std::size_t fewest = left.size();
        for (int round = 0, in_vain = 0; round < k_rounds && in_vain < k_patience && !left.empty(); ++round) {
            region_.mesh.positions += motion(left);
            left = self_crossings(region_.mesh);
            in_vain = left.size() < fewest ? 0 : in_vain + 1;
            fewest = std::min(fewest, left.size());
        }
        restore(left);
        return region_;
    }

private:
    Vec3 at(int v) const { return region_.mesh.positions.row(v); }

    /// Where the edge should go, the triangle staying, for the crossing curve to grow shorter. Of each triangle at the edge
    /// the curve starts where the edge passes, and runs inwards.
    Vec3 way_out(int e, const Vec3& normal) const
    {
        const Vec3 a = at(edges_(e, 0)), along = (at(edges_(e, 1)) - a).normalized();
        const double slope = std::copysign(std::max(std::abs(along.dot(normal)), k_least_slope), along.dot(normal));
        Vec3 result = Vec3::Zero();
        for (int v : opposite_.at({ edges_(e, 0), edges_(e, 1) })) {
            const Vec3 across = at(v) - a, inwards = across - across.dot(along) * along;
            Vec3 curve = along.cross(across).cross(normal).normalized();
            if (curve.dot(inwards) < 0)
                curve = -curve;
            result += curve - 2 * along.dot(curve) / slope * normal;
        }
        return result / std::sqrt(result.squaredNorm() + 1);
    }

    Positions motion(const std::vector<Crossing>& crossings) const
    {
        Positions sum = Positions::Zero(given_.rows(), 3);
        Eigen::VectorXd shares = Eigen::VectorXd::Zero(given_.rows());
        for (const auto& [e, f] : crossings)
            add(e, region_.mesh.triangles.row(f), sum, shares);
        return smooth(step_ * (sum.array().colwise() / shares.array().max(1)).matrix());
    }

    void add(int e, const Eigen::RowVector3i& corners, Positions& sum, Eigen::VectorXd& shares) const
    {
        const Vec3 p = at(edges_(e, 0)), q = at(edges_(e, 1)), a = at(corners[0]), b = at(corners[1]),
                   c = at(corners[2]);
        const Vec3 across = (b - a).cross(c - a);
        if (across.isZero(0) || p == q)
            return;
        const Vec3 normal = across.normalized();
        const double height = (q - p).dot(normal);
        const double s = height == 0 ? 0.5 : std::clamp((a - p).dot(normal) / height, 0.0, 1.0);
        const Vec3 place = p + s * (q - p), way = way_out(e, normal);
        const auto share = [&](const Vec3& u, const Vec3& v) {
            return std::clamp((v - u).cross(place - u).dot(across) / across.squaredNorm(), 0.0, 1.0);
        };
        const auto push = [&](int v, double weight, const Vec3& direction) {
            sum.row(v) += weight * direction;
            shares[v] += weight;
        };
        push(edges_(e, 0), 1 - s, way);
        push(edges_(e, 1), s, way);
        push(corners[0], share(b, c), -way);
        push(corners[1], share(c, a), -way);
        push(corners[2], share(a, b), -way);
    }

    Positions smooth(Positions motion) const
    {
        for (int pass = 0; pass < k_smoothing_passes; ++pass) {
            Positions sum = Positions::Zero(motion.rows(), 3);
            Eigen::VectorXd count = Eigen::VectorXd::Zero(motion.rows());
            for (Eigen::Index e = 0; e < edges_.rows(); ++e)
                for (int k = 0; k < 2; ++k) {
                    sum.row(edges_(e, k)) += motion.row(edges_(e, 1 - k));
                    count[edges_(e, k)] += 1;
                }
            for (Eigen::Index v = 0; v < motion.rows(); ++v)
                motion.row(v) = region_.free[v] ? Eigen::RowVector3d(0.5 * motion.row(v) + 0.5 / count[v] * sum.row(v))
                                                : Eigen::RowVector3d::Zero();
        }
        return motion;
    }

    void restore(const std::vector<Crossing>& left)
    {
        const TriangleMesh& mesh = region_.mesh;
        DisjointSets pieces(int(given_.rows()));
        for (Eigen::Index e = 0; e < edges_.rows(); ++e)
            pieces.join(edges_(e, 0), edges_(e, 1));
        for (const auto& [e, f] : left)
            pieces.join(edges_(e, 0), mesh.triangles(f, 0));
        std::vector<char> tangled(given_.rows(), 0);
        for (const auto& [e, f] : left)
            tangled[pieces.root(edges_(e, 0))] = 1;
        for (int v = 0; v < int(given_.rows()); ++v)
            if (tangled[pieces.root(v)])
                region_.mesh.positions.row(v) = given_.row(v);
    }

    Region region_;
    Positions given_;
    Edges edges_;
    std::map<std::pair<int, int>, std::vector<int>> opposite_;  // corners to each edge, in its triangles
    double step_;  // metres
};

}  // namespace

Untangled untangle(const TriangleMesh& cloth)
{
    const std::vector<Crossing> tangles = self_crossings(cloth);
    if (tangles.empty())
        return { cloth.positions, {} };
    Untangling untangling(region_about(tangles, cloth));
    const Region& parted = untangling.run();
    TriangleMesh result = cloth;
    result.positions(parted.vertices, Eigen::all) = parted.mesh.positions;
    const std::vector<Crossing> left = self_crossings(result);
    if (!std::includes(tangles.begin(), tangles.end(), left.begin(), left.end()))
        return { cloth.positions, tangles };
    return { result.positions, left };
}

}  // namespace garmentfit
