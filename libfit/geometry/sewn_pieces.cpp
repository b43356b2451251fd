// SPDX-License-Identifier: GPL-3.0-or-later
#include "sewn_pieces.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "barycentric.h"
#include "disjoint_sets.h"
#include "nearest.h"
#include "panel.h"
#include "parallel.h"
#include "segment.h"
#include "surface_measures.h"
#include "tuning.h"
#include "used_vertices.h"
#include "weld.h"

namespace garmentfit {
namespace {

// unit: vertices worth handing to another thread.
constexpr std::size_t k_grain = 64;

struct Piece {
    std::vector<int> vertices, triangles, border;  // border: vertices
    Eigen::AlignedBox3d box;
    double border_edge = 0;  // m, mean length
    int garment = 0;
    int euler_characteristic = 0;
    double thickness = 0;  // m, of a panel whose border is a rim; 0 for a single sheet
    double area = 0;  // m^2

    /// Whether it is a disc, through which no limb can pass: nothing of that kind and size is worn by itself.
    bool is_patch() const { return euler_characteristic == 1 && size() <= k_patch; }
    /// Whether cloth may pass through it.
    bool is_ring() const { return euler_characteristic <= 0; }
    /// Whether it hangs on what it touches, as drawstrings, ribbons and pulls of zips do: nobody wears it by itself.
    bool is_pendant() const
    {
        return !is_ring() && (size() <= k_largest_detail || area < k_strand_area * size() * size());
    }
    double size() const { return box.diagonal().norm(); }
};

/// A vertex and the nearest point of another piece.
struct Foot {
    double distance = INFINITY;
    bool on_border = false;  // of the other piece
    Tie tie = {};
};

/// The edges that are part of a piece's border: those of its open border, or of the rim of a panel with thickness.
bool is_border_of(const Piece& piece, const GarmentMesh& rest, const MeshTopology& topology, int edge)
{
    const auto sides = topology.sides_at(edge);
    if (piece.thickness == 0)
        return sides.size() == 1;
    return sides.size() != 2
        || area_vector(rest.positions, rest.triangles, sides[0] / 3)
               .stableNormalized()
               .dot(area_vector(rest.positions, rest.triangles, sides[1] / 3).stableNormalized())
        < k_rim_cosine;
}

/// m; 0 where a piece is open, or no panel.
double panel_thickness(const Piece& piece, const GarmentMesh& rest, bool is_open)
{
    if (is_open)
        return 0;
    double volume = 0, area = 0;
    const Vec3 origin = rest.positions.row(piece.vertices[0]);
    for (const int f : piece.triangles) {
        const Vec3 vector = area_vector(rest.positions, rest.triangles, f);
        area += vector.norm();
        volume += vector.dot(Vec3(rest.positions.row(rest.triangles(f, 0))) - origin) / 3;
    }
    const double thickness = area > 0 ? thickness_of(volume, area) : 0;
    return is_panel(thickness, area) ? thickness : 0;
}

/// The pieces from the largest to the smallest. Each is sewn to pieces before it.
std::vector<Piece> collect_pieces(const GarmentMesh& rest, const MeshTopology& topology,
                                  const std::vector<int>& garments)
{
    DisjointSets sets(int(rest.positions.rows()));
    for (const auto& corners : rest.triangles.rowwise())
        for (int k = 1; k < 3; ++k)
            sets.join(corners[0], corners[k]);
    std::map<int, int> row_of;  // by root
    std::vector<Piece> pieces;
    std::vector<char> is_listed(std::size_t(rest.positions.rows()), 0), is_on_border(is_listed);
    for (int f = 0; f < int(rest.triangles.rows()); ++f) {
        const auto [found, is_new] = row_of.try_emplace(sets.root(rest.triangles(f, 0)), int(pieces.size()));
        if (is_new)
            pieces.emplace_back();
        Piece& piece = pieces[found->second];
        piece.triangles.push_back(f);
        for (const int v : rest.triangles.row(f))
            if (!is_listed[v]) {
                is_listed[v] = 1;
                piece.vertices.push_back(v);
                piece.box.extend(Vec3(rest.positions.row(v)));
            }
    }
    for (Piece& piece : pieces)
        piece.euler_characteristic = int(piece.vertices.size() + piece.triangles.size());
    for (const int a : topology.edges().col(0))
        --pieces[row_of[sets.root(a)]].euler_characteristic;
    std::vector<char> is_open(pieces.size(), 0);
    for (const int edge : topology.border_edges())
        is_open[row_of[sets.root(topology.edges()(edge, 0))]] = 1;
    for (std::size_t p = 0; p < pieces.size(); ++p)
        pieces[p].thickness = panel_thickness(pieces[p], rest, is_open[p]);
    for (Piece& piece : pieces)
        for (const int f : piece.triangles)
            piece.area += area_vector(rest.positions, rest.triangles, f).norm();
    for (int edge = 0; edge < int(topology.edges().rows()); ++edge) {
        const int a = topology.edges()(edge, 0), b = topology.edges()(edge, 1);
        Piece& piece = pieces[row_of[sets.root(a)]];
        if (!is_border_of(piece, rest, topology, edge))
            continue;
        piece.border_edge += (rest.positions.row(a) - rest.positions.row(b)).norm();
        for (const int v : { a, b })
            if (!is_on_border[v]) {
                is_on_border[v] = 1;
                piece.border.push_back(v);
            }
    }
    for (Piece& piece : pieces) {
        piece.border_edge /= double(std::max<std::size_t>(1, piece.border.size()));
        piece.garment = garments.empty() ? 0 : garments[piece.vertices[0]];
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.size() > b.size(); });
    return pieces;
}

/// Finds where vertices of one piece lie on another.
class Feet {
public:
    Feet(const GarmentMesh& rest, const MeshTopology& topology, const std::vector<Piece>& pieces) :
        rest_(rest), topology_(topology), pieces_(pieces), trees_(pieces.size()),
        is_on_rim_(std::size_t(rest.positions.rows()), 0)
    {
        for (const Piece& piece : pieces)
            if (piece.thickness > 0)
                for (const int v : piece.border)
                    is_on_rim_[v] = 1;
    }

    /// Of each of these vertices, none further than `reach`.
    std::vector<Foot> find(const std::vector<int>& vertices, std::size_t on, double reach)
    {
        if (!trees_[on])
            trees_[on].emplace(surface_of(pieces_[on]));
        const TriangleTree& tree = *trees_[on];
        std::vector<Foot> feet(vertices.size());
        parallel_for<std::size_t>(
            vertices.size(),
            [&](std::size_t i) {
                const Vec3 place = rest_.positions.row(vertices[i]);
                if (pieces_[on].box.exteriorDistance(place) > reach)
                    return;
                if (const auto nearest = tree.nearest_triangle_within(place, reach))
                    feet[i] = foot_at(vertices[i], pieces_[on].triangles[nearest->triangle], nearest->point,
                                      (nearest->point - place).norm());
            },
            k_grain);
        return feet;
    }

private:
    Vec3 at(int v) const { return rest_.positions.row(v); }

    /// With its own vertices alone: there may be thousands of pieces.
    TriangleMesh surface_of(const Piece& piece) const
    {
        Triangles triangles = rest_.triangles(piece.triangles, Eigen::all);
        const std::vector<int> vertices = used_vertices(triangles);
        return { rest_.positions(vertices, Eigen::all), numbered_among(vertices, std::move(triangles)) };
    }

    Foot foot_at(int vertex, int triangle, const Vec3& point, double distance) const
    {
        const auto corners = rest_.triangles.row(triangle);
        return { distance,
                 is_near_border(vertex, triangle, distance),
                 { vertex,
                   { corners[0], corners[1], corners[2] },
                   barycentric(point, at(corners[0]), at(corners[1]), at(corners[2])) } };
    }

    /// Whether the nearest point of the surface is one of its border, too. A rim is as wide as its faces.
    bool is_near_border(int vertex, int triangle, double distance) const
    {
        constexpr double k_as_near = 1 + 1e-6;  // unit: rounding of two computations of one distance
        constexpr double k_rounding = 1e-9;  // m, unit: the same where the distance is 0
        const auto corners = rest_.triangles.row(triangle);
        if (std::any_of(corners.begin(), corners.end(), [&](int corner) { return is_on_rim_[corner]; }))
            return true;
        for (const int corner : corners)
            for (const int other : topology_.neighbours(corner))
                if (const int edge = topology_.edge_between(corner, other); topology_.is_border(edge)
                    && distance_to_segment(at(vertex), at(corner), at(other)) <= k_as_near * distance + k_rounding)
                    return true;
        return false;
    }

    const GarmentMesh& rest_;
    const MeshTopology& topology_;
    const std::vector<Piece>& pieces_;
    std::vector<std::optional<TriangleTree>> trees_;
    std::vector<char> is_on_rim_;  // of a panel with thickness
};

std::vector<Tie> ties_on_border(const std::vector<Foot>& feet)
{
    std::vector<Tie> ties;
    for (const Foot& foot : feet)
        if (foot.on_border) {
            ties.push_back(foot.tie);
            ties.back().is_seam = true;
        }
    return ties;
}

/// m, from a border to one that it is sewn to.
double seam_reach(double border_edge)
{
    return std::clamp(k_seam_edges * border_edge, k_seam_distance, k_lining_distance);
}

/// Marks what is within a few edges of a vertex. The same object serves many vertices.
class EdgesAround {
public:
    explicit EdgesAround(const MeshTopology& topology, std::size_t vertices) :
        topology_(topology), is_near_(vertices, 0)
    {
    }

    void look_at(int vertex)
    {
        for (const int v : near_)
            is_near_[v] = 0;
        near_ = { vertex };
        is_near_[vertex] = 1;
        std::size_t next = 0;
        for (int ring = 0; ring < k_own_seam_rings; ++ring)
            for (const std::size_t end = near_.size(); next < end; ++next)
                for (const int n : topology_.neighbours(near_[next]))
                    if (!std::exchange(is_near_[n], 1))
                        near_.push_back(n);
    }
    bool has(int vertex) const { return is_near_[vertex] != 0; }

private:
    const MeshTopology& topology_;
    std::vector<char> is_near_;
    std::vector<int> near_;
};

/// The direction from a border edge into the cloth.
Vec3 way_in(const GarmentMesh& rest, const MeshTopology& topology, int edge)
{
    const auto at = [&](int v) { return Vec3(rest.positions.row(v)); };
    const Vec3 low = at(topology.edges()(edge, 0)), along = (at(topology.edges()(edge, 1)) - low).stableNormalized(),
               middle = rest.positions(rest.triangles.row(topology.sides_at(edge)[0] / 3), Eigen::all).colwise().mean();
    const Vec3 in = middle - low;
    return (in - in.dot(along) * along).stableNormalized();
}

/// Whether cloth leaves a border vertex to the side to which it leaves an edge: sheets that lie on each other.
bool is_folded_back(const GarmentMesh& rest, const MeshTopology& topology, int vertex, int edge)
{
    const Vec3 there = way_in(rest, topology, edge);
    for (const int n : topology.neighbours(vertex))
        if (const int own = topology.edge_between(vertex, n);
            topology.is_border(own) && way_in(rest, topology, own).dot(there) > k_folded_back)
            return true;
    return false;
}

/// Of a border vertex to a point of another border edge of its piece.
Tie own_tie(const GarmentMesh& rest, const MeshTopology& topology, int vertex, int edge, const Vec3& point)
{
    const auto corners = rest.triangles.row(topology.sides_at(edge)[0] / 3);
    const auto at = [&](int k) { return Vec3(rest.positions.row(corners[k])); };
    return { vertex, { corners[0], corners[1], corners[2] }, barycentric(point, at(0), at(1), at(2)), true, true };
}

/// Ties along the seams of a piece with itself, as between front and back where the sleeves join them: borders that are
/// near to each other and far along the cloth. None where these are few.
std::vector<Tie> find_own_seams(const GarmentMesh& rest, const MeshTopology& topology, const Piece& piece,
                                EdgesAround& around)
{
    if (piece.thickness > 0 || piece.border.empty())
        return {};
    const double reach = seam_reach(piece.border_edge);
    const auto at = [&](int v) { return Vec3(rest.positions.row(v)); };
    const NearestPoint border(rest.positions(piece.border, Eigen::all));
    std::vector<Tie> ties;
    for (const int v : piece.border) {
        around.look_at(v);
        int best = -1;
        double least = reach;
        for (const int i : border.within(at(v), reach + 2 * piece.border_edge, k_own_seam_candidates)) {
            const int a = piece.border[i];
            for (const int b : topology.neighbours(a)) {
                const int edge = topology.edge_between(a, b);
                if (around.has(a) || around.has(b) || !topology.is_border(edge))
                    continue;
                if (const double distance = distance_to_segment(at(v), at(a), at(b)); distance <= least) {
                    least = distance;
                    best = edge;
                }
            }
        }
        if (best < 0 || is_folded_back(rest, topology, v, best))
            continue;
        const Vec3 foot = nearest_on_segment(at(v), at(topology.edges()(best, 0)), at(topology.edges()(best, 1)));
        ties.push_back(own_tie(rest, topology, v, best, foot));
    }
    return ties.size() < k_least_own_seam ? std::vector<Tie>() : ties;
}

/// The border edges within some steps along the border from one of its vertices.
std::vector<int> border_edges_around(const MeshTopology& topology, int vertex, int steps)
{
    std::vector<int> edges, reached { vertex };
    std::size_t next = 0;
    for (int step = 0; step < steps; ++step)
        for (const std::size_t end = reached.size(); next < end; ++next)
            for (const int n : topology.neighbours(reached[next])) {
                const int edge = topology.edge_between(reached[next], n);
                if (!topology.is_border(edge))
                    continue;
                if (std::find(edges.begin(), edges.end(), edge) == edges.end())
                    edges.push_back(edge);
                if (std::find(reached.begin(), reached.end(), n) == reached.end())
                    reached.push_back(n);
            }
    return edges;
}

/// Ties across holes without area, which would gape: one side of a seam has vertices there that the other lacks.
std::vector<Tie> find_t_junctions(const GarmentMesh& rest, const MeshTopology& topology, const Piece& piece)
{
    if (piece.thickness > 0)
        return {};
    const auto at = [&](int v) { return Vec3(rest.positions.row(v)); };
    std::vector<Tie> ties;
    for (const int v : piece.border) {
        std::optional<Tie> nearest;
        double least = INFINITY;
        for (const int edge : border_edges_around(topology, v, k_t_junction_steps)) {
            const Vec3 a = at(topology.edges()(edge, 0)), b = at(topology.edges()(edge, 1)),
                       foot = nearest_on_segment(at(v), a, b);
            const double distance = (foot - at(v)).norm();
            if (distance > k_t_junction * (b - a).norm() || distance >= least)
                continue;
            const Tie tie = own_tie(rest, topology, v, edge, foot);
            if (std::find(tie.corners.begin(), tie.corners.end(), v) != tie.corners.end()
                || is_folded_back(rest, topology, v, edge))
                continue;
            least = distance;
            nearest = tie;
        }
        if (nearest)
            ties.push_back(*nearest);
    }
    return ties;
}

/// Ties between two pieces, on both of their borders, where they are this near; none where they are on less than this
/// share of both.
std::vector<Tie> ties_within(Feet& feet, const std::vector<Piece>& pieces, std::size_t p, std::size_t q, double reach,
                             double share)
{
    std::vector<Tie> ties = ties_on_border(feet.find(pieces[p].border, q, reach));
    const std::vector<Tie> back = ties_on_border(feet.find(pieces[q].border, p, reach));
    const auto is_long = [share](std::size_t tied, const Piece& piece) {
        return double(tied) >= share * double(piece.border.size()) && tied > 0;
    };
    if (ties.size() + back.size() < k_least_seam
        || !(is_long(ties.size(), pieces[p]) || is_long(back.size(), pieces[q])))
        return {};
    ties.insert(ties.end(), back.begin(), back.end());
    return ties;
}

/// Ties along a seam between two pieces; none where there is no seam. A seam that gapes is known by its length.
std::vector<Tie> find_seam(Feet& feet, const std::vector<Piece>& pieces, std::size_t p, std::size_t q)
{
    const double edge = std::min(pieces[p].border_edge, pieces[q].border_edge);
    const double reach
        = std::max(seam_reach(edge), panel_seam_distance(std::min(pieces[p].thickness, pieces[q].thickness)));
    const double wide = std::min(k_gaping_edges * edge, k_gaping_distance);
    if (pieces[p].box.exteriorDistance(pieces[q].box) > std::max(reach, wide))
        return {};
    if (wide > reach)
        if (std::vector<Tie> ties = ties_within(feet, pieces, p, q, wide, k_gaping_share); !ties.empty())
            return ties;
    return ties_within(feet, pieces, p, q, reach, k_seam_share);
}

/// Of each vertex of a piece the nearest foot on larger pieces. Pieces that are nearest to few of the vertices are left
/// out: a button that reaches beyond its flap is sewn to the flap alone, a belt loop to belt and trousers.
std::vector<Foot> choose_feet(const std::vector<std::vector<Foot>>& on_pieces, std::size_t vertices)
{
    const auto nearest_piece = [&](std::size_t i, const std::vector<char>& is_left_out) {
        std::size_t best = on_pieces.size();
        for (std::size_t q = 0; q < on_pieces.size(); ++q)
            if (!is_left_out[q] && std::isfinite(on_pieces[q][i].distance)
                && (best == on_pieces.size() || on_pieces[q][i].distance < on_pieces[best][i].distance))
                best = q;
        return best;
    };
    std::vector<char> is_left_out(on_pieces.size(), 0);
    std::vector<std::size_t> count(on_pieces.size() + 1, 0);
    for (std::size_t i = 0; i < vertices; ++i)
        ++count[nearest_piece(i, is_left_out)];
    count.pop_back();  // of those that lie on none
    const std::size_t most = count.empty() ? 0 : *std::max_element(count.begin(), count.end());
    for (std::size_t q = 0; q < on_pieces.size(); ++q)
        is_left_out[q] = count[q] < most && double(count[q]) < k_holder_share * double(vertices);
    std::vector<Foot> feet(vertices);
    for (std::size_t i = 0; i < vertices; ++i)
        if (const std::size_t q = nearest_piece(i, is_left_out); q < on_pieces.size())
            feet[i] = on_pieces[q][i];
    return feet;
}

/// Ties of what lies on larger pieces with border or back; none where the piece is a layer.
/// @param feet       of each vertex of the piece, the nearest on a larger one
/// @param is_seamed  to a larger one: then the rest of its border is free, as a hood's is
std::vector<Tie> find_hold(const Piece& piece, const std::vector<Foot>& feet, const std::vector<char>& is_on_border,
                           bool is_seamed)
{
    const auto lies_within = [&](double reach, bool border_only) {
        std::vector<Tie> ties;
        for (std::size_t i = 0; i < feet.size(); ++i)
            if (feet[i].distance <= reach && (!border_only || is_on_border[piece.vertices[i]]))
                ties.push_back(feet[i].tie);
        return ties;
    };
    const bool is_small = piece.size() <= k_small_piece;
    const std::vector<Tie> back = lies_within(is_small ? k_small_piece_distance : k_lining_distance, false);
    if (double(back.size()) >= (is_small ? k_small_piece_share : k_lining_share) * double(feet.size()))
        return back;
    struct BorderRule {
        double distance, share;
        bool applies;
    };
    const BorderRule rules[]
        = { { std::max(k_seam_distance, k_border_edges * piece.border_edge), k_border_share, true },
            { k_along_distance, k_along_share, !is_seamed },
            { k_lining_distance, k_patch_share, !is_seamed && piece.is_patch() } };
    for (const BorderRule& rule : rules) {
        const std::vector<Tie> border = lies_within(rule.distance, true);
        if (rule.applies && !border.empty() && double(border.size()) >= rule.share * double(piece.border.size()))
            return border;
    }
    const std::vector<Tie> touching = lies_within(k_along_distance, false);
    return !is_seamed && piece.is_pendant() && touching.size() >= k_least_seam ? touching : std::vector<Tie>();
}

bool is_held_by_back(const std::vector<Tie>& hold, const Piece& piece)
{
    return double(hold.size()) >= k_small_piece_share * double(piece.vertices.size());
}

/// Neighbours of vertices across the seams that pieces have with themselves.
std::multimap<int, int> across_seams(const std::vector<Tie>& own_ties)
{
    std::multimap<int, int> across;
    for (const Tie& tie : own_ties)
        for (const int corner : tie.corners) {
            across.emplace(tie.vertex, corner);
            across.emplace(corner, tie.vertex);
        }
    return across;
}

/// The vertices of two parts of a piece that a ring or a buckle alone holds together, such as strap and bodice: it is
/// sewn to both, and round about it no way along the cloth leads from one to the other. None where it is no such link.
/// Buttons are none: fronts that they close lie on each other.
std::array<std::vector<int>, 2> find_linked(const GarmentMesh& rest, const MeshTopology& topology,
                                            const std::multimap<int, int>& across_seams, const Piece& piece,
                                            const std::vector<Tie>& hold, const std::vector<int>& piece_of)
{
    if (hold.empty() || !piece.is_ring())
        return {};
    const Vec3 margin = Vec3::Constant(k_largest_detail);
    const Eigen::AlignedBox3d around(piece.box.min() - margin, piece.box.max() + margin);
    const int holder = piece_of[hold[0].corners[0]];
    std::set<int> ends, reached;
    for (const Tie& tie : hold)
        if (piece_of[tie.corners[0]] == holder)
            ends.insert(tie.corners.begin(), tie.corners.end());
    std::deque<int> front { *ends.begin() };
    for (std::size_t ends_reached = 0; !front.empty() && ends_reached < ends.size(); front.pop_front()) {
        const int v = front.front();
        if (!reached.insert(v).second)
            continue;
        ends_reached += ends.count(v);
        for (const int n : topology.neighbours(v))
            if (ends.count(n) || around.contains(Vec3(rest.positions.row(n))))
                front.push_back(n);
        const auto [first, last] = across_seams.equal_range(v);
        for (auto at = first; at != last; ++at)
            front.push_back(at->second);
    }
    std::array<int, 2> ties {};
    for (const Tie& tie : hold)
        if (piece_of[tie.corners[0]] == holder)
            ++ties[reached.count(tie.corners[0])];
    if (std::min(ties[0], ties[1]) < k_holder_share * double(piece.vertices.size()))
        return {};
    std::array<std::vector<int>, 2> linked;
    for (const int v : ends)
        linked[reached.count(v)].push_back(v);
    return linked;
}

/// Collects ties; a vertex that a seam ties is not held besides.
class Sewing {
public:
    explicit Sewing(std::size_t pieces, Eigen::Index vertices) :
        seams_(int(pieces)), is_held_(pieces, 0), is_in_seam_(std::size_t(vertices), 0)
    {
    }

    void add_seam(std::size_t p, std::size_t q, const std::vector<Tie>& ties)
    {
        if (ties.empty())
            return;
        seams_.join(int(p), int(q));
        for (const Tie& tie : ties)
            is_in_seam_[tie.vertex] = 1;
        ties_.insert(ties_.end(), ties.begin(), ties.end());
    }
    void add_hold(std::size_t p, const std::vector<Tie>& ties)
    {
        for (const Tie& tie : ties)
            if (!is_in_seam_[tie.vertex]) {
                is_held_[p] = 1;
                ties_.push_back(tie);
            }
    }

    const std::vector<Tie>& ties() const { return ties_; }

    SewnPieces take() &&
    {
        const int count = int(is_held_.size());
        std::vector<char> is_group(count, 0), is_group_held(count, 0);
        for (int p = 0; p < count; ++p) {
            is_group[seams_.root(p)] = 1;
            is_group_held[seams_.root(p)] |= is_held_[p];
        }
        const int groups = int(std::count(is_group.begin(), is_group.end(), 1)),
                  held = std::min(groups - 1, int(std::count(is_group_held.begin(), is_group_held.end(), 1)));
        return { std::move(ties_), { count, count - groups, held, groups - 1 - held } };
    }

private:
    DisjointSets seams_;
    std::vector<char> is_held_, is_in_seam_;
    std::vector<Tie> ties_;
};

}  // namespace

SewnPieces find_sewn_pieces(const GarmentMesh& rest, const MeshTopology& topology, const std::vector<int>& garments)
{
    const std::vector<Piece> pieces = collect_pieces(rest, topology, garments);
    Sewing sewing(pieces.size(), rest.positions.rows());
    EdgesAround around(topology, std::size_t(rest.positions.rows()));
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        sewing.add_seam(p, p, find_own_seams(rest, topology, pieces[p], around));
        sewing.add_seam(p, p, find_t_junctions(rest, topology, pieces[p]));
    }
    const bool has_rings = std::any_of(pieces.begin(), pieces.end(), [](const Piece& piece) {
        return piece.is_ring() && piece.size() <= k_largest_detail;
    });
    const std::multimap<int, int> across = has_rings ? across_seams(sewing.ties()) : std::multimap<int, int>();
    std::vector<char> is_on_border(std::size_t(rest.positions.rows()), 0);
    std::vector<int> piece_of(std::size_t(rest.positions.rows()), -1);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        for (const int v : pieces[p].border)
            is_on_border[v] = 1;
        for (const int v : pieces[p].vertices)
            piece_of[v] = int(p);
    }
    Feet feet(rest, topology, pieces);
    std::vector<SewnDetail> details;
    for (std::size_t p = 1; p < pieces.size(); ++p) {
        const double reach = pieces[p].size() <= k_small_piece ? k_small_piece_distance : k_lining_distance;
        std::vector<std::vector<Foot>> on_pieces;
        bool is_seamed = false;
        for (std::size_t q = 0; q < p; ++q) {
            if (pieces[p].garment != pieces[q].garment || pieces[p].box.exteriorDistance(pieces[q].box) > reach)
                continue;
            const std::vector<Tie> seam = find_seam(feet, pieces, p, q);
            is_seamed |= !seam.empty();
            sewing.add_seam(p, q, seam);
            on_pieces.push_back(feet.find(pieces[p].vertices, q, reach));
        }
        const std::vector<Tie> hold
            = find_hold(pieces[p], choose_feet(on_pieces, pieces[p].vertices.size()), is_on_border, is_seamed);
        sewing.add_hold(p, hold);
        if (pieces[p].size() <= k_largest_detail && (is_seamed || is_held_by_back(hold, pieces[p])))
            details.push_back({ pieces[p].vertices, find_linked(rest, topology, across, pieces[p], hold, piece_of) });
    }
    SewnPieces result = std::move(sewing).take();
    result.details = std::move(details);
    return result;
}

double longest_piece_shift(const GarmentMesh& garment, const Positions& positions)
{
    const Weld weld(garment);
    const GarmentMesh rest = weld.gather(garment);
    const MeshTopology topology(rest.triangles, int(rest.positions.rows()));
    const std::vector<Piece> pieces = collect_pieces(rest, topology, {});
    if (pieces.size() < 2)
        return 0;
    const Positions now = weld.gather(positions);
    const auto further = [&](const Foot& foot) {
        Eigen::RowVector3d there = now.row(foot.tie.vertex);
        for (int k = 0; k < 3; ++k)
            there -= foot.tie.weights[k] * now.row(foot.tie.corners[k]);
        return std::max(0.0, there.norm() - foot.distance);
    };
    Feet feet(rest, topology, pieces);
    // Of a piece's vertices beside larger pieces the one that kept its distance best; some that went no further than
    // `enough` does, for the piece moved no further than others then.
    const auto least_shift = [&](std::size_t p, double enough) {
        constexpr std::size_t k_block = 1024;  // unit: of work between two looks at what is found
        const std::vector<int>& vertices = pieces[p].vertices;
        double least = INFINITY;
        for (std::size_t q = 0; q < p; ++q)
            if (pieces[p].box.exteriorDistance(pieces[q].box) <= k_beside)
                for (std::size_t first = 0; first < vertices.size() && least > enough; first += k_block) {
                    const auto from = vertices.begin() + std::ptrdiff_t(first),
                               to = from + std::ptrdiff_t(std::min(k_block, vertices.size() - first));
                    for (const Foot& foot : feet.find({ from, to }, q, k_beside))
                        if (std::isfinite(foot.distance))
                            least = std::min(least, further(foot));
                }
        return least;
    };
    double longest = 0;
    for (std::size_t p = 1; p < pieces.size(); ++p)
        if (const double least = least_shift(p, longest); std::isfinite(least))
            longest = std::max(longest, least);
    return longest;
}

PieceCounts count_pieces_held(const GarmentMesh& garment)
{
    const GarmentMesh rest = Weld(garment).gather(garment);
    return find_sewn_pieces(rest, { rest.triangles, int(rest.positions.rows()) }).counts;
}

}  // namespace garmentfit
