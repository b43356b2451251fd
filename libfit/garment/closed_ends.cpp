// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/closed_ends.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "caps.h"
#include "garments_beside.h"
#include "hollow_ends.h"
#include "lids_and_fillings.h"
#include "nearest.h"
#include "thick_cloth.h"
#include "topology.h"
#include "tuning.h"
#include "used_vertices.h"
#include "warps.h"
#include "weld.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

using Parts = std::vector<std::vector<int>>;  // the faces of each part

void leave_out(const Parts& parts, std::vector<char>& is_kept)
{
    for (const std::vector<int>& part : parts)
        for (const int f : part)
            is_kept[f] = 0;
}

std::vector<int> marked(const std::vector<char>& marks)
{
    std::vector<int> result;
    for (int f = 0; f < int(marks.size()); ++f)
        if (marks[f])
            result.push_back(f);
    return result;
}

/// How many caps each patch has.
std::vector<int> count_caps(const Parts& patches, const Parts& caps)
{
    std::vector<int> counts;
    for (const std::vector<int>& patch : patches)  // faces ascend
        counts.push_back(int(std::count_if(caps.begin(), caps.end(), [&](const std::vector<int>& cap) {
            return std::binary_search(patch.begin(), patch.end(), cap[0]);
        })));
    return counts;
}

/// Without those of a patch that has more of them than a body has ends: they are facets of coarse cloth.
Parts drop_facets(const Parts& patches, Parts caps)
{
    if (caps.size() <= k_most_ends)
        return caps;
    const std::vector<int> counts = count_caps(patches, caps);
    std::erase_if(caps, [&](const std::vector<int>& cap) {
        for (std::size_t p = 0; p < patches.size(); ++p)
            if (counts[p] > int(k_most_ends) && std::binary_search(patches[p].begin(), patches[p].end(), cap[0]))
                return true;
        return false;
    });
    return caps;
}

/// What is no cloth of a garment.
struct Findings {
    Parts caps, solids, lids, specks;
    std::vector<int> kept;  // faces of none of them
};

Findings find_what_is_no_cloth(Caps& found, const GarmentMesh& garment)
{
    const TriangleMesh mesh = found.mesh();
    const Parts& patches = found.patches();
    std::vector<char> is_kept(std::size_t(garment.triangles.rows()), 1);
    Findings result;
    Parts& caps = result.caps = drop_facets(patches, found.find());
    result.solids = find_fillings(mesh, found.topology(), patches, count_caps(patches, caps));
    leave_out(result.solids, is_kept);
    result.specks = find_specks(mesh, patches);
    leave_out(result.specks, is_kept);
    std::erase_if(caps, [&](const std::vector<int>& cap) { return !is_kept[cap[0]]; });
    if (!caps.empty())
        std::erase_if(caps, [thick = mark_thick_cloth(mesh, found.topology())](const std::vector<int>& cap) {
            return thick[cap[0]];
        });
    if (found.is_closed() && caps.size() < k_least_ends)
        caps.clear();
    leave_out(caps, is_kept);
    result.lids = find_lids(mesh, found.topology(), patches, is_kept);
    leave_out(result.lids, is_kept);
    result.kept = marked(is_kept);
    return result;
}

/// Draws pieces of the mesh into one place of the cloth each.
class Gatherer {
public:
    /// @param cloth  triangles of some of the vertices
    Gatherer(Positions& positions, const Triangles& cloth) :
        positions_(positions), cloth_(used_vertices(cloth)), is_cloth_(std::size_t(positions.rows()), 0)
    {
        for (const int v : cloth_)
            is_cloth_[v] = 1;
    }

    /// Gathers those that share no vertex with the cloth. @return how many
    int gather(const Triangles& triangles, const Parts& pieces, int& faces)
    {
        int gathered = 0;
        for (const std::vector<int>& piece : pieces) {
            const std::vector<int> vertices = used_vertices(triangles(piece, Eigen::all));
            if (cloth_.empty() || std::any_of(vertices.begin(), vertices.end(), [&](int v) { return is_cloth_[v]; }))
                continue;
            const Eigen::RowVector3d middle = positions_(vertices, Eigen::all).colwise().mean();
            const Eigen::RowVector3d place = positions_.row(nearest_cloth(middle));
            for (const int v : vertices)
                positions_.row(v) = place;
            ++gathered;
            faces += int(piece.size());
        }
        return gathered;
    }

private:
    int nearest_cloth(const Eigen::RowVector3d& place) const
    {
        return *std::min_element(cloth_.begin(), cloth_.end(), [&](int a, int b) {
            return (positions_.row(a) - place).squaredNorm() < (positions_.row(b) - place).squaredNorm();
        });
    }

    Positions& positions_;
    std::vector<int> cloth_;
    std::vector<char> is_cloth_;
};

/// With each triangle once, where exporters wrote some again, with the same vertices or others at their places, or
/// from the other side for viewers that show one side only.
GarmentMesh drop_repeated(const GarmentMesh& garment)
{
    const Weld weld(garment);
    std::vector<std::array<int, 3>> sorted;
    for (const auto& triangle : garment.triangles.rowwise()) {
        std::array<int, 3>& corners = sorted.emplace_back();
        std::transform(triangle.begin(), triangle.end(), corners.begin(), [&](int v) { return weld.cloth_vertex(v); });
        std::sort(corners.begin(), corners.end());
    }
    std::vector<int> order(sorted.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sorted[a] < sorted[b]; });
    std::vector<char> is_kept(order.size(), 1);
    for (std::size_t i = 1; i < order.size(); ++i)
        is_kept[order[i]] = sorted[order[i]] != sorted[order[i - 1]];
    return with_triangles(garment, garment.positions, marked(is_kept));
}

/// Without some pieces, which are counted.
OpenedGarment leave_out_pieces(GarmentMesh garment, const Parts& pieces, int LeftOut::*count)
{
    std::vector<char> is_kept(std::size_t(garment.triangles.rows()), 1);
    leave_out(pieces, is_kept);
    OpenedGarment result;
    result.garment = with_triangles(garment, std::move(garment.positions), marked(is_kept));
    Gatherer gatherer(result.garment.positions, result.garment.triangles);
    result.left_out.*count = gatherer.gather(garment.triangles, pieces, result.left_out.faces);
    return result;
}

/// A garment without what is no cloth of it.
struct WithoutCaps {
    OpenedGarment opened;
    std::vector<Triangles> caps;
};

/// Without caps, lids, fillings and specks, and without backdrops and garments beside it.
WithoutCaps leave_out_caps(const GarmentMesh& garment)
{
    Caps caps(garment);
    const auto alone_without = [&](const Parts& pieces, int LeftOut::*count) {
        const OpenedGarment alone = leave_out_pieces(garment, pieces, count);
        WithoutCaps result = leave_out_caps(alone.garment);
        result.opened.left_out.*count += alone.left_out.*count;
        result.opened.left_out.faces += alone.left_out.faces;
        return result;
    };
    if (const Parts backdrops = find_backdrops(caps.mesh(), caps.patches()); !backdrops.empty())
        return alone_without(backdrops, &LeftOut::backdrops);
    if (const Parts plinths = find_plinths(caps.mesh(), caps.patches()); !plinths.empty())
        return alone_without(plinths, &LeftOut::backdrops);
    if (const Parts others = find_garments_beside(caps.mesh(), caps.patches()); !others.empty())
        return alone_without(others, &LeftOut::garments);
    const Findings found = find_what_is_no_cloth(caps, garment);
    OpenedGarment result { with_triangles(garment, garment.positions, found.kept),
                           int(found.caps.size() + found.lids.size()),
                           {} };
    Gatherer gatherer(result.garment.positions, result.garment.triangles);
    result.left_out.solids = gatherer.gather(garment.triangles, found.solids, result.left_out.faces);
    result.left_out.lids = gatherer.gather(garment.triangles, found.lids, result.left_out.faces);
    result.left_out.specks = gatherer.gather(garment.triangles, found.specks, result.left_out.faces);
    WithoutCaps without { std::move(result), {} };
    for (const std::vector<int>& cap : found.caps)
        without.caps.emplace_back(garment.triangles(cap, Eigen::all));
    return without;
}

/// Hollows beside caps.
struct Ends {
    HollowEnds hollows;
    int count = 0;  ///< of ends that no cap closes
};

/// Both sleeves of a garment that end alike, of which one was taken for a cap and the other was not.
Ends find_sleeves_with(const Triangles& cap, const GarmentMesh& garment)
{
    const int faces = int(garment.triangles.rows());
    GarmentMesh capped { garment.positions, garment.triangles };
    capped.triangles.conservativeResize(faces + cap.rows(), 3);
    capped.triangles.bottomRows(cap.rows()) = cap;
    Ends sleeves { find_closed_sleeves(capped) };
    for (std::vector<int>& sleeve : sleeves.hollows.faces)
        sleeves.count += std::erase_if(sleeve, [&](int f) { return f >= faces; }) == 0;
    return sleeves;
}

Ends find_ends(const WithoutCaps& found)
{
    HollowEnds hollows = find_hollow_ends(found.opened.garment);
    if (hollows.faces.empty() && found.caps.size() == 1)
        return find_sleeves_with(found.caps[0], found.opened.garment);
    if (hollows.faces.empty() && found.caps.size() == k_least_ends)
        hollows = find_closed_neck(found.opened.garment);
    const int count = int(hollows.faces.size());
    return { std::move(hollows), count };
}

/// Draws each vertex of the given triangles that is none of the cloth among them to the nearest one that is.
void draw_to_cloth(Positions& positions, const Triangles& given, const Triangles& cloth)
{
    const std::vector<int> kept = used_vertices(cloth);
    const NearestPoint nearest(positions(kept, Eigen::all));
    for (const int v : used_vertices(given))
        if (!std::binary_search(kept.begin(), kept.end(), v))
            positions.row(v) = positions.row(kept[nearest.index(positions.row(v))]).eval();
}

}  // namespace

OpenedGarment open_ends(const GarmentMesh& garment)
{
    WithoutCaps found = leave_out_caps(drop_repeated(garment));
    Ends ends = find_ends(found);
    OpenedGarment result = std::move(found.opened);
    if (ends.hollows.faces.empty())
        return result;
    const GarmentMesh given = std::move(result.garment);
    std::vector<char> is_kept(std::size_t(given.triangles.rows()), 1);
    leave_out(ends.hollows.faces, is_kept);
    result.garment = with_triangles(given, given.positions, marked(is_kept));
    draw_to_cloth(result.garment.positions, given.triangles, result.garment.triangles);
    result.closed_ends += ends.count;
    result.outside = std::move(ends.hollows.outside);
    return result;
}

Triangles without_scenery(const GarmentMesh& given)
{
    const GarmentMesh garment = drop_repeated(given);
    const Weld weld(garment);
    const TriangleMesh mesh { weld.gather(garment.positions),
                              garment.triangles.unaryExpr([&](int v) { return weld.cloth_vertex(v); }) };
    const int faces = int(mesh.triangles.rows());
    const MeshTopology topology(mesh.triangles, int(mesh.positions.rows()));
    Parts patches = patches_of(topology, faces);
    std::vector<char> is_kept(std::size_t(faces), 1);
    for (const auto find : { find_backdrops, find_plinths, find_specks }) {
        leave_out(find(mesh, patches), is_kept);
        std::erase_if(patches, [&](const std::vector<int>& patch) { return !is_kept[patch[0]]; });
    }
    return garment.triangles(marked(is_kept), Eigen::all);
}

}  // namespace garmentfit
