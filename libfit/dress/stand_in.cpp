// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/stand_in.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/SVD>

#include "barycentric.h"
#include "crowding.h"
#include "disjoint_sets.h"
#include "exact_crossings.h"
#include "given_crossings.h"
#include "nearest.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "remeshed_cloth.h"
#include "topology.h"
#include "tuning.h"
#include "untangle.h"
#include "weld.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

constexpr double k_inside = 0.5;  // derived: around a closed surface winding numbers are 0 or 1

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

/// Where the vertices of a garment are, seen from its stand-in.
struct Places {
    Positions feet;  ///< on the stand-in
    Positions offsets;  ///< from there
};

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

/// Whether an edge between two vertices grows far longer than cloth does.
bool is_torn(const Positions& rest, const Positions& worn, int a, int b)
{
    return (worn.row(a) - worn.row(b)).norm() > k_torn * (rest.row(a) - rest.row(b)).norm() + k_torn_gap;
}

/// Where a stand-in is, and how it takes along what is near it.
class Motion {
public:
    Motion(const GarmentMesh& stand_in, const Positions& worn) :
        rest_(stand_in), worn_(worn), topology_(stand_in.triangles, int(stand_in.positions.rows())),
        turns_(rotations(stand_in, worn)), sheet_({ stand_in.positions, stand_in.triangles }),
        edge_(mean_edge_length(stand_in.positions, topology_.edges()))
    {
    }

    Places apply(const Positions& garment, const MeshTopology& topology) const
    {
        std::vector<Binding> bindings(garment.rows());
        parallel_for(garment.rows(), [&](Eigen::Index v) { bindings[v] = *sheet_.nearest_triangle(garment.row(v)); });
        const double reach = reach_for(garment, bindings);
        Places places = move(garment, bindings, reach);
        if (bind_as_neighbours(garment, topology, places.feet + places.offsets, bindings))
            places = move(garment, bindings, reach);
        return places;
    }

private:
    using Binding = TriangleTree::Nearest;  // where a vertex hangs on the stand-in

    /// How far from the nearest point of the stand-in the motions are blended, m. A garment that is the stand-in's own
    /// surface keeps the stand-in's folds; sheets that lie beside it, and each other, have to move alike.
    double reach_for(const Positions& garment, const std::vector<Binding>& bindings) const
    {
        double off = 0;
        for (Eigen::Index v = 0; v < garment.rows(); ++v)
            off += (bindings[v].point - garment.row(v).transpose()).norm() / double(garment.rows());
        return (off < k_same_surface * edge_ ? k_own_reach : k_following_reach) * edge_;
    }

    Places move(const Positions& garment, const std::vector<Binding>& bindings, double reach) const
    {
        constexpr Eigen::Index k_grain = 1024;  // unit: of the parallel loop; each piece has its own Neighbourhood
        Places places { Positions::Zero(garment.rows(), 3), Positions::Zero(garment.rows(), 3) };
        parallel_for((garment.rows() + k_grain - 1) / k_grain, [&](Eigen::Index piece) {
            Neighbourhood neighbourhood(rest_.positions, topology_);
            for (Eigen::Index v = piece * k_grain; v < std::min((piece + 1) * k_grain, garment.rows()); ++v) {
                const auto [foot, target] = move(garment.row(v), bindings[v], reach, neighbourhood);
                places.feet.row(v) = foot;
                places.offsets.row(v) = target - foot;
            }
        });
        return places;
    }

    /// Where the nearest point of the stand-in goes, and the place itself. What lies side by side is moved alike,
    /// whichever triangles are nearest to it: the motions of all vertices near by are blended.
    std::pair<Vec3, Vec3> move(const Vec3& place, const Binding& binding, double reach,
                               Neighbourhood& neighbourhood) const
    {
        constexpr double k_least = 1e-3;  // unit: a triangle larger than the reach has weights as well
        const auto& [nearest, triangle] = binding;
        const Eigen::RowVector3i corners = rest_.triangles.row(triangle);
        const auto corner = [&](int k) { return Vec3(rest_.positions.row(corners[k])); };
        const std::array<double, 3> shares = barycentric(nearest, corner(0), corner(1), corner(2));
        Vec3 foot = Vec3::Zero(), sum = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            foot += shares[k] * worn_.row(corners[k]).transpose();
        double weights = 0;
        for (const int v : neighbourhood.around(nearest, corners, reach)) {
            const Vec3 at_rest = rest_.positions.row(v);
            const double weight
                = std::pow(std::max(1 - (at_rest - nearest).squaredNorm() / (reach * reach), k_least), 3);
            sum += weight * (worn_.row(v).transpose() + turns_[v] * (place - at_rest));
            weights += weight;
        }
        return { foot, sum / weights };
    }

    /// Where a sleeve hangs beside the trunk, some of its vertices are nearest to the stand-in's trunk and are torn off:
    /// islands between edges that grow far longer. They go with their neighbours. @return whether there are any
    static bool bind_as_neighbours(const Positions& rest, const MeshTopology& topology, const Positions& moved,
                                   std::vector<Binding>& bindings)
    {
        const int count = int(rest.rows());
        DisjointSets pieces(count), whole(count);
        for (const auto& edge : topology.edges().rowwise()) {
            pieces.join(edge[0], edge[1]);
            if (!is_torn(rest, moved, edge[0], edge[1]))
                whole.join(edge[0], edge[1]);
        }
        std::vector<int> size(count, 0), largest(count, -1);  // by the root: of what is whole; and of each piece
        for (int v = 0; v < count; ++v)
            ++size[whole.root(v)];
        for (int v = 0; v < count; ++v)
            if (int& best = largest[pieces.root(v)]; best < 0 || size[whole.root(v)] > size[best])
                best = whole.root(v);
        std::vector<char> is_bound(count);
        std::vector<int> bound;
        for (int v = 0; v < count; ++v) {
            is_bound[v] = size[whole.root(v)] > k_largest_island * size[largest[pieces.root(v)]];
            if (is_bound[v])
                bound.push_back(v);
        }
        const bool has_islands = int(bound.size()) < count;
        for (std::size_t next = 0; next < bound.size(); ++next)
            for (const int n : topology.neighbours(bound[next]))
                if (!std::exchange(is_bound[n], 1)) {
                    bindings[n] = bindings[bound[next]];
                    bound.push_back(n);
                }
        return has_islands;
    }

    const GarmentMesh& rest_;
    const Positions& worn_;
    const MeshTopology topology_;
    const std::vector<Eigen::Matrix3d> turns_;
    const TriangleTree sheet_;
    const double edge_;  // m, mean
};

/// The garment that follows. Only vertices at exactly the same place are one: parts that touch stay as they are.
struct Parts {
    Weld weld;
    GarmentMesh rest;
    MeshTopology topology;

    explicit Parts(const GarmentMesh& garment) :
        weld(garment), rest(weld.gather(garment)), topology(rest.triangles, int(rest.positions.rows()))
    {
    }
};

/// The marked vertices and their neighbours.
std::vector<int> with_neighbours(const MeshTopology& topology, const std::vector<char>& is_marked)
{
    std::vector<int> result;
    for (int v = 0; v < int(is_marked.size()); ++v) {
        const auto& neighbours = topology.neighbours(v);
        if (is_marked[v] || std::any_of(neighbours.begin(), neighbours.end(), [&](int n) { return is_marked[n]; }))
            result.push_back(v);
    }
    return result;
}

/// Marks vertices of the cloth that lie in the body, or whose edges or triangles meet something.
void mark_meeting(const Parts& cloth, const Positions& positions, const Surroundings& around, std::vector<char>& marks)
{
    const TriangleMesh moved { positions, cloth.rest.triangles };
    const WindingNumber winding(around.body);
    parallel_for(positions.rows(), [&](Eigen::Index v) { marks[v] |= winding(positions.row(v)) > k_inside; });
    std::vector<TriangleMesh> others = around.clothes;
    others.push_back(around.body);
    for (const TriangleMesh& other : others) {
        for (const auto& [edge, triangle] : find_crossings(moved, cloth.topology.edges(), TriangleTree(other)))
            for (const int v : cloth.topology.edges().row(edge))
                marks[v] = 1;
        for (const auto& [edge, triangle] : find_crossings(other, edges_of(other.triangles), TriangleTree(moved)))
            for (const int v : moved.triangles.row(triangle))
                marks[v] = 1;
    }
}

/// Marks vertices of parts of the cloth that meet each other though they lay apart at rest: in folds of the stand-in,
/// whose sides are nearer to each other than the parts are thick.
void mark_folds(const Parts& cloth, const Positions& positions, std::vector<char>& marks)
{
    const TriangleMesh rest { cloth.rest.positions, cloth.rest.triangles }, moved { positions, cloth.rest.triangles };
    const Edges& edges = cloth.topology.edges();
    const double apart = k_lying_apart * mean_edge_length(rest.positions, edges);
    for (const Crossing& crossing : find_self_crossings(moved, edges, TriangleTree(moved)))
        if (offset_at_rest(rest, edges, positions, crossing).norm() > apart) {
            for (const int v : edges.row(crossing.first))
                marks[v] = 1;
            for (const int v : moved.triangles.row(crossing.second))
                marks[v] = 1;
        }
}

/// Cloth on its way in towards its stand-in.
struct Drawn {
    Positions positions;
    Eigen::VectorXd share;  ///< of the way out from the stand-in, by vertex
};

/// Draws the marked vertices and their neighbours in by a half. @return whether there are any
bool draw_half(const Parts& cloth, const Places& places, const std::vector<char>& marks, Drawn& now)
{
    const std::vector<int> drawn = with_neighbours(cloth.topology, marks);
    for (const int v : drawn)
        now.positions.row(v) = places.feet.row(v) + (now.share[v] /= 2) * places.offsets.row(v);
    return !drawn.empty();
}

/// Draws what meets something in towards the stand-in. Sides of a fold as well, as far as that leaves fewer of them:
/// where a stand-in lies in many folds, what is drawn into one meets more of the others.
Positions draw_in(const Parts& cloth, const Places& places, const Surroundings& around)
{
    Drawn now { places.feet + places.offsets, Eigen::VectorXd::Ones(places.feet.rows()) }, best = now;
    std::ptrdiff_t fewest = std::numeric_limits<std::ptrdiff_t>::max();
    for (int round = 0;; ++round) {
        std::vector<char> marks(now.share.size(), 0);
        mark_folds(cloth, now.positions, marks);
        if (const auto in_folds = std::count(marks.begin(), marks.end(), 1); in_folds <= fewest) {
            fewest = in_folds;
            best = now;
        }
        if (round == k_drawing_rounds)
            break;
        mark_meeting(cloth, now.positions, around, marks);
        if (!draw_half(cloth, places, marks, now))
            return now.positions;
    }
    for (int round = 0; round < k_drawing_rounds; ++round) {
        std::vector<char> marks(best.share.size(), 0);
        mark_meeting(cloth, best.positions, around, marks);
        if (!draw_half(cloth, places, marks, best))
            break;
    }
    return best.positions;
}

/// Parts the cloth as far as needed for no more than `enough` crossings, in eighths, quarters and halves of the way to
/// where that many are left.
Positions parted_to(const TriangleMesh& cloth, const Edges& edges, std::size_t enough)
{
    const auto count = [&](const Positions& positions) {
        const TriangleMesh moved { positions, cloth.triangles };
        return find_self_crossings(moved, edges, TriangleTree(moved)).size();
    };
    const Positions motion = reduce_crossings(cloth, edges, enough) - cloth.positions;
    if (motion.isZero(0))
        return cloth.positions;
    for (double share = k_least_parting; share < 1; share *= 2)
        if (Positions part = cloth.positions + share * motion; count(part) <= enough)
            return part;
    return cloth.positions + motion;
}

/// The rotation that takes a triangle from rest to where it is; an error of its strain.
Eigen::Matrix3d rotation_of(const Eigen::RowVector3i& corners, const Positions& rest, const Positions& positions)
{
    const auto frame = [&corners](const Positions& x) {
        const Vec3 along = (x.row(corners[1]) - x.row(corners[0])).transpose(),
                   normal = along.cross(Vec3(x.row(corners[2]) - x.row(corners[0])));
        Eigen::Matrix3d axes;
        axes << along.stableNormalized(), normal.stableNormalized(), along.cross(normal).stableNormalized();
        return axes;
    };
    return frame(positions) * frame(rest).transpose();
}

/// From one place of the cloth that meets nothing towards another, as far as it meets nothing there: where it would,
/// vertices stay.
Positions moved_clear(const Parts& cloth, const Positions& from, Positions to, const Surroundings& around)
{
    for (int round = 0; round < k_drawing_rounds; ++round) {
        std::vector<char> marks(from.rows(), 0);
        mark_meeting(cloth, to, around, marks);
        const std::vector<int> meeting = with_neighbours(cloth.topology, marks);
        if (meeting.empty())
            return to;
        to(meeting, Eigen::all) = from(meeting, Eigen::all);
    }
    return from;
}

/// How to move apart what meets and did not as given, by a step in the direction in which it lay from each other at rest;
/// cloth beside it goes half as far.
Positions towards_gaps_of_rest(const Parts& cloth, const std::vector<Crossing>& fresh, const Positions& positions,
                               double step)
{
    const TriangleMesh rest { cloth.rest.positions, cloth.rest.triangles };
    const Edges& edges = cloth.topology.edges();
    Positions motion = Positions::Zero(positions.rows(), 3);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(positions.rows());
    const auto push = [&](int v, const Vec3& by) {
        motion.row(v) += by;
        count[v] += 1;
    };
    for (const Crossing& crossing : fresh) {
        const Eigen::RowVector3i corners = rest.triangles.row(crossing.second);
        const Vec3 apart = offset_at_rest(rest, edges, positions, crossing).stableNormalized(),
                   by = step * (rotation_of(corners, rest.positions, positions) * apart);
        for (const int v : edges.row(crossing.first))
            push(v, by);
        for (const int v : corners)
            push(v, -by);
    }
    motion.array().colwise() /= count.array().max(1);
    Positions beside = Positions::Zero(positions.rows(), 3);
    add_neighbours(edges, motion, beside);
    for (int v = 0; v < int(positions.rows()); ++v)
        if (count[v] == 0)
            motion.row(v) = beside.row(v) / std::max<double>(1, double(cloth.topology.neighbours(v).size())) / 2;
    return motion;
}

/// Gives what meets and did not as given, where that is little, the gaps that it had at rest. Where a fold has no room
/// for them, sheets are pushed to and fro: then it begins again where the fewest met, with half the step.
Positions with_gaps_of_rest(const Parts& cloth, const GivenCrossings& given, Positions positions,
                            const Surroundings& around)
{
    const Edges& edges = cloth.topology.edges();
    double step = k_gap_step * mean_edge_length(cloth.rest.positions, edges);
    Positions best = positions;
    std::size_t fewest = k_few_crossings + 1;
    int futile = 0;
    for (int round = 0; round < k_gap_rounds; ++round) {
        const TriangleMesh moved { positions, cloth.rest.triangles };
        const auto fresh = given.compare(positions, find_self_crossings(moved, edges, TriangleTree(moved))).fresh;
        if (fresh.size() < fewest) {
            fewest = fresh.size();
            best = positions;
            futile = 0;
        } else if (++futile == k_futile_gap_rounds) {
            positions = best;
            step /= 2;
            futile = 0;
            continue;
        }
        if (fresh.empty() || fresh.size() > k_few_crossings)
            break;
        const Positions motion = towards_gaps_of_rest(cloth, fresh, positions, step);
        positions = moved_clear(cloth, positions, positions + motion, around);
    }
    return best;
}

/// Untangles cloth with few crossings, but where that would make it meet something. Thousands of crossings are sheets
/// that lie on each other and do not come apart: of these, it leaves some fewer than were given.
Positions untangled(const Parts& cloth, const Positions& positions, const Surroundings& around)
{
    const TriangleMesh rest { cloth.rest.positions, cloth.rest.triangles }, moved { positions, cloth.rest.triangles };
    const Edges& edges = cloth.topology.edges();
    const std::vector<Crossing> given = find_self_crossings(rest, edges, TriangleTree(rest));
    Positions parted = given.size() <= k_few_crossings
        ? untangle(moved, edges).positions
        : parted_to(moved, edges, std::size_t(k_fewer_crossings * double(given.size())));
    return with_gaps_of_rest(cloth, GivenCrossings(rest, edges, given),
                             moved_clear(cloth, positions, std::move(parted), around), around);
}

std::size_t count_self_crossings(const TriangleMesh& cloth)
{
    return find_self_crossings(cloth, edges_of(cloth.triangles), TriangleTree(cloth)).size();
}

/// The same cloth with fewer vertices. None where it has few, or where it, or the coarser one, crosses itself: what
/// follows would cross at new places.
std::optional<GarmentMesh> coarser(const GarmentMesh& garment)
{
    if (garment.positions.rows() < k_fine)
        return {};
    const GarmentMesh sewn = Weld(garment).gather(garment);
    const TriangleMesh cloth { sewn.positions, sewn.triangles };
    if (cloth.positions.rows() < k_fine || count_self_crossings(cloth) > 0)
        return {};
    const std::optional<TriangleMesh> coarse = remeshed_cloth(cloth, k_coarse);
    if (!coarse || count_self_crossings(*coarse) > 0)
        return {};
    return GarmentMesh { coarse->positions, coarse->triangles };
}

}  // namespace

std::optional<GarmentMesh> make_stand_in(const GarmentMesh& garment)
{
    if (auto lining = lining_of(garment, crowding(garment) < k_crowded ? Lined::clothes_in_parts : Lined::all))
        return lining;
    return coarser(garment);
}

Positions follow(const GarmentMesh& stand_in, const Positions& worn, const GarmentMesh& garment,
                 const Surroundings& around)
{
    const Parts cloth(garment);
    const Positions drawn = draw_in(cloth, Motion(stand_in, worn).apply(cloth.rest.positions, cloth.topology), around);
    return cloth.weld.place(untangled(cloth, drawn, around));
}

}  // namespace garmentfit
