// SPDX-License-Identifier: GPL-3.0-or-later
#include "hollow_ends.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "disjoint_sets.h"
#include "garment_openings.h"
#include "garment_wrap.h"
#include "hollows.h"
#include "kept_results.h"
#include "nearest.h"
#include "outer_sheet.h"
#include "parallel.h"
#include "plain_reading.h"
#include "shut_neck.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"
#include "weld.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

/// How many openings for a body a patch has that is most of the cloth, before seams are closed; 0 without such a patch.
/// A quick answer for most garments.
std::size_t count_plain_openings(const GarmentMesh& garment)
{
    TriangleMesh cloth = weld_vertices(garment);
    double area = 0;
    const std::vector<Patch> patches = collect_patches(cloth);
    for (const Patch& patch : patches)
        area += patch.area;
    const auto main
        = std::find_if(patches.begin(), patches.end(), [&](const Patch& patch) { return 2 * patch.area > area; });
    if (main == patches.end())
        return 0;
    const MeshTopology topology(cloth.triangles(main->faces, Eigen::all), int(cloth.positions.rows()));
    const std::vector<std::vector<int>> loops = topology.border_loops();
    return std::size_t(std::count_if(loops.begin(), loops.end(), [&](const std::vector<int>& loop) {
        return girth_of(cloth.positions, loop) > k_cap_girth * diagonal(cloth.positions);
    }));
}

/// Whether it encloses more than its own thickness.
bool is_solid(const GarmentWrap& wrap)
{
    const Patch& patch = largest_patch(wrap);
    return thickness_of(patch) > k_thickest * std::sqrt(patch.area);
}

/// The faces of a wrap that are seen from outside: of cloth that goes in at an opening the outer sheet.
std::vector<int> outside_of(const GarmentWrap& wrap)
{
    const Patch& patch = largest_patch(wrap);
    return is_solid(wrap)
        ? patch.faces
        : outer_sheet(wrap.surface, patch.faces,
                      opposite_edges(wrap.surface.triangles, int(wrap.surface.positions.rows())), thickness_of(patch));
}

TriangleMesh without_hollows(const TriangleMesh& solid, const std::vector<Hollow>& hollows)
{
    std::vector<char> is_left_out(std::size_t(solid.triangles.rows()));
    for (const Hollow& hollow : hollows)
        for (const auto* faces : { &hollow.floor, &hollow.walls })
            for (const int f : *faces)
                is_left_out[f] = 1;
    std::vector<int> kept;
    for (int f = 0; f < int(is_left_out.size()); ++f)
        if (!is_left_out[f])
            kept.push_back(f);
    return weld_vertices({ solid.positions, solid.triangles(kept, Eigen::all) });
}

/// For each face of a garment the number of the hollow of its wrap on whose faces a third of it lies, or -1.
std::vector<int> hollow_of_faces(const GarmentMesh& garment, const TriangleMesh& wrap,
                                 const std::vector<Hollow>& hollows)
{
    std::vector<int> hollow_of(std::size_t(wrap.triangles.rows()), -1);
    for (std::size_t i = 0; i < hollows.size(); ++i)
        for (const int f : hollows[i].floor)
            hollow_of[f] = int(i);
    const TriangleTree tree(wrap);
    const double reach = (k_garment_wrap + k_garment_wrap_offset) * diagonal(wrap.positions);
    std::vector<int> result(std::size_t(garment.triangles.rows()), -1);
    parallel_for<int>(
        int(result.size()),
        [&](int f) {
            const Eigen::Matrix3d corners = garment.positions(garment.triangles.row(f), Eigen::all);
            int inside = 0, found = -1;
            for (int i = 0; i < 6; ++i) {
                Eigen::RowVector3d share = Eigen::RowVector3d::Constant(1.0 / 6);
                share[i % 3] += i < 3 ? 1.0 / 2 : -1.0 / 6;
                share += Eigen::RowVector3d::Constant((1 - share.sum()) / 3);
                const Vec3 place = share * corners;
                const auto nearest = tree.nearest_triangle(place);
                if (const int hollow = hollow_of[nearest->triangle];
                    hollow >= 0 && (nearest->point - place).norm() < reach) {
                    ++inside;
                    found = hollow;
                }
            }
            if (inside >= 2)
                result[f] = found;
        },
        256);  // unit: grain of the parallel loop
    return result;
}

/// Adds what has no more than one neighbour outside of a hollow: teeth at its rim, and rests of a fan.
void fill_up(std::vector<int>& hollow_of, const MeshTopology& topology)
{
    for (bool changes = true; changes;) {
        changes = false;
        for (int f = 0; f < int(hollow_of.size()); ++f) {
            if (hollow_of[f] >= 0)
                continue;
            int next_to = 0, hollow = -1;
            for (int side = 3 * f; side < 3 * f + 3; ++side)
                if (const int other = topology.opposite(side); other >= 0 && hollow_of[other / 3] >= 0) {
                    ++next_to;
                    hollow = hollow_of[other / 3];
                }
            if (next_to >= 2) {
                hollow_of[f] = hollow;
                changes = true;
            }
        }
    }
}

/// Adds patches that lie within a hollow: of what is left of the cloth each one whose neighbours are all on the hollow,
/// and which is smaller than that is. They would float in the opening.
void add_islands(std::vector<int>& hollow_of, const MeshTopology& topology, const TriangleMesh& cloth)
{
    constexpr int k_unknown = -1, k_none = -2;
    const int faces = int(hollow_of.size());
    DisjointSets parts(faces);
    for (int side = 0; side < 3 * faces; ++side)
        if (const int other = topology.opposite(side); other >= 0 && hollow_of[side / 3] == hollow_of[other / 3])
            parts.join(side / 3, other / 3);
    std::vector<double> areas(hollow_of.size());  // m^2, by root
    std::vector<int> within(hollow_of.size(), k_unknown);  // hollow, by root
    std::map<int, double> area_of_hollow;
    for (int f = 0; f < faces; ++f) {
        const double area = area_vector(cloth.positions, cloth.triangles, f).norm();
        areas[parts.root(f)] += area;
        if (hollow_of[f] >= 0) {
            area_of_hollow[hollow_of[f]] += area;
            continue;
        }
        int& hollow = within[parts.root(f)];
        for (int side = 3 * f; side < 3 * f + 3; ++side) {
            const int other = topology.opposite(side), next = other >= 0 ? hollow_of[other / 3] : k_none;
            if (other >= 0 && next < 0)
                continue;  // of the same patch
            hollow = hollow == k_unknown || hollow == next ? next : k_none;
        }
    }
    for (int f = 0; f < faces; ++f)
        if (const int root = parts.root(f), hollow = within[root];
            hollow_of[f] < 0 && hollow >= 0 && areas[root] < area_of_hollow[hollow])
            hollow_of[f] = hollow;
}

/// The garment's faces on each hollow of a surface that lies round it.
std::vector<std::vector<int>> faces_on(const std::vector<Hollow>& hollows, const TriangleMesh& surface,
                                       const GarmentMesh& garment)
{
    std::vector<int> hollow_of = hollow_of_faces(garment, surface, hollows);
    const Weld weld(garment);
    const TriangleMesh cloth { weld.gather(garment.positions),
                               garment.triangles.unaryExpr([&](int v) { return weld.cloth_vertex(v); }) };
    const MeshTopology topology(cloth.triangles, int(cloth.positions.rows()));
    fill_up(hollow_of, topology);
    add_islands(hollow_of, topology, cloth);
    std::vector<std::vector<int>> faces(hollows.size());
    for (int f = 0; f < int(hollow_of.size()); ++f)
        if (hollow_of[f] >= 0)
            faces[hollow_of[f]].push_back(f);
    std::erase_if(faces, [](const std::vector<int>& end) { return end.empty(); });
    return faces;
}

/// Where a hollow is, and where it opens.
struct Place {
    Vec3 middle = Vec3::Zero(), axis = Vec3::Zero();  // m, unit
    double area = 0, opening = 0;  // m^2, and of a disc that closes it
};

Place place_of(const Hollow& hollow, const TriangleMesh& surface)
{
    Place place;
    for (const auto* faces : { &hollow.floor, &hollow.walls })
        for (const int f : *faces) {
            const Vec3 area = area_vector(surface.positions, surface.triangles, f);
            place.area += area.norm();
            place.axis += area;
            place.middle
                += area.norm() * Vec3(surface.positions(surface.triangles.row(f), Eigen::all).colwise().mean());
        }
    place.middle /= place.area;
    place.opening = place.axis.norm();
    place.axis = place.axis.stableNormalized();
    return place;
}

/// Whether two hollows are alike, like mirror images.
bool are_mirrored(const Place& a, const Place& b, const Vec3& across)
{
    const Vec3 mirrored = a.axis - 2 * a.axis.dot(across) * across;
    return std::max(a.area, b.area) < k_pair_areas * std::min(a.area, b.area) && mirrored.dot(b.axis) > k_pair_mirrored;
}

/// Where the trunk of a top is, by both sleeves and the hem. None if the places are not these three.
std::optional<Trunk> trunk_between(const std::vector<Place>& ends)
{
    if (ends.size() != 3)
        return {};
    for (int hem = 0; hem < 3; ++hem) {
        const Place &low = ends[hem], &left = ends[(hem + 1) % 3], &right = ends[(hem + 2) % 3];
        const Vec3 between = (left.middle + right.middle) / 2, across = (right.middle - left.middle).stableNormalized();
        const double width = (right.middle - left.middle).norm();
        if (low.area > std::max(left.area, right.area) && are_mirrored(left, right, across)
            && std::abs((low.middle - between).dot(across)) < k_hem_off_middle * width
            && (left.axis + right.axis).stableNormalized().dot(low.axis) > k_sleeves_with_hem)
            return Trunk { low.middle, between, -(low.axis - low.axis.dot(across) * across).stableNormalized(),
                           across,     width,   low.opening };
    }
    return {};
}

std::optional<Trunk> trunk_between(const std::vector<Hollow>& hollows, const TriangleMesh& surface)
{
    std::vector<Place> ends;
    for (const Hollow& hollow : hollows)
        ends.push_back(place_of(hollow, surface));
    return trunk_between(ends);
}

std::optional<Trunk> trunk_between(const std::vector<Opening>& openings)
{
    std::vector<Place> ends;
    for (const Opening& opening : openings) {
        const double disc = opening.roundness * opening.girth * opening.girth / (4 * std::numbers::pi);
        ends.push_back({ opening.centre, opening.facing, disc, disc });
    }
    return trunk_between(ends);
}

/// The faces of a surface that lie at some faces of the cloth in it.
std::vector<int> faces_at(const std::vector<int>& part, const TriangleMesh& cloth, const TriangleMesh& surface)
{
    std::vector<char> is_part(std::size_t(cloth.triangles.rows()));
    for (const int f : part)
        is_part[f] = 1;
    const TriangleTree tree(cloth);
    std::vector<int> result;
    for (int f = 0; f < int(surface.triangles.rows()); ++f) {
        const Vec3 middle = surface.positions(surface.triangles.row(f), Eigen::all).colwise().mean();
        if (is_part[tree.nearest_triangle(middle)->triangle])
            result.push_back(f);
    }
    return result;
}

/// Opens the neck of a top of which only sleeves and hem are hollow.
void add_shut_neck(std::vector<Hollow>& hollows, std::vector<std::vector<int>>& faces, const TriangleMesh& surface,
                   const GarmentMesh& opened, const TriangleMesh& cloth)
{
    const std::optional<Trunk> trunk = trunk_between(hollows, surface);
    if (!trunk)
        return;
    std::vector<int> neck = find_shut_neck(cloth, *trunk);
    if (neck.empty())
        return;
    hollows.push_back({ faces_at(neck, cloth, surface), {} });
    const std::vector<std::vector<int>> found = faces_on({ { std::move(neck), {} } }, cloth, opened);
    faces.insert(faces.end(), found.begin(), found.end());
}

/// Of a garment through which no body passes.
HollowEnds search_shut(const GarmentMesh& opened, const PlainReading& plain)
{
    GarmentWrap wrap = wrap_parts(plain);
    const bool was_solid = is_solid(wrap);
    if (!was_solid) {
        if (sheets_of(wrap))
            return {};
        wrap = wrap_closed(plain);
    }
    const auto find = was_solid ? find_solid_ends : find_hollows;
    std::vector<Hollow> hollows = find(wrap.surface, outside_of(wrap));
    if (hollows.size() + !was_solid < k_fewest_openings)
        return {};
    std::vector<std::vector<int>> faces = faces_on(hollows, wrap.surface, opened);
    if (!was_solid)
        return { std::move(faces), {} };
    add_shut_neck(hollows, faces, wrap.surface, opened, plain.outer);
    return { std::move(faces), without_hollows(wrap.surface, hollows) };
}

/// Whether two hollows are a pair, and outermost in the direction from one to the other, as both cuffs of a shirt are.
/// Folds of a skirt are not.
bool are_pair(const Place& a, const Place& b, const TriangleMesh& surface)
{
    const Vec3 across = (b.middle - a.middle).stableNormalized();
    const Eigen::VectorXd along = (surface.positions.rowwise() - a.middle.transpose()) * across;
    const double length = (b.middle - a.middle).norm();
    return are_mirrored(a, b, across) && b.axis.dot(across) > k_pair_outwards
        && std::max(along.maxCoeff() - length, -along.minCoeff()) < k_pair_beyond * length;
}

/// Whether a hollow lies in an opening: hems are folded inwards.
bool lies_in(const Place& hollow, const Opening& opening)
{
    return (hollow.middle - opening.centre).norm() < k_in_opening * opening.girth;
}

/// Those of pieces through which something passes: prints and pockets that lie on the cloth have one border each.
std::vector<Opening> openings_of_passages(const TriangleMesh& cloth)
{
    std::vector<Opening> openings = openings_of(cloth);
    std::map<int, int> count;  // by piece
    for (const Opening& opening : openings)
        ++count[opening.piece];
    std::erase_if(openings, [&](const Opening& opening) { return count[opening.piece] == 1; });
    return openings;
}

/// Of a garment with two openings, hem and neck: both sleeves may be closed. Where there are other hollows, all are folds.
HollowEnds search_sleeves(const GarmentMesh& opened, const PlainReading& plain)
{
    const std::vector<Opening> openings = openings_of_passages(plain.outer);
    if (openings.size() != 2)
        return {};
    const TriangleMesh closed = fill_openings(plain.outer);
    std::vector<int> cloth(std::size_t(plain.outer.triangles.rows()));
    std::iota(cloth.begin(), cloth.end(), 0);
    std::vector<Hollow> hollows = find_hollows(closed, cloth);
    std::erase_if(hollows, [&](const Hollow& hollow) {
        const Place place = place_of(hollow, closed);
        return lies_in(place, openings[0]) || lies_in(place, openings[1]);
    });
    if (hollows.size() != 2 || !are_pair(place_of(hollows[0], closed), place_of(hollows[1], closed), closed))
        return {};
    return { faces_on(hollows, closed, opened), {} };
}

HollowEnds search(const GarmentMesh& opened)
{
    const PlainReading plain = read_plainly(opened);
    return plain.serves && !plain.is_sealed ? search_sleeves(opened, plain) : search_shut(opened, plain);
}

}  // namespace

void transform(HollowEnds& ends, const Eigen::Matrix4d& motion) { transform(ends.outside, motion); }

HollowEnds find_closed_sleeves(const GarmentMesh& garment)
{
    static KeptResults<HollowEnds> kept;
    if (count_plain_openings(garment) != 2)  // derived: hem and neck
        return {};
    return kept.of(garment, [&] {
        const PlainReading plain = read_plainly(garment);
        return plain.serves && !plain.is_sealed ? search_sleeves(garment, plain) : HollowEnds();
    });
}

HollowEnds find_closed_neck(const GarmentMesh& garment)
{
    static KeptResults<HollowEnds> kept;
    return kept.of(garment, [&]() -> HollowEnds {
        const PlainReading plain = read_plainly(garment);
        if (!plain.serves || plain.is_sealed)
            return {};
        const std::optional<Trunk> trunk = trunk_between(openings_of_passages(plain.outer));
        if (!trunk)
            return {};
        return { faces_on({ { find_shut_neck(plain.outer, *trunk), {} } }, plain.outer, garment), {} };
    });
}

HollowEnds find_hollow_ends(const GarmentMesh& opened)
{
    static KeptResults<HollowEnds> kept;
    if (opened.triangles.rows() == 0 || count_plain_openings(opened) > 2)  // derived: trousers have three
        return {};
    return kept.of(opened, [&] { return search(opened); });
}

}  // namespace garmentfit
