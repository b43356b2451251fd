// SPDX-License-Identifier: GPL-3.0-or-later
#include "caps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "cloth_patches.h"
#include "disjoint_sets.h"
#include "lids_and_fillings.h"
#include "quantile.h"
#include "surface_measures.h"
#include "tuning.h"
#include "used_vertices.h"
#include "weld.h"

namespace garmentfit {

using namespace garment_tuning;

Caps::Caps(const GarmentMesh& garment) : Caps(garment, Weld(garment)) { }

Caps::Caps(const GarmentMesh& garment, const Weld& weld) :
    positions_(weld.gather(garment.positions)),
    faces_(garment.triangles.unaryExpr([&](int v) { return weld.cloth_vertex(v); })),
    topology_(faces_, int(positions_.rows())), patches_(patches_of(topology_, int(faces_.rows()))),
    smallest_girth_(k_cap_girth * diagonal(garment.positions))
{
    collect_areas();
    mark_closed_faces();
    collect_regions();
    for (int side = 0; side < 3 * int(faces_.rows()); ++side)
        add_to_outline(side, regions_[region_of_[side / 3]]);
}

std::vector<std::vector<int>> Caps::find()
{
    std::vector<std::vector<int>> caps = find_fans();
    for (const std::vector<int>& fan : caps)
        for (const int f : fan)
            regions_[region_of_[f]].is_taken = true;
    const auto add
        = [&](const std::vector<std::vector<int>>& more) { caps.insert(caps.end(), more.begin(), more.end()); };
    add(find_steep());
    add(find_filled(caps));
    return caps;
}

std::vector<std::vector<int>> Caps::find_fans()
{
    std::vector<std::vector<int>> faces_at(std::size_t(positions_.rows())), fans;
    for (int f = 0; f < int(faces_.rows()); ++f)
        for (const int v : faces_.row(f))
            faces_at[v].push_back(f);
    for (int v = 0; v < int(faces_at.size()); ++v) {
        const std::vector<int>& faces = faces_at[v];
        if (faces.size() < k_funnel_faces)
            continue;
        const Region fan = region_with(faces);
        if (is_funnel(fan, v)) {
            fans.push_back(faces);
            continue;
        }
        if (faces.size() < k_fan_faces)
            continue;
        const bool is_even = std::all_of(faces.begin(), faces.end(), [&](int f) {
            return std::abs(areas_[f].stableNormalized().dot(fan.area.stableNormalized())) > k_fan_cosine;
        });
        // necks lie in the cloth around, cuffs are crumpled; cloth without any opening has them all the same
        if (is_closed_[faces[0]] ? is_hole(fan, k_fill_depth) : is_even && is_flat_disc(fan, k_fan_depth))
            fans.push_back(faces);
    }
    return fans;
}

bool Caps::is_funnel(const Region& fan, int apex) const
{
    if (!is_hole(fan, k_funnel_depth) || roundness_of(fan) < k_funnel_roundness)
        return false;
    const std::vector<int> vertices = used_vertices(faces_(fan.faces, Eigen::all));
    const Vec3 middle = (positions_(vertices, Eigen::all).colwise().sum() - positions_.row(apex)).transpose()
        / double(vertices.size() - 1);
    const Vec3 down = positions_.row(apex).transpose() - middle;
    const double depth = down.dot(fan.area.normalized());
    if (std::abs(depth) < k_funnel_sunk * std::sqrt(fan.area.norm()))
        return false;
    const Vec3 inwards = depth * fan.area;  // of which only the direction counts
    int near = 0, inside = 0;  // vertices of the cloth around
    for (Eigen::Index v = 0; v < positions_.rows(); ++v) {
        const Vec3 away = positions_.row(v).transpose() - middle;
        if (away.norm() > k_funnel_reach * fan.girth || std::binary_search(vertices.begin(), vertices.end(), int(v)))
            continue;
        ++near;
        inside += away.dot(inwards) > 0;
    }
    return inside > k_funnel_inside * near;
}

std::vector<std::vector<int>> Caps::find_filled(const std::vector<std::vector<int>>& caps)
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
    std::vector<std::vector<int>> filled;
    for (std::vector<int>& region : joined.groups())
        if (std::any_of(region.begin(), region.end(), [&](int f) { return is_seed[f]; })
            && is_filled(region_with(region)))
            filled.push_back(std::move(region));
    return filled;
}

bool Caps::is_filled(const Region& region) const
{
    if (region.faces.size() < k_fill_faces || !is_hole(region, k_fill_depth)
        || !is_without_inner_vertices(topology_, region.faces))
        return false;
    const bool is_sure = region.faces.size() >= k_fan_faces && roundness_of(region) > k_fill_roundness;
    return is_sure || is_closed_[region.faces[0]];
}

std::vector<double> Caps::usual_lengths(const std::vector<double>& lengths) const
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

double Caps::length_of(int side) const
{
    return (positions_.row(faces_(side / 3, side % 3)) - positions_.row(faces_(side / 3, (side % 3 + 1) % 3))).norm();
}

bool Caps::is_ear(int side) const
{
    const Vec3 a = positions_.row(faces_(side / 3, side % 3)), b = positions_.row(faces_(side / 3, (side % 3 + 1) % 3)),
               apex = positions_.row(faces_(side / 3, (side % 3 + 2) % 3));
    return (a - apex).dot(b - apex) < 0;
}

Caps::Region Caps::region_with(const std::vector<int>& faces)
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

std::vector<std::vector<int>> Caps::find_steep() const
{
    std::vector<char> is_candidate(regions_.size());
    for (std::size_t r = 0; r < regions_.size(); ++r)
        is_candidate[r] = is_flat_disc(regions_[r], k_cap_depth)
            && regions_[r].steep > k_cap_outline * regions_[r].girth
            && regions_[r].open < k_cap_border * regions_[r].girth;
    std::vector<std::vector<int>> caps;
    for (std::size_t r = 0; r < regions_.size(); ++r)  // the sides of a block are next to each other
        if (is_candidate[r] && std::none_of(regions_[r].next_to.begin(), regions_[r].next_to.end(), [&](int other) {
                return is_candidate[other];
            }))
            caps.push_back(regions_[r].faces);
    return caps;
}

void Caps::collect_areas()
{
    for (Eigen::Index f = 0; f < faces_.rows(); ++f)
        areas_.push_back(area_vector(positions_, faces_, f));
}

void Caps::mark_closed_faces()
{
    is_closed_.assign(std::size_t(faces_.rows()), is_closed());
    std::vector<char> is_at_opening(std::size_t(faces_.rows()), 0);
    for (const std::vector<int>& loop : topology_.border_loops()) {
        if (loop.size() < 2)  // a single edge between faces that are turned round: it leads to no other one
            continue;
        const int side = topology_.sides_at(topology_.edge_between(loop[0], loop[1]))[0];
        is_at_opening[side / 3] = girth_of(positions_, loop) > smallest_girth_;
    }
    double whole = 0;  // m^2
    for (const Vec3& area : areas_)
        whole += area.norm();
    for (const std::vector<int>& patch : patches_) {
        double area = 0;  // m^2
        for (const int f : patch)
            area += areas_[f].norm();
        if (2 * area > whole && std::none_of(patch.begin(), patch.end(), [&](int f) { return is_at_opening[f]; }))
            for (const int f : patch)
                is_closed_[f] = 1;
    }
}

double Caps::orientation(int side, int other) const
{
    return faces_(side / 3, side % 3) == faces_(other / 3, other % 3) ? -1 : 1;
}

void Caps::collect_regions()
{
    DisjointSets flat(int(faces_.rows()));
    for (int side = 0; side < 3 * int(faces_.rows()); ++side)
        if (const int other = topology_.opposite(side);
            other > side && orientation(side, other) * cosine(side / 3, other / 3) > k_flat_cosine)
            flat.join(side / 3, other / 3);
    region_of_.resize(std::size_t(faces_.rows()));
    for (std::vector<int>& faces : flat.groups()) {
        for (const int f : faces)
            region_of_[f] = int(regions_.size());
        regions_.emplace_back().faces = std::move(faces);
    }
    for (Region& region : regions_)
        add_areas(region);
}

void Caps::add_areas(Region& region) const
{
    std::map<int, double> sign;  // of the faces of the region, as they are oriented to its first one; 0 if unknown
    for (const int f : region.faces)
        sign[f] = 0;
    std::vector<int> open;
    const auto reach = [&](int f, double orientation) {
        sign[f] = orientation;
        region.area += orientation * areas_[f];
        open.push_back(f);
    };
    for (const int first : region.faces) {
        if (sign[first] == 0)
            reach(first, areas_[first].dot(region.area) < 0 ? -1 : 1);
        while (!open.empty()) {
            const int f = open.back();
            open.pop_back();
            for (int side = 3 * f; side < 3 * f + 3; ++side)
                if (const int other = topology_.opposite(side); other >= 0)
                    if (const auto next = sign.find(other / 3); next != sign.end() && next->second == 0)
                        reach(next->first, sign[f] * orientation(side, other));
        }
    }
}

void Caps::add_to_outline(int side, Region& region) const
{
    const int f = side / 3, other = topology_.opposite(side);
    if (other >= 0 && region_of_[other / 3] == region_of_[f])
        return;
    const Vec3 a = positions_.row(faces_(f, side % 3)), b = positions_.row(faces_(f, (side % 3 + 1) % 3));
    const double length = (b - a).norm();
    region.girth += length;
    if (other < 0) {
        region.open += length;
        return;
    }
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

bool Caps::is_flat_disc(const Region& region, double depth) const
{
    return std::abs(region.side) > k_fan_outline * region.girth && is_hole(region, depth);
}

bool Caps::is_hole(const Region& region, double depth) const
{
    return !region.is_taken && region.girth > smallest_girth_ && roundness_of(region) > k_cap_roundness
        && is_disc(region) && is_flat(region, depth);
}

double Caps::roundness_of(const Region& region)
{
    return 4 * std::numbers::pi * region.area.norm() / (region.girth * region.girth);
}

bool Caps::is_disc(const Region& region) const
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

bool Caps::is_flat(const Region& region, double depth) const
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

}  // namespace garmentfit
