// SPDX-License-Identifier: GPL-3.0-or-later
#include "embedded_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include <Eigen/SVD>

#include "barycentric.h"
#include "nearest.h"
#include "parallel.h"
#include "proximity.h"
#include "torn_regions.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// The rotation that takes the triangles round each vertex from rest to where they are, by least squares.
std::vector<Eigen::Matrix3d> rotations(const GarmentMesh& rest, const Positions& worn)
{
    std::vector<Eigen::Matrix3d> moved(rest.positions.rows(), Eigen::Matrix3d::Zero());
    for (const auto& corners : rest.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const int a = corners[k], b = corners[(k + 1) % 3], c = corners[(k + 2) % 3];
            const auto side = [a](const Positions& x, int to) { return Vec3(x.row(to) - x.row(a)); };
            const Vec3 p = side(rest.positions, b), q = side(rest.positions, c), r = side(worn, b), s = side(worn, c);
            moved[a] += r * p.transpose() + s * q.transpose() + r.cross(s).stableNormalized() * p.cross(q).transpose();
        }
    parallel_for(moved.size(), [&](std::size_t v) {
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moved[v], Eigen::ComputeFullU | Eigen::ComputeFullV);
        Eigen::Matrix3d left = svd.matrixU();
        if ((left * svd.matrixV().transpose()).determinant() < 0)
            left.col(2) *= -1;
        moved[v] = left * svd.matrixV().transpose();
    });
    return moved;
}

/// The vertices of a mesh from some of them on, over its edges, up to a distance from a place. The same object serves
/// many searches.
class Neighbourhood {
public:
    explicit Neighbourhood(const Positions& positions, const MeshTopology& topology) :
        positions_(positions), topology_(topology), seen_(positions.rows(), 0)
    {
    }

    const std::vector<int>& around(const Vec3& place, const Eigen::RowVector3i& first, double reach)
    {
        for (const int v : found_)
            seen_[v] = 0;
        found_.clear();
        const auto add = [&](int v) {
            if (!seen_[v])
                found_.push_back(v);
            seen_[v] = 1;
        };
        for (const int v : first)
            add(v);
        for (std::size_t next = 0; next < found_.size(); ++next)
            for (const int n : topology_.neighbours(found_[next]))
                if ((positions_.row(n) - place.transpose()).norm() < reach)
                    add(n);
        return found_;
    }

private:
    const Positions& positions_;
    const MeshTopology& topology_;
    std::vector<char> seen_;
    std::vector<int> found_;
};

/// Where a stand-in is, and how it takes along what is near it.
class Motion {
public:
    Motion(const GarmentMesh& stand_in, const Positions& worn) :
        rest_(stand_in), worn_(worn), topology_(stand_in.triangles, int(stand_in.positions.rows())),
        turns_(rotations(stand_in, worn)), sheet_({ stand_in.positions, stand_in.triangles }),
        faces_at_(stand_in.positions.rows()), edge_(mean_edge_length(stand_in.positions, topology_.edges()))
    {
        for (int f = 0; f < int(stand_in.triangles.rows()); ++f)
            for (const int v : stand_in.triangles.row(f))
                faces_at_[v].push_back(f);
    }

    LedPlaces apply(const TriangleMesh& cloth, const MeshTopology& topology) const
    {
        const Positions& garment = cloth.positions;
        std::vector<Binding> bindings(garment.rows());
        parallel_for(garment.rows(), [&](Eigen::Index v) { bindings[v] = *sheet_.nearest_triangle(garment.row(v)); });
        const double reach = reach_for(garment, bindings);
        LedPlaces places = move(garment, bindings, reach);
        if (bind_along_the_cloth(garment, topology, places.positions, bindings))
            places = move(garment, bindings, reach);
        if (has_tears(garment, places.positions, topology))
            mend_tears(cloth, topology, reach, bindings, places);
        return places;
    }

private:
    using Binding = TriangleTree::Nearest;  // where a vertex hangs on the stand-in

    /// Along an edge of the garment, or from a vertex to itself.
    struct Step {
        double doubt;  ///< m, at its end: the way from where bindings are sure
        int from, to;

        auto operator<=>(const Step&) const = default;
    };

    /// How far from the nearest point of the stand-in the motions are blended, m. A garment that is the stand-in's own
    /// surface keeps the stand-in's folds; sheets that lie beside it, and each other, have to move alike.
    double reach_for(const Positions& garment, const std::vector<Binding>& bindings) const
    {
        double off = 0;
        for (Eigen::Index v = 0; v < garment.rows(); ++v)
            off += (bindings[v].point - garment.row(v).transpose()).norm() / double(garment.rows());
        return (off < k_same_surface * edge_ ? k_own_reach : k_following_reach) * edge_;
    }

    LedPlaces move(const Positions& garment, const std::vector<Binding>& bindings, double reach) const
    {
        LedPlaces places { Positions(garment.rows(), 3), Positions(garment.rows(), 3),
                           std::vector<Eigen::Matrix3d>(garment.rows()) };
        std::vector<int> all(garment.rows());
        std::iota(all.begin(), all.end(), 0);
        move(garment, all, bindings, reach, places);
        return places;
    }

    /// Renews the places of some vertices.
    void move(const Positions& garment, const std::vector<int>& vertices, const std::vector<Binding>& bindings,
              double reach, LedPlaces& places) const
    {
        constexpr std::size_t k_grain = 1024;  // unit: of the parallel loop; each piece has its own Neighbourhood
        parallel_for((vertices.size() + k_grain - 1) / k_grain, [&](std::size_t piece) {
            Neighbourhood neighbourhood(rest_.positions, topology_);
            for (std::size_t i = piece * k_grain; i < std::min((piece + 1) * k_grain, vertices.size()); ++i) {
                const int v = vertices[i];
                const Led led = move(garment.row(v), bindings[v], reach, neighbourhood);
                places.feet.row(v) = led.foot;
                places.positions.row(v) = led.position;
                places.turns[v] = led.turn;
            }
        });
    }

    struct Led {
        Vec3 foot, position;
        Eigen::Matrix3d turn;
    };

    /// Where the nearest point of the stand-in goes, and the place itself. What lies side by side is moved alike,
    /// whichever triangles are nearest to it: the motions of all vertices near by are blended.
    Led move(const Vec3& place, const Binding& binding, double reach, Neighbourhood& neighbourhood) const
    {
        constexpr double k_least = 1e-3;  // unit: a triangle larger than the reach has weights as well
        const auto& [nearest, triangle] = binding;
        const Eigen::RowVector3i corners = rest_.triangles.row(triangle);
        const auto corner = [&](int k) { return Vec3(rest_.positions.row(corners[k])); };
        const std::array<double, 3> shares = barycentric(nearest, corner(0), corner(1), corner(2));
        Vec3 foot = Vec3::Zero(), sum = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            foot += shares[k] * worn_.row(corners[k]).transpose();
        Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
        double weights = 0;
        for (const int v : neighbourhood.around(nearest, corners, reach)) {
            const Vec3 at_rest = rest_.positions.row(v);
            const double weight
                = std::pow(std::max(1 - (at_rest - nearest).squaredNorm() / (reach * reach), k_least), 3);
            sum += weight * (worn_.row(v).transpose() + turns_[v] * (place - at_rest));
            turn += weight * turns_[v];
            weights += weight;
        }
        return { foot, sum / weights, turn / weights };
    }

    /// How much nearer to each vertex its binding is than what of the stand-in would take it elsewhere, m; k_doubted at
    /// most.
    std::vector<double> margins_of(const Positions& garment, const Positions& moved,
                                   const std::vector<Binding>& bindings) const
    {
        const NearestPoint tree(rest_.positions);
        std::vector<double> margins(garment.rows());
        parallel_for(garment.rows(), [&](Eigen::Index v) {
            const Vec3 place = garment.row(v), went = moved.row(v);
            const double own = (place - bindings[v].point).norm();
            double other = own + k_doubted;
            for (const int u : tree.within(place, other, k_most_doubted)) {
                const Vec3 from = place - rest_.positions.row(u).transpose(),
                           there = worn_.row(u).transpose() + turns_[u] * from;
                if ((there - went).norm() > k_apart)
                    other = std::min(other, from.norm());
            }
            margins[v] = std::max(0., other - own);
        });
        return margins;
    }

    /// The point of the stand-in nearest to a place, of those within reach of another point over its surface.
    Binding nearest_from(const Vec3& place, const Binding& from, double reach, Neighbourhood& neighbourhood) const
    {
        Binding best = from;
        double least = INFINITY;
        for (const int v : neighbourhood.around(from.point, rest_.triangles.row(from.triangle), reach))
            for (const int f : faces_at_[v]) {
                const Eigen::RowVector3i corners = rest_.triangles.row(f);
                const Corners x { place, rest_.positions.row(corners[0]), rest_.positions.row(corners[1]),
                                  rest_.positions.row(corners[2]) };
                if (const ClosestPoints at = closest_points(PairKind::vertex_face, x); at.distance < least) {
                    least = at.distance;
                    best = { place - separation(at.weights, x), f };
                }
            }
        return best;
    }

    /// Where a sleeve hangs on the trunk, some of its vertices are nearest to the stand-in's trunk. Each vertex keeps
    /// its own binding, or is bound beside a neighbour that is so much surer of its own. @return whether there are any
    bool bind_along_the_cloth(const Positions& rest, const MeshTopology& topology, const Positions& moved,
                              std::vector<Binding>& bindings) const
    {
        const std::vector<double> margins = margins_of(rest, moved, bindings);
        std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
        for (int v = 0; v < int(rest.rows()); ++v)
            steps.push({ k_way_to_surer * (k_doubted - margins[v]), v, v });
        std::vector<char> is_bound(rest.rows(), 0);
        bool is_changed = false;
        Neighbourhood neighbourhood(rest_.positions, topology_);
        while (!steps.empty()) {
            const auto [doubt, from, v] = steps.top();
            steps.pop();
            if (std::exchange(is_bound[v], 1))
                continue;
            if (from != v) {
                const double reach = (rest.row(from) - rest.row(v)).norm() + edge_;
                bindings[v] = nearest_from(rest.row(v), bindings[from], reach, neighbourhood);
                is_changed = true;
            }
            for (const int n : topology.neighbours(v))
                if (!is_bound[n])
                    steps.push({ doubt + (rest.row(v) - rest.row(n)).norm(), v, n });
        }
        return is_changed;
    }

    /// Of a padded trunk, what faces a sleeve that hangs beside it may plainly be nearest to the stand-in's sleeve:
    /// where cloth is led apart from most of the cloth round it, it goes with that.
    void mend_tears(const TriangleMesh& cloth, const MeshTopology& topology, double reach,
                    std::vector<Binding>& bindings, LedPlaces& places) const
    {
        const PatchedCloth patched(cloth, topology);
        for (int round = 0; round < k_tear_rounds; ++round) {
            const std::vector<char> is_off = patched.find_led_apart(places);
            const std::vector<int> bound = bind_beside(cloth.positions, topology, is_off, bindings);
            if (bound.empty())
                return;
            move(cloth.positions, bound, bindings, reach, places);
        }
    }

    /// Binds what is marked beside what is not, from its rim on. @return those that are bound elsewhere than before
    std::vector<int> bind_beside(const Positions& garment, const MeshTopology& topology,
                                 const std::vector<char>& is_off, std::vector<Binding>& bindings) const
    {
        std::vector<char> is_bound(is_off.size());
        std::vector<int> next, changed;
        for (int v = 0; v < int(is_off.size()); ++v)
            if (is_bound[v] = !is_off[v]; is_bound[v])
                next.push_back(v);
        Neighbourhood neighbourhood(rest_.positions, topology_);
        for (std::size_t i = 0; i < next.size(); ++i)
            for (const int n : topology.neighbours(next[i]))
                if (!std::exchange(is_bound[n], 1)) {
                    const Vec3 place = garment.row(n);
                    const double reach = (garment.row(next[i]) - place.transpose()).norm() + edge_;
                    const Binding beside = nearest_from(place, bindings[next[i]], reach, neighbourhood);
                    if (beside.point != bindings[n].point)
                        changed.push_back(n);
                    bindings[n] = beside;
                    next.push_back(n);
                }
        return changed;
    }

    const GarmentMesh& rest_;
    const Positions& worn_;
    const MeshTopology topology_;
    const std::vector<Eigen::Matrix3d> turns_;
    const TriangleTree sheet_;
    std::vector<std::vector<int>> faces_at_;  // by vertex
    const double edge_;  // m, mean
};

}  // namespace

LedPlaces lead_along(const GarmentMesh& stand_in, const Positions& worn, const TriangleMesh& garment,
                     const MeshTopology& topology)
{
    return Motion(stand_in, worn).apply(garment, topology);
}

}  // namespace garmentfit
