// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "buckets.h"
#include "disjoint_sets.h"
#include "parallel.h"
#include "sewn_pieces.h"
#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr double k_no_length = 1e-300;  // m, unit: avoids 0 / 0

using Ring = std::vector<std::pair<int, int>>;  // edges of an opening

/// Open edges, directed as in their triangles: the cloth lies to their left, seen from outside.
Ring border_edges(const TriangleMesh& mesh)
{
    const auto from = [&](int e) { return mesh.triangles(e / 3, e % 3); };
    const auto to = [&](int e) { return mesh.triangles(e / 3, (e % 3 + 1) % 3); };
    std::vector<int> first(3 * mesh.triangles.rows());
    for (int e = 0; e < int(first.size()); ++e)
        first[e] = from(e);
    const Buckets edges_from(int(mesh.positions.rows()), first);
    std::vector<char> is_border(first.size());
    parallel_for<int>(
        int(first.size()),
        [&](int e) {
            const auto back = edges_from[to(e)];
            is_border[e] = std::none_of(back.begin(), back.end(), [&](int other) { return to(other) == from(e); });
        },
        4096);  // unit: grain of the parallel loop
    Ring border;
    for (int e = 0; e < int(first.size()); ++e)
        if (is_border[e])
            border.emplace_back(from(e), to(e));
    return border;
}

/// Connected edges, in the order of their first edges.
std::vector<Ring> rings_of(const Ring& border, int vertices)
{
    DisjointSets joined(vertices);
    for (const auto& [a, b] : border)
        joined.join(a, b);
    std::vector<int> ring_at(vertices, -1);
    std::vector<Ring> rings;
    for (const auto& edge : border) {
        int& ring = ring_at[joined.root(edge.first)];
        if (ring < 0) {
            ring = int(rings.size());
            rings.emplace_back();
        }
        rings[ring].push_back(edge);
    }
    return rings;
}

Opening opening_of(const Positions& positions, const Ring& ring)
{
    const auto at = [&](int v) { return Vec3(positions.row(v)); };
    Opening opening;
    std::vector<int> rim, next;
    Vec3 area = Vec3::Zero();
    for (const auto& [a, b] : ring) {
        const double length = (at(b) - at(a)).norm();
        opening.girth += length;
        opening.centre += length * 0.5 * (at(a) + at(b));
        rim.push_back(a);
        next.push_back(b);
    }
    opening.rim = positions(rim, Eigen::all);
    opening.rim_next = positions(next, Eigen::all);
    opening.centre /= std::max(opening.girth, k_no_length);
    for (const auto& [a, b] : ring)  // the closing disc has the opposite direction of the cloth's edges
        area += 0.5 * (at(b) - opening.centre).cross(at(a) - opening.centre);
    if (area.norm() > 0)
        opening.facing = area.normalized();
    opening.roundness = 4 * std::numbers::pi * area.norm() / std::pow(std::max(opening.girth, k_no_length), 2);
    return opening;
}

std::vector<Ring> keep_large(const Positions& positions, std::vector<Ring> rings, double smallest)
{
    const auto length = [&](const auto& ring) {
        double sum = 0;
        for (const auto& [a, b] : ring)
            sum += (positions.row(b) - positions.row(a)).norm();
        return sum;
    };
    std::erase_if(rings, [&](const auto& ring) { return length(ring) < smallest; });
    return rings;
}

/// The cloth as a graph of vertices and edge lengths.
class EdgeGraph {
public:
    explicit EdgeGraph(const TriangleMesh& mesh) :
        mesh_(mesh), edges_at_(int(mesh.positions.rows()), corners(mesh.triangles))
    {
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k)
                lengths_.push_back(
                    (mesh.positions.row(mesh.triangles(f, k)) - mesh.positions.row(mesh.triangles(f, (k + 1) % 3)))
                        .norm());
        longest_edge_ = lengths_.empty() ? 0 : *std::max_element(lengths_.begin(), lengths_.end());
    }

    /// Dijkstra distances along edges, m. The search ends beyond the nearest of the other openings: vertices farther
    /// away than all corners of the faces there have distance infinity.
    std::vector<double> distances_from(const Ring& ring, const std::vector<char>& is_other) const
    {
        std::vector<double> distance(mesh_.positions.rows(), std::numeric_limits<double>::infinity());
        std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
        const auto reach = [&](int v, double d) {
            if (d < distance[v]) {
                distance[v] = d;
                queue.emplace(d, v);
            }
        };
        for (const auto& [a, b] : ring)
            reach(a, 0);
        double last = std::numeric_limits<double>::infinity();
        while (!queue.empty() && queue.top().first <= last) {
            const auto [d, v] = queue.top();
            queue.pop();
            if (d > distance[v])
                continue;
            if (is_other[v])
                last = std::min(last, d + 2 * longest_edge_);  // derived: bounds the other corners of a face
            for (const int corner : edges_at_[v]) {
                const int f = corner / 3, k = corner % 3;
                reach(mesh_.triangles(f, (k + 1) % 3), d + lengths_[corner]);
                reach(mesh_.triangles(f, (k + 2) % 3), d + lengths_[3 * f + (k + 2) % 3]);
            }
        }
        return distance;
    }

private:
    static std::vector<int> corners(const Triangles& triangles)
    {
        std::vector<int> result;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            result.insert(result.end(), { triangles(f, 0), triangles(f, 1), triangles(f, 2) });
        return result;
    }

    const TriangleMesh& mesh_;
    Buckets edges_at_;  // half-edges 3 f + k that begin at each vertex
    std::vector<double> lengths_;  // m, of each half-edge
    double longest_edge_ = 0;  // m
};

/// The part of a tube between two distances from its opening.
struct Slice {
    double girth = 0;  // m
    Vec3 middle = Vec3::Zero();
};

/// A triangle of the cloth, along the distance of its corners from an opening.
class Graded {
public:
    /// @param distances  of the corners, finite
    Graded(const TriangleMesh& mesh, Eigen::Index face, const std::vector<double>& distances)
    {
        std::array<int, 3> corners { mesh.triangles(face, 0), mesh.triangles(face, 1), mesh.triangles(face, 2) };
        std::sort(corners.begin(), corners.end(), [&](int a, int b) { return distances[a] < distances[b]; });
        for (int k = 0; k < 3; ++k) {
            at_[k] = mesh.positions.row(corners[k]);
            distance_[k] = distances[corners[k]];
        }
        area_ = 0.5 * (at_[1] - at_[0]).cross(at_[2] - at_[0]).norm();
    }

    double first() const { return distance_[0]; }
    double last() const { return distance_[2]; }

    /// m^2, of what is nearer to the opening
    double area_below(double distance) const
    {
        const auto [low, middle, high] = distance_;
        if (distance <= low)
            return 0;
        if (distance >= high)
            return area_;
        return distance < middle
            ? area_ * (distance - low) * (distance - low) / ((middle - low) * (high - low))
            : area_ * (1 - (high - distance) * (high - distance) / ((high - middle) * (high - low)));
    }

    /// The middle of what lies at a distance from the opening.
    Vec3 middle(double distance) const
    {
        const int side = distance < distance_[1] ? 0 : 1;
        return 0.5 * (along(0, 2, distance) + along(side, side + 1, distance));
    }

private:
    Vec3 along(int from, int to, double distance) const
    {
        const double length = distance_[to] - distance_[from];
        const double share = length > 0 ? std::clamp((distance - distance_[from]) / length, 0.0, 1.0) : 0.5;
        return at_[from] + share * (at_[to] - at_[from]);
    }

    std::array<Vec3, 3> at_;
    std::array<double, 3> distance_ {};  // m, rising
    double area_;  // m^2
};

/// derived: the area between two distances from the opening is the girth times their difference. Of triangles longer
/// than a slice each has its part.
std::vector<Slice> slices_along(const TriangleMesh& mesh, const std::vector<double>& distance, double width)
{
    std::vector<Slice> slices(1);
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        if (!std::all_of(mesh.triangles.row(f).begin(), mesh.triangles.row(f).end(),
                         [&](int v) { return std::isfinite(distance[v]); }))
            continue;
        const Graded triangle(mesh, f, distance);
        const auto first = std::size_t(triangle.first() / width), last = std::size_t(triangle.last() / width);
        if (last >= slices.size())
            slices.resize(last + 1);
        for (std::size_t bin = first; bin <= last; ++bin) {
            const double from = std::max(triangle.first(), double(bin) * width),
                         to = std::min(triangle.last(), double(bin + 1) * width);
            const double girth = (triangle.area_below(to) - triangle.area_below(from)) / width;
            slices[bin].girth += girth;
            slices[bin].middle += girth * triangle.middle(0.5 * (from + to));
        }
    }
    for (Slice& slice : slices)
        slice.middle /= std::max(slice.girth, k_no_length);
    return slices;
}

/// For each vertex whether it lies on another opening than `ring`.
std::vector<char> mark_others(const std::vector<Ring>& rings, const Ring& ring, Eigen::Index vertices)
{
    std::vector<char> result(std::size_t(vertices), 0);
    for (const Ring& other : rings)
        for (const auto& [a, b] : other)
            result[a] = 1;
    for (const auto& [a, b] : ring)
        result[a] = 0;
    return result;
}

/// Distance to the nearest other opening, m. Farther slices are incomplete.
double distance_to_others(const std::vector<double>& distance, const std::vector<char>& is_other)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < distance.size(); ++v)
        if (is_other[v])
            nearest = std::min(nearest, distance[v]);
    return nearest;
}

/// A tube ends at two consecutive wide slices: a single one is a fold. The slices of the hem are not tested, and what an
/// arm or a leg needs behind a cuff is not wide.
void measure_tube(Opening& opening, const std::vector<Slice>& slices, double diagonal)
{
    const double width = k_slice * diagonal, limb = k_widest_limb * diagonal;
    std::vector<double> sorted;
    double median = opening.girth;
    opening.tube_waist = std::numeric_limits<double>::infinity();
    const auto is_wide = [&](std::size_t i) {
        return i >= slices.size() || slices[i].girth > std::max(k_tube_widening * median, limb);
    };
    for (std::size_t i = 0; i < slices.size() && (i < k_hem_slices || !is_wide(i) || !is_wide(i + 1)); ++i) {
        const double girth = slices[i].girth;
        sorted.insert(std::upper_bound(sorted.begin(), sorted.end(), girth), girth);
        median = sorted[sorted.size() / 2];
        if (i >= k_hem_slices)
            opening.tube_waist = std::min(opening.tube_waist, girth);
        opening.tube_end = slices[i].middle;
    }
    opening.tube_length = width * double(sorted.size());
    opening.tube_girth = median;
    opening.tube_waist = std::min(opening.tube_waist, median);
}

/// A number for each vertex, the same within a connected piece.
std::vector<int> pieces_of(const TriangleMesh& mesh)
{
    DisjointSets joined(int(mesh.positions.rows()));
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 1; k < 3; ++k)
            joined.join(mesh.triangles(f, k), mesh.triangles(f, 0));
    std::vector<int> pieces(mesh.positions.rows());
    for (int v = 0; v < int(pieces.size()); ++v)
        pieces[v] = joined.root(v);
    return pieces;
}

/// Drops the borders of pieces that are sewn on larger ones: pockets, flaps, belt loops, buttons, linings. A tube that
/// is sewn on by one of its ends keeps the other one.
std::vector<Ring> drop_sewn_on(const TriangleMesh& mesh, const std::vector<int>& pieces, std::vector<Ring> rings)
{
    const GarmentMesh cloth { mesh.positions, mesh.triangles };
    const SewnPieces sewn = find_sewn_pieces(cloth, { mesh.triangles, int(mesh.positions.rows()) });
    if (sewn.ties.empty())
        return rings;
    std::vector<Eigen::AlignedBox3d> boxes(pieces.size());  // by the piece's number
    for (std::size_t v = 0; v < pieces.size(); ++v)
        boxes[pieces[v]].extend(Vec3(mesh.positions.row(Eigen::Index(v))));
    std::vector<char> is_sewn_on(pieces.size(), 0);  // by vertex
    for (const Tie& tie : sewn.ties)
        is_sewn_on[tie.vertex]
            |= boxes[pieces[tie.vertex]].diagonal().norm() < boxes[pieces[tie.corners[0]]].diagonal().norm();
    std::erase_if(rings, [&](const Ring& ring) {
        const auto count
            = std::count_if(ring.begin(), ring.end(), [&](const auto& edge) { return is_sewn_on[edge.first]; });
        return double(count) >= k_sewn_on * double(ring.size());
    });
    return rings;
}

/// The borders that a body can pass through.
std::vector<Ring> large_rings(const TriangleMesh& outward, const std::vector<int>& pieces)
{
    auto rings = keep_large(outward.positions, rings_of(border_edges(outward), int(outward.positions.rows())),
                            std::max(k_smallest_girth * diagonal(outward.positions), k_narrowest_girth));
    return drop_sewn_on(outward, pieces, std::move(rings));
}

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// Range of y of each piece, by the piece's number.
std::vector<Range> ranges_of(const Positions& positions, const std::vector<int>& pieces)
{
    std::vector<Range> ranges(pieces.size());
    for (std::size_t v = 0; v < pieces.size(); ++v) {
        Range& range = ranges[pieces[v]];
        range.low = std::min(range.low, positions(v, 1));
        range.high = std::max(range.high, positions(v, 1));
    }
    return ranges;
}

void measure_heights(Opening& opening, const std::vector<Range>& ranges)
{
    opening.low = opening.rim.colwise().minCoeff();
    opening.high = opening.rim.colwise().maxCoeff();
    opening.piece_low = ranges[opening.piece].low;
    opening.piece_height = ranges[opening.piece].high - opening.piece_low;
}

/// Extents of a rim along the direction in which it is longest, and across it, m.
struct RimExtents {
    double length, width;
};

RimExtents extents_of(const Positions& rim)
{
    const Positions about = rim.rowwise() - rim.colwise().mean();
    const Eigen::Matrix3d axes
        = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(about.transpose() * about).eigenvectors();  // longest last
    const auto extent = [&](int axis) {
        const Eigen::VectorXd along = about * axes.col(axis);
        return along.maxCoeff() - along.minCoeff();
    };
    return { extent(2), extent(1) };
}

/// A long narrow one; a neck that goes on in a placket is as long, but wide.
/// @param widest  m, girth of a round hole
bool is_slit(const Positions& rim, double widest)
{
    const auto [length, width] = extents_of(rim);
    return width < k_slit_roundness * length && std::numbers::pi * width < widest;
}

/// A slit in the shape of a V or a U, between a collar and what is worn in it. The long borders of open fronts enclose as
/// little.
bool is_bent_slit(const Opening& opening, double diagonal)
{
    return opening.girth < k_longest_slit * diagonal && opening.roundness < k_bent_slit_roundness;
}

/// The borders of a garment that a body can pass through, and the tubes that lead to them.
class Openings {
public:
    explicit Openings(const TriangleMesh& outward) :
        cloth_(outward), diagonal_(diagonal(outward.positions)), pieces_(pieces_of(outward)), graph_(outward),
        rings_(large_rings(outward, pieces_))
    {
        drop_holes();
    }

    std::size_t count() const { return rings_.size(); }

    std::vector<Opening> all() const
    {
        const std::vector<Range> ranges = ranges_of(cloth_.positions, pieces_);
        std::vector<Opening> openings(rings_.size());
        parallel_for<std::size_t>(rings_.size(), [&](std::size_t r) {
            openings[r] = opening_with_tube(rings_[r], rings_);
            openings[r].piece = pieces_[rings_[r][0].first];
            measure_heights(openings[r], ranges);
        });
        return openings;
    }

private:
    /// @param rings  where its tube ends at the latest; may contain it
    Opening opening_with_tube(const Ring& ring, const std::vector<Ring>& rings) const
    {
        const double width = slice_width();
        Opening opening = opening_of(cloth_.positions, ring);
        const std::vector<char> is_other = mark_others(rings, ring, cloth_.positions.rows());
        const std::vector<double> distance = graph_.distances_from(ring, is_other);
        std::vector<Slice> slices = slices_along(cloth_, distance, width);
        slices.resize(
            std::size_t(std::clamp(distance_to_others(distance, is_other) / width, 1.0, double(slices.size()))));
        measure_tube(opening, slices, diagonal_);
        return opening;
    }

    /// Holes between panels, torn cloth, pockets, slits: narrow for an armhole or a neck, and no tube leads to them as
    /// to a cuff.
    void drop_holes()
    {
        const double widest = k_widest_hole * diagonal_;
        const auto is_narrow = [&](const Ring& ring) {
            const Opening opening = opening_of(cloth_.positions, ring);
            return opening.girth < widest || is_slit(opening.rim, widest) || is_bent_slit(opening, diagonal_);
        };
        std::vector<Ring> sure;
        std::copy_if(rings_.begin(), rings_.end(), std::back_inserter(sure), std::not_fn(is_narrow));
        std::erase_if(rings_, [&](const Ring& ring) {
            return is_narrow(ring) && opening_with_tube(ring, sure).tube_length < k_shortest_cuff * slice_width();
        });
    }

    double slice_width() const { return k_slice * diagonal_; }

    const TriangleMesh& cloth_;
    double diagonal_;  // m
    std::vector<int> pieces_;
    EdgeGraph graph_;
    std::vector<Ring> rings_;
};

}  // namespace

std::vector<Opening> openings_of(const TriangleMesh& outward) { return Openings(outward).all(); }

std::size_t count_openings(const TriangleMesh& outward) { return Openings(outward).count(); }

std::vector<Opening> rotate(std::vector<Opening> openings, const TriangleMesh& cloth, const Eigen::Quaterniond& turn)
{
    const std::vector<Range> ranges = ranges_of(cloth.positions, pieces_of(cloth));
    for (Opening& opening : openings) {
        opening.centre = turn * opening.centre;
        opening.facing = turn * opening.facing;
        opening.tube_end = turn * opening.tube_end;
        opening.rim = (opening.rim * turn.toRotationMatrix().transpose()).eval();
        opening.rim_next = (opening.rim_next * turn.toRotationMatrix().transpose()).eval();
        measure_heights(opening, ranges);
    }
    return openings;
}

Positions positions_of_piece(const TriangleMesh& outward, int piece)
{
    const std::vector<int> pieces = pieces_of(outward);
    std::vector<Eigen::Index> rows;
    for (std::size_t v = 0; v < pieces.size(); ++v)
        if (pieces[v] == piece)
            rows.push_back(Eigen::Index(v));
    return outward.positions(rows, Eigen::all);
}

bool face_alike(const Opening& a, const Opening& b, const Vec3& axis)
{
    return (a.facing - 2 * a.facing.dot(axis) * axis).dot(b.facing) > k_facing_alike;
}

bool is_sealed(const TriangleMesh& outward)
{
    const Eigen::Index edges = 3 * outward.triangles.rows() / 2;  // derived: each edge has two sides if none is open
    return outward.positions.rows() - edges + outward.triangles.rows()
        == 2 * count_pieces(outward).count  // derived: Euler characteristic of spheres
        && border_edges(outward).empty();
}

Pieces count_pieces(const TriangleMesh& outward)
{
    const std::vector<int> pieces = pieces_of(outward);
    std::map<int, Eigen::AlignedBox3d> boxes;
    for (std::size_t v = 0; v < pieces.size(); ++v)
        boxes[pieces[v]].extend(Vec3(outward.positions.row(Eigen::Index(v))));
    Pieces result { int(boxes.size()), 0 };
    for (const auto& [name, box] : boxes)
        result.largest = std::max(result.largest, box.sizes().maxCoeff());
    return result;
}

}  // namespace garmentfit
