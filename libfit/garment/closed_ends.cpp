// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/closed_ends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "disjoint_sets.h"
#include "lids_and_fillings.h"
#include "panel.h"
#include "quantile.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"
#include "weld.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

/// Faces that are joined by flat edges, and the edges around them.
struct Region {
    std::vector<int> faces = {};
    Vec3 area = Vec3::Zero();  // m^2, sum of area vectors: of a flat region its area times its normal
    double girth = 0;  // m, of its outline
    double steep = 0;  // m, of the outline where the next face is steep
    double side = 0;  // m, of the outline, signed by the side on which the next face is
    std::vector<int> next_to = {};  // regions
    bool is_taken = false;  // in part, by a fan
};

class Caps {
public:
    /// @param weld  of the garment: seams of UV charts are no borders
    Caps(const GarmentMesh& garment, const Weld& weld) :
        positions_(weld.gather(garment.positions)),
        faces_(garment.triangles.unaryExpr([&](int v) { return weld.cloth_vertex(v); })),
        topology_(faces_, int(positions_.rows())), patches_(patches_of(topology_, int(faces_.rows()))),
        smallest_girth_(k_cap_girth * diagonal(garment.positions))
    {
        collect_areas();
        collect_regions();
        for (int side = 0; side < 3 * int(faces_.rows()); ++side)
            add_to_outline(side, regions_[region_of_[side / 3]]);
    }

    /// The faces of each cap.
    std::vector<std::vector<int>> find()
    {
        std::vector<std::vector<int>> caps = find_fans();
        for (const std::vector<int>& fan : caps)
            for (const int f : fan)
                regions_[region_of_[f]].is_taken = true;
        const auto add
            = [&](const std::vector<std::vector<int>>& more) { caps.insert(caps.end(), more.begin(), more.end()); };
        add(find_steep());
        if (is_closed())
            add(find_filled(caps));
        return caps;
    }

    bool is_closed() const { return topology_.border_edges().empty(); }

    const MeshTopology& topology() const { return topology_; }
    TriangleMesh mesh() const { return { positions_, faces_ }; }
    const std::vector<std::vector<int>>& patches() const { return patches_; }

    /// Whether each face belongs to cloth with thickness, whose sides and rims are flat: a thin closed piece with
    /// tunnels, which are its openings, or a panel, like a sphere, with less than half of the cloth.
    std::vector<char> mark_thick_cloth() const
    {
        struct Piece {
            double volume = 0, area = 0;  // m^3, m^2
            int faces = 0, vertices = 0;
            bool is_closed = true;
        };
        DisjointSets joined(int(positions_.rows()));
        for (const auto& corners : faces_.rowwise())
            for (int k = 0; k < 2; ++k)
                joined.join(corners[k], corners[k + 1]);
        std::vector<Piece> pieces(std::size_t(positions_.rows()));  // by the root
        double area = 0;
        for (int v = 0; v < int(positions_.rows()); ++v)
            ++pieces[joined.root(v)].vertices;
        for (int f = 0; f < int(faces_.rows()); ++f) {
            Piece& piece = pieces[joined.root(faces_(f, 0))];
            const Vec3 from = positions_.row(joined.root(faces_(f, 0)));
            piece.volume += areas_[f].dot(Vec3(positions_.row(faces_(f, 0))) - from) / 3;
            piece.area += areas_[f].norm();
            ++piece.faces;
            area += areas_[f].norm();
        }
        for (const int edge : topology_.border_edges())
            pieces[joined.root(topology_.edges()(edge, 0))].is_closed = false;
        std::vector<char> result;
        for (int f = 0; f < int(faces_.rows()); ++f) {
            const Piece& piece = pieces[joined.root(faces_(f, 0))];
            const bool has_tunnels = 2 * piece.vertices - piece.faces <= 0;
            result.push_back(piece.is_closed && (has_tunnels || piece.area < area / 2)
                             && is_panel(thickness_of(piece.volume, piece.area), piece.area));
        }
        return result;
    }

private:
    /// Holes that were filled with a fan around a vertex. No garment has such a vertex elsewhere, so the cloth around
    /// may be as flat as at a neck.
    std::vector<std::vector<int>> find_fans()
    {
        std::vector<std::vector<int>> faces_at(std::size_t(positions_.rows())), fans;
        for (int f = 0; f < int(faces_.rows()); ++f)
            for (const int v : faces_.row(f))
                faces_at[v].push_back(f);
        for (const std::vector<int>& faces : faces_at) {
            if (faces.size() < k_fan_faces)
                continue;
            const Region fan = region_with(faces);
            const bool is_even = std::all_of(faces.begin(), faces.end(), [&](int f) {
                return std::abs(areas_[f].stableNormalized().dot(fan.area.stableNormalized())) > k_fan_cosine;
            });
            // necks lie in the cloth around, cuffs are crumpled; a garment without any opening has them all the same
            if (is_closed() ? is_hole(fan, k_fill_depth) : is_even && is_flat_disc(fan, k_fan_depth))
                fans.push_back(faces);
        }
        return fans;
    }

    /// Holes of a closed garment that were filled with triangles from rim to rim: discs of long edges in which no
    /// vertex lies. Large flat parts of open garments may look the same.
    std::vector<std::vector<int>> find_filled(const std::vector<std::vector<int>>& caps)
    {
        std::vector<char> is_taken(std::size_t(faces_.rows()));
        for (const std::vector<int>& cap : caps)
            for (const int f : cap)
                is_taken[f] = 1;
        std::vector<double> lengths;
        for (int side = 0; side < 3 * int(faces_.rows()); ++side)
            lengths.push_back(length_of(side));
        const std::vector<double> usual = usual_lengths(lengths);
        DisjointSets joined(int(faces_.rows()));
        std::vector<char> is_seed(std::size_t(faces_.rows()));
        for (int side = 0; side < 3 * int(faces_.rows()); ++side) {
            const int other = topology_.opposite(side);
            if (other < side || is_taken[side / 3] || is_taken[other / 3])
                continue;
            const bool is_long = lengths[side] > k_fill_edge * usual[side / 3];
            is_seed[side / 3] |= is_long;
            if (is_long || (lengths[side] > k_ear_edge * usual[side / 3] && (is_ear(side) || is_ear(other))))
                joined.join(side / 3, other / 3);
        }
        std::map<int, std::vector<int>> regions;  // by the root
        std::set<int> seeded;
        for (int f = 0; f < int(faces_.rows()); ++f) {
            regions[joined.root(f)].push_back(f);
            if (is_seed[f])
                seeded.insert(joined.root(f));
        }
        std::vector<std::vector<int>> filled;
        for (const int root : seeded)
            if (is_hole(region_with(regions[root]), k_fill_depth) && is_without_vertices(regions[root]))
                filled.push_back(regions[root]);
        return filled;
    }

    /// Median of the sides of its patch, by face: a button may have most of a garment's faces.
    /// @param lengths  m, of all sides
    std::vector<double> usual_lengths(const std::vector<double>& lengths) const
    {
        std::vector<double> usual(std::size_t(faces_.rows()));
        for (const std::vector<int>& patch : patches_) {
            std::vector<double> own;
            for (const int f : patch)
                own.insert(own.end(), lengths.begin() + 3 * f, lengths.begin() + 3 * f + 3);
            const double median = quantile(own, 0.5);
            for (const int f : patch)
                usual[f] = median;
        }
        return usual;
    }

    double length_of(int side) const
    {
        return (positions_.row(faces_(side / 3, side % 3)) - positions_.row(faces_(side / 3, (side % 3 + 1) % 3)))
            .norm();
    }

    /// The angle opposite to the side is obtuse, as in a polygon every triangle's is that does not hold the middle.
    bool is_ear(int side) const
    {
        const Vec3 a = positions_.row(faces_(side / 3, side % 3)),
                   b = positions_.row(faces_(side / 3, (side % 3 + 1) % 3)),
                   apex = positions_.row(faces_(side / 3, (side % 3 + 2) % 3));
        return (a - apex).dot(b - apex) < 0;
    }

    /// Of a disc: faces that only share edges from rim to rim are a tree.
    bool is_without_vertices(const std::vector<int>& faces) const
    {
        const std::set<int> own(faces.begin(), faces.end());
        std::size_t inner = 0;
        for (const int f : faces)
            for (int side = 3 * f; side < 3 * f + 3; ++side)
                if (const int other = topology_.opposite(side); other >= 0)
                    inner += own.count(other / 3);
        return inner == 2 * (faces.size() - 1);
    }

    /// Some faces as one region with its outline.
    Region region_with(const std::vector<int>& faces)
    {
        Region region { faces };
        add_areas(region);
        std::vector<int> region_of(faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i)
            region_of[i] = std::exchange(region_of_[faces[i]], int(regions_.size()));
        for (const int f : faces)
            for (int side = 3 * f; side < 3 * f + 3; ++side)
                add_to_outline(side, region);
        for (std::size_t i = 0; i < faces.size(); ++i)
            region_of_[faces[i]] = region_of[i];
        return region;
    }

    std::vector<std::vector<int>> find_steep() const
    {
        std::vector<char> is_candidate(regions_.size());
        for (std::size_t r = 0; r < regions_.size(); ++r)
            is_candidate[r]
                = is_flat_disc(regions_[r], k_cap_depth) && regions_[r].steep > k_cap_outline * regions_[r].girth;
        std::vector<std::vector<int>> caps;
        for (std::size_t r = 0; r < regions_.size(); ++r)  // the sides of a block are next to each other
            if (is_candidate[r] && std::none_of(regions_[r].next_to.begin(), regions_[r].next_to.end(), [&](int other) {
                    return is_candidate[other];
                }))
                caps.push_back(regions_[r].faces);
        return caps;
    }

    void collect_areas()
    {
        for (Eigen::Index f = 0; f < faces_.rows(); ++f)
            areas_.push_back(area_vector(positions_, faces_, f));
    }

    double cosine(int f, int g) const { return areas_[f].stableNormalized().dot(areas_[g].stableNormalized()); }

    /// 1 if both faces run along their common edge in opposite directions, as oriented faces do; -1 if not.
    double orientation(int side, int other) const
    {
        return faces_(side / 3, side % 3) == faces_(other / 3, other % 3) ? -1 : 1;
    }

    void collect_regions()
    {
        DisjointSets flat(int(faces_.rows()));
        for (int side = 0; side < 3 * int(faces_.rows()); ++side)
            if (const int other = topology_.opposite(side);
                other > side && orientation(side, other) * cosine(side / 3, other / 3) > k_flat_cosine)
                flat.join(side / 3, other / 3);
        std::vector<int> number(std::size_t(faces_.rows()), -1);
        for (int f = 0; f < int(faces_.rows()); ++f) {
            int& region = number[flat.root(f)];
            if (region < 0) {
                region = int(regions_.size());
                regions_.emplace_back();
            }
            regions_[region].faces.push_back(f);
            region_of_.push_back(region);
        }
        for (Region& region : regions_)
            add_areas(region);
    }

    void add_areas(Region& region) const
    {
        for (const int f : region.faces)  // of either orientation
            region.area += (areas_[f].dot(areas_[region.faces[0]]) < 0 ? -1 : 1) * areas_[f];
    }

    void add_to_outline(int side, Region& region) const
    {
        const int f = side / 3, other = topology_.opposite(side);
        if (other >= 0 && region_of_[other / 3] == region_of_[f])
            return;
        const Vec3 a = positions_.row(faces_(f, side % 3)), b = positions_.row(faces_(f, (side % 3 + 1) % 3));
        const double length = (b - a).norm();
        region.girth += length;
        if (other < 0)
            return;
        region.next_to.push_back(region_of_[other / 3]);
        const Vec3 normal = region.area.stableNormalized(), along = (b - a).stableNormalized(),
                   apex = positions_.row(faces_(other / 3, (other % 3 + 2) % 3));
        Vec3 away = apex - a;
        away -= away.dot(along) * along;
        const double rise = away.stableNormalized().dot(normal);
        region.side += rise > 0 ? length : -length;
        if (std::abs(rise) > k_steep_sine)
            region.steep += length;
    }

    /// All cloth around on one side of it.
    bool is_flat_disc(const Region& region, double depth) const
    {
        return std::abs(region.side) > k_fan_outline * region.girth && is_hole(region, depth);
    }

    bool is_hole(const Region& region, double depth) const
    {
        const double area = region.area.norm();
        const double disc = region.girth * region.girth / (4 * std::numbers::pi);
        return !region.is_taken && region.girth > smallest_girth_ && area > k_cap_roundness * disc && is_disc(region)
            && is_flat(region, depth);
    }

    /// Euler characteristic 1: one outline, no handle.
    bool is_disc(const Region& region) const
    {
        std::vector<int> vertices, edges;
        for (const int f : region.faces)
            for (int k = 0; k < 3; ++k) {
                vertices.push_back(faces_(f, k));
                edges.push_back(topology_.edge_of(3 * f + k));
            }
        const auto count = [](std::vector<int>& list) {
            std::sort(list.begin(), list.end());
            return std::ptrdiff_t(std::unique(list.begin(), list.end()) - list.begin());
        };
        return count(vertices) - count(edges) + std::ptrdiff_t(region.faces.size()) == 1;
    }

    bool is_flat(const Region& region, double depth) const
    {
        const Vec3 normal = region.area.normalized();
        double low = INFINITY, high = -INFINITY;
        for (const int f : region.faces)
            for (const int v : faces_.row(f)) {
                low = std::min(low, positions_.row(v).dot(normal));
                high = std::max(high, positions_.row(v).dot(normal));
            }
        return high - low < depth * std::sqrt(region.area.norm());
    }

    Positions positions_;
    Triangles faces_;
    MeshTopology topology_;
    std::vector<std::vector<int>> patches_;
    double smallest_girth_;  // m
    std::vector<Vec3> areas_;
    std::vector<Region> regions_;
    std::vector<int> region_of_;
};

void leave_out(const std::vector<std::vector<int>>& parts, std::vector<char>& is_kept)
{
    for (const std::vector<int>& part : parts)
        for (const int f : part)
            is_kept[f] = 0;
}

/// How many caps each patch has.
std::vector<int> count_caps(const std::vector<std::vector<int>>& patches, const std::vector<std::vector<int>>& caps)
{
    std::vector<int> counts;
    for (const std::vector<int>& patch : patches)  // faces ascend
        counts.push_back(int(std::count_if(caps.begin(), caps.end(), [&](const std::vector<int>& cap) {
            return std::binary_search(patch.begin(), patch.end(), cap[0]);
        })));
    return counts;
}

/// Without those of a patch that has more of them than a body has ends: they are facets of coarse cloth.
std::vector<std::vector<int>> drop_facets(const std::vector<std::vector<int>>& patches,
                                          std::vector<std::vector<int>> caps)
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

}  // namespace

OpenedGarment open_ends(const GarmentMesh& garment)
{
    Caps found(garment, Weld(garment));
    const TriangleMesh mesh = found.mesh();
    const std::vector<std::vector<int>>& patches = found.patches();
    std::vector<std::vector<int>> caps = drop_facets(patches, found.find());
    std::vector<char> is_kept(std::size_t(garment.triangles.rows()), 1);
    leave_out(find_fillings(mesh, found.topology(), patches, count_caps(patches, caps)), is_kept);
    std::erase_if(caps, [&](const std::vector<int>& cap) { return !is_kept[cap[0]]; });
    if (!caps.empty())
        std::erase_if(caps, [thick = found.mark_thick_cloth()](const std::vector<int>& cap) { return thick[cap[0]]; });
    if (found.is_closed() && caps.size() < k_least_ends)
        caps.clear();
    leave_out(caps, is_kept);
    const std::vector<std::vector<int>> lids = find_lids(mesh, found.topology(), patches, is_kept);
    leave_out(lids, is_kept);
    std::vector<int> kept;
    for (int f = 0; f < int(is_kept.size()); ++f)
        if (is_kept[f])
            kept.push_back(f);
    return { { garment.positions, garment.triangles(kept, Eigen::all) }, int(caps.size() + lids.size()) };
}

}  // namespace garmentfit
