// SPDX-License-Identifier: GPL-3.0-or-later
#include "hollows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "cloth_patches.h"
#include "disjoint_sets.h"
#include "nearest.h"
#include "parallel.h"
#include "quantile.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr int k_rays = 24;  // unit: directions across an axis
constexpr double k_most_steps = 500;  // unit: of blurring; bounds the work on what has hardly an area
constexpr double k_off = 1e-4;  // unit: share of the diagonal, so that a ray does not start on its own face

/// Evenly round an axis, across it.
std::array<Vec3, k_rays> directions_across(const Vec3& axis)
{
    const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
    std::array<Vec3, k_rays> result;
    for (int i = 0; i < k_rays; ++i) {
        const double angle = 2 * std::numbers::pi * i / k_rays;
        result[i] = std::cos(angle) * u + std::sin(angle) * v;
    }
    return result;
}

/// A part of the solid's surface.
struct Part {
    std::vector<int> faces;
    double area = 0;  // m^2
    Vec3 middle = Vec3::Zero();
    Vec3 axis = Vec3::Zero();  // unit, out of the hollow
};

class Solid {
public:
    Solid(const TriangleMesh& mesh, const std::vector<int>& outside) :
        tree_(mesh), outer_(fill_openings({ mesh.positions, mesh.triangles(outside, Eigen::all) })),
        topology_(mesh.triangles, int(mesh.positions.rows())), diagonal_(diagonal(mesh.positions)), outside_(outside),
        is_outside_(std::size_t(mesh.triangles.rows()))
    {
        for (const int f : outside)
            is_outside_[f] = 1;
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
            areas_.push_back(area_vector(mesh.positions, mesh.triangles, f));
            middles_.push_back(mesh.positions(mesh.triangles.row(f), Eigen::all).colwise().mean());
        }
        collect_directions();
    }

    std::vector<Hollow> hollows() const
    {
        std::vector<Hollow> result;
        for (Found& found : find_hollows(k_hollow_length))
            result.push_back(std::move(found.hollow));
        return result;
    }

    std::vector<Hollow> all_ends() const
    {
        std::vector<Found> ends = find_hollows(k_filled_length);
        add_flush_ends(ends);
        if (ends.size() < k_least_ends)
            return hollows();
        drop_narrow(ends);
        std::vector<Hollow> result;
        for (Found& found : ends)
            result.push_back(std::move(found.hollow));
        return result;
    }

private:
    struct Found {
        Hollow hollow;
        double share = 0;  // of the solid's cross-section behind it
    };

    static bool is_narrow(const Found& found) { return found.share < k_narrow_share; }

    /// @param least  length of the tubes behind them, in widths
    std::vector<Found> find_hollows(double least) const
    {
        std::vector<Found> result;
        for (const Part& floor : floors()) {
            const Tube tube = tube_behind(floor);
            if (!(tube.length > least * tube.width))  // or none was measured
                continue;
            const std::vector<int> faces = up_to_rim(floor);
            if (!is_end_of(tube, faces) || !(fills(tube, faces) || is_clear_end(tube, floor, faces)))
                continue;
            Hollow hollow = without_sheets(floor, faces);
            if (!hollow.floor.empty())
                result.push_back({ std::move(hollow), share_of(tube, faces) });
        }
        return joined(std::move(result));
    }

    /// With those that share faces as one: a neck lies in its hood.
    std::vector<Found> joined(std::vector<Found> all) const
    {
        std::vector<int> first(areas_.size(), -1);  // by face, the number of the first hollow that has it
        DisjointSets same(int(all.size()));
        for (int i = 0; i < int(all.size()); ++i)
            for (const auto* faces : { &all[i].hollow.floor, &all[i].hollow.walls })
                for (const int f : *faces)
                    if (first[f] < 0)
                        first[f] = i;
                    else
                        same.join(first[f], i);
        std::vector<Found> result;
        for (const std::vector<int>& group : same.groups()) {
            Found found;
            for (const int i : group) {
                found.share = std::max(found.share, all[i].share);
                found.hollow.floor = united(found.hollow.floor, all[i].hollow.floor);
                found.hollow.walls = united(found.hollow.walls, all[i].hollow.walls);
            }
            std::vector<int> walls;
            std::set_difference(found.hollow.walls.begin(), found.hollow.walls.end(), found.hollow.floor.begin(),
                                found.hollow.floor.end(), std::back_inserter(walls));
            found.hollow.walls = std::move(walls);
            result.push_back(std::move(found));
        }
        return result;
    }

    static std::vector<int> united(const std::vector<int>& one, const std::vector<int>& other)
    {
        std::vector<int> result;
        std::set_union(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(result));
        return result;
    }

    /// The rims of hollows that are no folds are none.
    void add_flush_ends(std::vector<Found>& ends) const
    {
        std::vector<char> is_in_hollow(areas_.size());
        for (const Found& found : ends)
            if (!is_narrow(found))
                for (const auto* faces : { &found.hollow.floor, &found.hollow.walls })
                    for (const int f : *faces)
                        is_in_hollow[f] = 1;
        const auto is_at_hollow = [&](int f) {
            for (int side = 3 * f; side < 3 * f + 3; ++side)
                if (const int other = topology_.opposite(side); other >= 0 && is_in_hollow[other / 3])
                    return true;
            return false;
        };
        for (Part& end : flush_ends()) {
            const Tube tube = tube_behind(end);
            const double share = share_of(tube, end.faces);
            if (is_long(tube) && is_end_of(tube, end.faces) && share > k_flush_least && share < k_flush_most
                && std::none_of(end.faces.begin(), end.faces.end(), is_at_hollow))
                ends.push_back({ { std::move(end.faces), {} }, share });
        }
    }

    /// Area vectors blurred over the surface: of a floor with a fan, or of a funnel, the axis.
    void collect_directions()
    {
        double whole = 0;  // m^2
        for (const Vec3& area : areas_)
            whole += area.norm();
        // derived: a step of equal weights spreads by about the distance between the middles of neighbours, 2/3 of the
        // square root of a face's area; spreads add up as squares
        const double step = whole / double(areas_.size()) / 2;
        const int steps = int(std::min(std::ceil(std::pow(k_hollow_blur * diagonal_, 2) / step), k_most_steps));
        directions_ = areas_;
        for (int i = 0; i < steps; ++i) {
            std::vector<Vec3> next = directions_;
            for (int side = 0; side < 3 * int(areas_.size()); ++side)
                if (const int other = topology_.opposite(side); other >= 0)
                    next[side / 3] += directions_[other / 3];
            for (std::size_t f = 0; f < next.size(); ++f)
                directions_[f] = next[f] / 4;
        }
        for (Vec3& direction : directions_)
            direction.stableNormalize();
    }

    bool leaves(const Vec3& from, const Vec3& direction) const
    {
        return !tree_.is_met(from, from + diagonal_ * direction);
    }

    /// Whether no more than `most` of the rays across an axis go out, and on no more than so many sides.
    bool is_enclosed(const Vec3& from, const Vec3& axis, int most, int most_sides) const
    {
        std::array<char, k_rays> is_out {};
        int out = 0, sides = 0;
        const auto directions = directions_across(axis);
        for (int i = 0; i < k_rays; ++i)
            if ((is_out[i] = leaves(from, directions[i])) && ++out > most)
                return false;
        for (int i = 0; i < k_rays; ++i)
            sides += is_out[i] && !is_out[(i + 1) % k_rays];
        return sides <= most_sides;
    }

    /// Whether no more than `most` of the rays from above a face go out, all of them on one side: between legs some go
    /// out in front and some behind.
    bool is_floor(int f, int most) const
    {
        return directions_[f].dot(areas_[f].stableNormalized()) > k_hollow_floor
            && std::any_of(k_hollow_heights.begin(), k_hollow_heights.end(), [&](double height) {
                   return is_enclosed(middles_[f] + height * diagonal_ * directions_[f], directions_[f], most, 1);
               });
    }

    Part part_of(std::vector<int> faces) const
    {
        Part part { std::move(faces) };
        Vec3 axis = Vec3::Zero();
        for (const int f : part.faces) {
            const double area = areas_[f].norm();
            part.area += area;
            part.middle += area * middles_[f];
            axis += area * directions_[f];
        }
        part.middle /= part.area;
        part.axis = axis.stableNormalized();
        return part;
    }

    /// Connected faces among those marked, in the order of their first ones.
    std::vector<std::vector<int>> connected(const std::vector<char>& is_marked) const
    {
        DisjointSets joined(int(is_marked.size()));
        for (int side = 0; side < 3 * int(is_marked.size()); ++side)
            if (const int other = topology_.opposite(side); other >= 0 && is_marked[side / 3] && is_marked[other / 3])
                joined.join(side / 3, other / 3);
        std::vector<std::vector<int>> groups = joined.groups();
        std::erase_if(groups, [&](const std::vector<int>& group) { return !is_marked[group.front()]; });
        return groups;
    }

    /// Somewhere in a floor (next to) no ray goes out; elsewhere it may be open on one side, as a neck is in front.
    std::vector<Part> floors() const
    {
        std::vector<char> is_marked(areas_.size()), is_deep(areas_.size());
        parallel_for<std::size_t>(
            outside_.size(),
            [&](std::size_t i) {
                const int f = outside_[i];
                is_marked[f] = is_floor(f, k_rays_out_of_floor);
                is_deep[f] = is_marked[f] && is_floor(f, k_rays_out_of_deep_floor);
            },
            64);  // unit: grain of the parallel loop
        std::vector<Part> result;
        for (std::vector<int>& faces : connected(is_marked)) {
            const bool has_deep = std::any_of(faces.begin(), faces.end(), [&](int f) { return is_deep[f]; });
            Part part = part_of(std::move(faces));
            if (has_deep && part.area > k_least_floor * diagonal_ * diagonal_)
                result.push_back(std::move(part));
        }
        return result;
    }

    /// m, through the solid, or through the inside of a garment that is open elsewhere
    double chord(const Vec3& from, const Vec3& direction) const
    {
        const auto hit = outer_.first_hit(from, direction);
        return hit ? hit->distance : 0;
    }

    /// Whether the other side of the cloth, which faces away, is close behind.
    bool is_sheet(int f) const
    {
        const Vec3 inwards = -areas_[f].stableNormalized();
        const auto hit = outer_.first_hit(middles_[f] + k_off * diagonal_ * inwards, inwards);
        return hit && hit->distance < k_hollow_backing * diagonal_ && hit->cosine > k_hollow_back_cosine;
    }

    /// How far the solid goes on behind a floor, and how wide it is there; m.
    struct Tube {
        double length = 0, width = 0;
    };

    Tube tube_behind(const Part& floor) const
    {
        std::vector<int> samples;
        for (const int f : floor.faces)
            if (areas_[f].stableNormalized().dot(floor.axis) > k_hollow_facing)
                samples.push_back(f);
        if (samples.empty())
            return {};
        const std::size_t step = 1 + samples.size() / k_hollow_samples;
        const auto across = directions_across(floor.axis);
        const auto chord_of = [&](double share, const Vec3& direction, double depth) {
            std::vector<double> chords;
            for (std::size_t i = 0; i < samples.size(); i += step)
                chords.push_back(chord(middles_[samples[i]] - depth * floor.axis, direction));
            return quantile(chords, share);
        };
        const auto length_along
            = [&](const Vec3& direction) { return chord_of(k_hollow_chord, direction, k_off * diagonal_); };
        double length = length_along(-floor.axis);
        const double depth = std::min(k_hollow_depth * diagonal_, length / 2);
        double width = 0;
        for (const Vec3& direction : across)
            width += 2.0 / k_rays * chord_of(0.5, direction, depth);
        for (const Vec3& direction : across)
            length = std::max(length,
                              length_along(std::sin(k_hollow_tilt) * direction - std::cos(k_hollow_tilt) * floor.axis));
        return { length, width };
    }

    /// Whether some faces are as round as an end, and fill it: behind a fold the solid is far wider.
    bool is_end_of(const Tube& tube, const std::vector<int>& faces) const
    {
        Vec3 sum = Vec3::Zero();
        double area = 0;  // m^2
        Positions places(Eigen::Index(faces.size()), 3);
        for (std::size_t i = 0; i < faces.size(); ++i) {
            sum += areas_[faces[i]];
            area += areas_[faces[i]].norm();
            places.row(Eigen::Index(i)) = middles_[faces[i]];
        }
        const Vec3 axis = sum.stableNormalized();
        places -= (places * axis * axis.transpose()).eval();
        const Vec3 spreads = squared_extents(places);
        return spreads[1] > k_hollow_roundness * k_hollow_roundness * spreads[2]
            && area > k_least_hollow * diagonal_ * diagonal_
            && area > k_hollow_share * std::numbers::pi / 4 * tube.width * tube.width;
    }

    /// Share of a disc as wide as the solid behind some faces that they have.
    double share_of(const Tube& tube, const std::vector<int>& faces) const
    {
        return area(areas_, faces) / (std::numbers::pi / 4 * tube.width * tube.width);
    }

    /// Whether some faces are most of the solid's cross-section: folds are a small part of it.
    bool fills(const Tube& tube, const std::vector<int>& faces) const
    {
        const double share = share_of(tube, faces);
        return share > k_filled_share && share < k_flush_most;
    }

    /// Whether a hollow ends a long tube, and is no fold with a spot of a floor.
    bool is_clear_end(const Tube& tube, const Part& floor, const std::vector<int>& faces) const
    {
        return is_long(tube) && floor.area > k_hollow_bottom * area(areas_, faces);
    }

    static bool is_long(const Tube& tube) { return tube.length > k_hollow_length * tube.width; }

    /// Beside all ends of a garment, what is far narrower than the solid behind it is a fold.
    static void drop_narrow(std::vector<Found>& ends)
    {
        if (ends.size() - std::size_t(std::count_if(ends.begin(), ends.end(), is_narrow)) >= k_least_ends)
            std::erase_if(ends, is_narrow);
    }

    /// The faces connected with one that look along an axis, near to the plane across it.
    Part facing(const Vec3& axis, const Vec3& middle, double least, int seed) const
    {
        std::vector<char> is_taken(areas_.size());
        std::vector<int> faces { seed };
        is_taken[seed] = 1;
        for (std::size_t i = 0; i < faces.size(); ++i)
            for (int side = 3 * faces[i]; side < 3 * faces[i] + 3; ++side) {
                const int other = topology_.opposite(side);
                if (other < 0 || is_taken[other / 3] || !is_outside_[other / 3]
                    || areas_[other / 3].stableNormalized().dot(axis) < least
                    || std::abs((middles_[other / 3] - middle).dot(axis)) > k_flush_edge * diagonal_)
                    continue;
                is_taken[other / 3] = 1;
                faces.push_back(other / 3);
            }
        return part_of(std::move(faces));
    }

    /// Whether the surface goes back all round an end, at once: behind each place of its outline it looks away from the
    /// end, across its axis.
    bool has_edge(const Part& end) const
    {
        std::vector<char> is_of_end(areas_.size());
        for (const int f : end.faces)
            is_of_end[f] = 1;
        int outline = 0, steep = 0;
        for (const int f : end.faces)
            for (int side = 3 * f; side < 3 * f + 3; ++side) {
                const int other = topology_.opposite(side);
                if (other < 0 || is_of_end[other / 3])
                    continue;
                ++outline;
                steep += is_steep_behind(other / 3, end, is_of_end);
            }
        return outline > 0 && steep > k_flush_outline * outline;
    }

    bool is_steep_behind(int start, const Part& end, const std::vector<char>& is_of_end) const
    {
        const double reach = k_flush_edge * diagonal_;
        std::vector<int> near { start };
        for (std::size_t i = 0; i < near.size(); ++i) {
            const Vec3 normal = areas_[near[i]].stableNormalized(), away = middles_[near[i]] - end.middle;
            const Vec3 outwards = (away - away.dot(end.axis) * end.axis).stableNormalized();
            if (normal.dot(end.axis) < k_flush_steep && normal.dot(outwards) > 0 && away.dot(end.axis) < 0)
                return true;
            for (int side = 3 * near[i]; side < 3 * near[i] + 3; ++side)
                if (const int other = topology_.opposite(side); other >= 0 && !is_of_end[other / 3]
                    && (middles_[other / 3] - middles_[start]).norm() < reach
                    && std::find(near.begin(), near.end(), other / 3) == near.end())
                    near.push_back(other / 3);
        }
        return false;
    }

    /// Flat ends without a hollow, up to where the surface goes back.
    std::vector<Part> flush_ends() const
    {
        std::vector<char> is_seen(areas_.size());
        std::vector<Part> result;
        for (const int seed : outside_) {
            if (is_seen[seed] || directions_[seed].dot(areas_[seed].stableNormalized()) < k_flush_flat)
                continue;
            Part end = facing(directions_[seed], middles_[seed], k_flush_facing, seed);
            end = facing(end.axis, end.middle, k_flush_facing, seed);
            for (const int f : end.faces)
                is_seen[f] |= directions_[f].dot(directions_[seed]) > k_flush_flat;
            if (end.area < k_least_floor * diagonal_ * diagonal_ || !has_edge(end))
                continue;
            end = facing(end.axis, end.middle, k_flush_steep, seed);
            for (const int f : end.faces)
                is_seen[f] = 1;
            result.push_back(std::move(end));
        }
        return result;
    }

    /// Of the connected faces among those marked the part with most of a floor's faces; none without any.
    std::vector<int> part_at(const Part& floor, const std::vector<char>& is_marked) const
    {
        std::vector<char> is_of_floor(areas_.size());
        for (const int f : floor.faces)
            is_of_floor[f] = 1;
        const auto count = [&](const std::vector<int>& faces) {
            return std::count_if(faces.begin(), faces.end(), [&](int f) { return is_of_floor[f]; });
        };
        std::vector<std::vector<int>> parts = connected(is_marked);
        const auto most = std::max_element(
            parts.begin(), parts.end(), [&](const auto& one, const auto& other) { return count(one) < count(other); });
        return most == parts.end() || count(*most) == 0 ? std::vector<int>() : std::move(*most);
    }

    /// Whether a face looks out of the hollow or at its axis, below the rim.
    bool is_in_hollow(int f, const Part& floor) const
    {
        const double reach = 3 * std::sqrt(floor.area / std::numbers::pi) + k_hollow_reach * diagonal_;
        const Vec3 away = middles_[f] - floor.middle, normal = areas_[f].stableNormalized();
        if (!is_outside_[f] || away.norm() > reach)
            return false;
        const Vec3 outwards = (away - away.dot(floor.axis) * floor.axis).stableNormalized();
        return normal.dot(floor.axis) > normal.dot(outwards)
            && is_enclosed(middles_[f] + k_hollow_heights[0] / 2 * diagonal_ * normal, floor.axis, k_rays_out_of_hollow,
                           k_rays);
    }

    std::vector<int> up_to_rim(const Part& floor) const
    {
        std::vector<char> is_marked(areas_.size());
        for (const int f : floor.faces)
            is_marked[f] = 1;
        parallel_for<int>(
            int(areas_.size()), [&](int f) { is_marked[f] |= is_in_hollow(f, floor); },
            64);  // unit: grain of the parallel loop
        return part_at(floor, is_marked);
    }

    Hollow without_sheets(const Part& floor, const std::vector<int>& faces) const
    {
        std::vector<char> is_marked(areas_.size());
        for (const int f : faces)
            is_marked[f] = !is_sheet(f);
        Hollow hollow { part_at(floor, is_marked), {} };
        std::set_difference(faces.begin(), faces.end(), hollow.floor.begin(), hollow.floor.end(),
                            std::back_inserter(hollow.walls));
        return hollow;
    }

    TriangleTree tree_, outer_;
    MeshTopology topology_;
    double diagonal_;  // m
    const std::vector<int>& outside_;
    std::vector<char> is_outside_;
    std::vector<Vec3> areas_, middles_, directions_;  // by face
};

}  // namespace

std::vector<Hollow> find_hollows(const TriangleMesh& solid, const std::vector<int>& outside)
{
    return Solid(solid, outside).hollows();
}

std::vector<Hollow> find_solid_ends(const TriangleMesh& solid, const std::vector<int>& outside)
{
    return Solid(solid, outside).all_ends();
}

}  // namespace garmentfit
