// SPDX-License-Identifier: GPL-3.0-or-later
#include "untangle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "exact_crossings.h"
#include "nearest.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// unit: the crossing point of an edge that grazes a triangle slides along without bound; its slope counts as at least
// this.
constexpr double k_least_slope = 1e-3;

std::vector<Crossing> find_tangles(const TriangleMesh& cloth, const Edges& edges)
{
    return find_self_crossings(cloth, edges, TriangleTree(cloth));
}

/// The cloth around its tangles.
struct Region {
    std::vector<int> vertices;  // of the whole cloth
    TriangleMesh mesh;
    std::vector<char> is_free;  // may move; the rim may not
};

// Vertices of the cloth near any of the edges and triangles that cross.
std::vector<char> mark_near(const std::vector<Crossing>& tangles, const TriangleMesh& cloth, const Edges& edges)
{
    Positions corners(5 * Eigen::Index(tangles.size()), 3);
    for (std::size_t i = 0; i < tangles.size(); ++i) {
        const auto& [e, f] = tangles[i];
        for (int k = 0; k < 5; ++k)
            corners.row(5 * Eigen::Index(i) + k) = cloth.positions.row(k < 2 ? edges(e, k) : cloth.triangles(f, k - 2));
    }
    const NearestPoint tangled(corners);
    const double reach = k_untangle_reach * mean_edge_length(cloth.positions, edges);
    std::vector<char> is_near(cloth.positions.rows());
    for (Eigen::Index v = 0; v < cloth.positions.rows(); ++v)
        is_near[v] = tangled.distance(cloth.positions.row(v)) < reach;
    return is_near;
}

Region cut_out_region(const std::vector<Crossing>& tangles, const TriangleMesh& cloth, const Edges& edges)
{
    const std::vector<char> is_near = mark_near(tangles, cloth, edges);
    Region result;
    std::vector<int> row(cloth.positions.rows(), -1);
    std::vector<Eigen::RowVector3i> triangles;
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        const auto corner = cloth.triangles.row(f);
        if (!is_near[corner[0]] && !is_near[corner[1]] && !is_near[corner[2]])
            continue;
        for (int v : corner)
            if (row[v] < 0) {
                row[v] = int(result.vertices.size());
                result.vertices.push_back(v);
                result.is_free.push_back(is_near[v]);
            }
        triangles.emplace_back(row[corner[0]], row[corner[1]], row[corner[2]]);
    }
    result.mesh.triangles.resize(Eigen::Index(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        result.mesh.triangles.row(Eigen::Index(f)) = triangles[f];
    result.mesh.positions = cloth.positions(result.vertices, Eigen::all);
    return result;
}

/// Minimises the intersection contours of a region.
class ContourMinimiser {
public:
    explicit ContourMinimiser(Region region) :
        region_(std::move(region)), given_(region_.mesh.positions),
        topology_(region_.mesh.triangles, int(given_.rows())), edges_(topology_.edges()),
        edges_at_(edge_counts(edges_, given_.rows())), search_(region_.mesh.triangles, edges_),
        step_(k_untangle_step * mean_edge_length(given_, edges_))
    {
    }

    /// Moves the region's vertices until no more than `enough` crossings are left, or to where the fewest are.
    const Region& run(std::size_t enough)
    {
        std::vector<Crossing> left = search_.find(region_.mesh.positions);
        std::size_t fewest = left.size();
        Positions best = region_.mesh.positions;
        for (int round = 0, stalled = 0;
             round < k_untangle_rounds && stalled < k_untangle_stall_rounds && left.size() > enough; ++round) {
            region_.mesh.positions += motion(left);
            left = search_.find(region_.mesh.positions);
            ++stalled;
            if (left.size() < fewest) {
                stalled = 0;
                fewest = left.size();
                best = region_.mesh.positions;
            }
        }
        region_.mesh.positions = best;
        return region_;
    }

private:
    Vec3 at(int v) const { return region_.mesh.positions.row(v); }

    /// The direction in which the edge should go, the triangle fixed, for the intersection curve to grow shorter. In
    /// each triangle at the edge the curve starts where the edge passes, and runs inwards.
    /// literature: [volino_2006_contours], the gradient R - 2 (E R) / (E N) N of a curve along R at an edge along E.
    Vec3 contour_gradient(int e, const Vec3& normal) const
    {
        const Vec3 a = at(edges_(e, 0)), along = (at(edges_(e, 1)) - a).normalized();
        const double slope = std::copysign(std::max(std::abs(along.dot(normal)), k_least_slope), along.dot(normal));
        Vec3 result = Vec3::Zero();
        for (const int side : topology_.sides_at(e)) {
            const Vec3 across = at(region_.mesh.triangles(side / 3, (side % 3 + 2) % 3)) - a;
            const Vec3 inwards = across - across.dot(along) * along;
            Vec3 curve = along.cross(across).cross(normal).normalized();
            if (curve.dot(inwards) < 0)
                curve = -curve;
            result += curve - 2 * along.dot(curve) / slope * normal;
        }
        return result / std::sqrt(result.squaredNorm() + k_untangle_gradient * k_untangle_gradient);
    }

    Positions motion(const std::vector<Crossing>& crossings) const
    {
        Positions sum = Positions::Zero(given_.rows(), 3);
        Eigen::VectorXd weights = Eigen::VectorXd::Zero(given_.rows());
        for (const auto& [e, f] : crossings)
            add_push(e, region_.mesh.triangles.row(f), sum, weights);
        return smooth(step_ * (sum.array().colwise() / weights.array().max(1)).matrix());
    }

    /// Pushes edge and triangle apart, each vertex by its weight in the crossing point.
    void add_push(int e, const Eigen::RowVector3i& corners, Positions& sum, Eigen::VectorXd& weights) const
    {
        const Vec3 p = at(edges_(e, 0)), q = at(edges_(e, 1)), a = at(corners[0]), b = at(corners[1]),
                   c = at(corners[2]);
        const Vec3 across = (b - a).cross(c - a);
        if (across.isZero(0) || p == q)
            return;
        const Vec3 normal = across.normalized();
        const double height = (q - p).dot(normal);
        const double s = height == 0 ? 0.5 : std::clamp((a - p).dot(normal) / height, 0.0, 1.0);
        const Vec3 place = p + s * (q - p), direction = contour_gradient(e, normal);
        const auto barycentric = [&](const Vec3& u, const Vec3& v) {
            return std::clamp((v - u).cross(place - u).dot(across) / across.squaredNorm(), 0.0, 1.0);
        };
        const auto push = [&](int v, double weight, const Vec3& towards) {
            sum.row(v) += weight * towards;
            weights[v] += weight;
        };
        push(edges_(e, 0), 1 - s, direction);
        push(edges_(e, 1), s, direction);
        push(corners[0], barycentric(b, c), -direction);
        push(corners[1], barycentric(c, a), -direction);
        push(corners[2], barycentric(a, b), -direction);
    }

    Positions smooth(Positions motion) const
    {
        for (int pass = 0; pass < k_untangle_smoothing_passes; ++pass) {
            Positions sum = Positions::Zero(motion.rows(), 3);
            add_neighbours(edges_, motion, sum);
            for (Eigen::Index v = 0; v < motion.rows(); ++v)
                motion.row(v) = region_.is_free[v]
                    ? Eigen::RowVector3d((1 - k_untangle_smoothing) * motion.row(v)
                                         + k_untangle_smoothing / edges_at_[v] * sum.row(v))
                    : Eigen::RowVector3d::Zero();
        }
        return motion;
    }

    Region region_;
    const Positions given_;
    const MeshTopology topology_;
    const Edges& edges_;  // of topology_
    const Eigen::VectorXd edges_at_;  // each vertex
    SelfCrossingSearch search_;
    const double step_;  // metres
};

/// What an untangling that does not come to its end may keep: only crossings that the cloth was given with.
class PartialResult {
public:
    PartialResult(const TriangleMesh& given, const Edges& edges, const std::vector<Crossing>& tangles,
                  const Positions& parted) :
        given_(given),
        edges_(edges), tangles_(tangles), parted_(parted), search_(given.triangles, edges_),
        rings_(given.positions.rows(), k_untangle_blend_rings)
    {
    }

    /// Restores the cloth around new crossings until there are none. Each round restores more, so it ends.
    UntangleResult settle()
    {
        for (;;) {
            Positions positions = blended();
            std::vector<Crossing> left = search_.find(positions), fresh;
            std::set_difference(left.begin(), left.end(), tangles_.begin(), tangles_.end(), std::back_inserter(fresh));
            if (fresh.empty())
                return { std::move(positions), std::move(left) };
            restore(fresh);
        }
    }

private:
    /// The parted cloth, moved less the nearer it is to restored cloth.
    Positions blended() const
    {
        Positions result = parted_;
        for (Eigen::Index v = 0; v < result.rows(); ++v)
            if (rings_[v] < k_untangle_blend_rings)
                result.row(v) = given_.positions.row(v)
                    + double(rings_[v]) / k_untangle_blend_rings * (parted_.row(v) - given_.positions.row(v));
        return result;
    }

    // The corners of the crossings, and one ring about those that are restored already.
    void restore(const std::vector<Crossing>& fresh)
    {
        const auto restore_corner = [&](int v) {
            if (rings_[v] == 0)
                widened_.push_back(v);
            rings_[v] = 0;
        };
        widened_.clear();
        for (const auto& [e, f] : fresh) {
            for (const int v : edges_.row(e))
                restore_corner(v);
            for (const int v : given_.triangles.row(f))
                restore_corner(v);
        }
        widen();
        spread_rings();
    }

    void widen()
    {
        std::vector<char> is_centre(rings_.size(), 0);
        for (const int v : widened_)
            is_centre[v] = 1;
        for (Eigen::Index e = 0; e < edges_.rows(); ++e)
            if (is_centre[edges_(e, 0)] || is_centre[edges_(e, 1)])
                rings_[edges_(e, 0)] = rings_[edges_(e, 1)] = 0;
    }

    // One ring more of edges for each pass.
    void spread_rings()
    {
        for (int pass = 1; pass < k_untangle_blend_rings; ++pass)
            for (Eigen::Index e = 0; e < edges_.rows(); ++e) {
                int &a = rings_[edges_(e, 0)], &b = rings_[edges_(e, 1)];
                a = std::min(a, b + 1);
                b = std::min(b, a + 1);
            }
    }

    const TriangleMesh& given_;
    const Edges& edges_;
    const std::vector<Crossing>& tangles_;
    const Positions& parted_;
    SelfCrossingSearch search_;
    std::vector<int> rings_;  // of edges, from the restored cloth
    std::vector<int> widened_;
};

/// Moves the cloth around its tangles until no more than `enough` are left, or to where the fewest are.
Positions minimise_contours(const TriangleMesh& cloth, const Edges& edges, const std::vector<Crossing>& tangles,
                            std::size_t enough)
{
    ContourMinimiser minimiser(cut_out_region(tangles, cloth, edges));
    const Region& parted = minimiser.run(enough);
    Positions positions = cloth.positions;
    positions(parted.vertices, Eigen::all) = parted.mesh.positions;
    return positions;
}

}  // namespace

UntangleResult untangle(const TriangleMesh& cloth) { return untangle(cloth, edges_of(cloth.triangles)); }

UntangleResult untangle(const TriangleMesh& cloth, const Edges& edges)
{
    const std::vector<Crossing> tangles = find_tangles(cloth, edges);
    if (tangles.empty())
        return { cloth.positions, {} };
    return PartialResult(cloth, edges, tangles, minimise_contours(cloth, edges, tangles, 0)).settle();
}

Positions reduce_crossings(const TriangleMesh& cloth, const Edges& edges, std::size_t enough)
{
    const std::vector<Crossing> tangles = find_tangles(cloth, edges);
    return tangles.size() <= enough ? cloth.positions : minimise_contours(cloth, edges, tangles, enough);
}

}  // namespace garmentfit
