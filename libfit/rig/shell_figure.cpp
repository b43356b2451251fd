// SPDX-License-Identifier: GPL-3.0-or-later
#include "shell_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "disjoint_sets.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

// literature: [deleva_1996_segments], shares of a limb from the trunk to its tip.
constexpr double k_elbow_at = 0.37, k_wrist_at = 0.74, k_knee_at = 0.46, k_ankle_at = 0.92;
// literature: as in figure_graph.cpp, but between the shells: arms and trunk to the legs.
constexpr double k_arm_to_leg = 0.8, k_trunk_to_leg = 0.7;

constexpr double k_no_angle = 1e-6;  // unit: rad

double squared(double x) { return x * x; }

/// A shell, or several that lie in each other.
struct Part {
    Eigen::AlignedBox3d box;
    std::vector<int> vertices;

    double width(int axis) const { return box.sizes()[axis]; }
    double volume() const { return box.volume(); }
};

/// Vertices at one place get one number.
std::vector<int> number_places(const Positions& positions)
{
    std::map<std::array<double, 3>, int> first_at;
    std::vector<int> numbers;
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
        numbers.push_back(
            first_at.try_emplace({ positions(v, 0), positions(v, 1), positions(v, 2) }, int(v)).first->second);
    return numbers;
}

/// A triangle at an edge.
struct Side {
    int triangle;
    bool forwards;  ///< runs along the edge from the smaller number to the larger one
    Vec3 normal, inwards;  ///< unit; from the edge into the triangle
};

/// Angle of the solid between two triangles at an edge, rad. Triangles that lie on each other have none between them.
double angle_within(const Side& one, const Side& other)
{
    const double angle = std::atan2(-other.inwards.dot(one.normal), other.inwards.dot(one.inwards));
    return angle < k_no_angle ? angle + 2 * std::numbers::pi : angle;
}

/// The other side of the smallest solid at an edge, or -1. Blocks that touch share edges, but no solid.
int across(const std::vector<Side>& sides, int one)
{
    int best = -1;
    double least = std::numeric_limits<double>::max();
    for (int other = 0; other < int(sides.size()); ++other)
        if (sides[other].forwards != sides[one].forwards)
            if (const double angle = angle_within(sides[one], sides[other]); angle < least) {
                least = angle;
                best = other;
            }
    return best;
}

using Edges = std::map<std::pair<int, int>, std::vector<Side>>;

Edges edges_of(const TriangleMesh& surface, const std::vector<int>& places)
{
    Edges edges;
    for (int f = 0; f < int(surface.triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto corner = [&](int i) { return surface.triangles(f, (k + i) % 3); };
            const int a = places[corner(0)], b = places[corner(1)];
            const auto at = [&](int i) -> Vec3 { return surface.positions.row(corner(i)); };
            const Vec3 along = (at(1) - at(0)).normalized(), to = at(2) - at(0);
            const Vec3 inwards = (to - to.dot(along) * along).normalized();
            if (a != b && inwards.allFinite())
                edges[std::minmax(a, b)].push_back({ f, a < b, along.cross(inwards), inwards });
        }
    return edges;
}

/// Triangles that share an edge are one shell; where more than two do, the two that are each other's nearest about a
/// solid. Vertices without triangles are in none.
std::vector<Part> shells_of(const TriangleMesh& surface)
{
    DisjointSets sets(int(surface.triangles.rows()));
    for (const auto& [edge, sides] : edges_of(surface, number_places(surface.positions)))
        for (int one = 0; one < int(sides.size()); ++one) {
            const int other = sides.size() == 2 ? 1 - one : across(sides, one);
            if (other >= 0 && (sides.size() == 2 || across(sides, other) == one))
                sets.join(sides[one].triangle, sides[other].triangle);
        }
    std::map<int, Part> by_root;
    std::vector<bool> taken(std::size_t(surface.positions.rows()), false);
    for (int f = 0; f < int(surface.triangles.rows()); ++f) {
        Part& part = by_root[sets.root(f)];
        for (const int v : surface.triangles.row(f)) {
            part.box.extend(surface.positions.row(v).transpose());
            if (!taken[v])
                part.vertices.push_back(v);
            taken[v] = true;
        }
    }
    std::vector<Part> shells;
    for (auto& [root, part] : by_root)
        if (!part.vertices.empty())
            shells.push_back(std::move(part));
    return shells;
}

/// Makes boxes of sheets solid, so that shares of their volumes are numbers.
Eigen::AlignedBox3d padded(Eigen::AlignedBox3d box, double by)
{
    box.min().array() -= by;
    box.max().array() += by;
    return box;
}

/// Adds a part to an earlier one.
void join(std::vector<Part>& parts, std::size_t one, std::size_t other)
{
    parts[one].box.extend(parts[other].box);
    parts[one].vertices.insert(parts[one].vertices.end(), parts[other].vertices.begin(), parts[other].vertices.end());
    parts.erase(parts.begin() + std::ptrdiff_t(other));
}

/// Joins those of which one lies mostly in the other, until none does.
void join_nested(std::vector<Part>& parts, double padding)
{
    for (bool joined = true; joined;) {
        joined = false;
        for (std::size_t a = 0; a < parts.size() && !joined; ++a)
            for (std::size_t b = a + 1; b < parts.size() && !joined; ++b) {
                const Eigen::AlignedBox3d one = padded(parts[a].box, padding), other = padded(parts[b].box, padding);
                const Eigen::AlignedBox3d common = one.intersection(other);
                if (common.isEmpty() || common.volume() < k_nested_share * std::min(one.volume(), other.volume()))
                    continue;
                join(parts, a, b);
                joined = true;
            }
    }
}

/// Whether one part is about where the mirror image of the other is, and as large.
bool are_twins(const Part& one, const Part& other, double middle, double size)
{
    Vec3 mirrored = other.box.center();
    mirrored.x() = 2 * middle - mirrored.x();
    const Eigen::Array3d sizes = padded(one.box, k_shell_padding * size).sizes(),
                         others = padded(other.box, k_shell_padding * size).sizes();
    return (one.box.center() - mirrored).norm() < k_twin_distance * size
        && (sizes / others).log().abs().maxCoeff() < k_twin_size;
}

/// Which parts have a twin on the other side of a middle, or lie across it.
std::vector<bool> find_matched(const std::vector<Part>& parts, double middle, double size)
{
    std::vector<bool> matched;
    for (const Part& part : parts)
        matched.push_back((part.box.min().x() < middle && part.box.max().x() > middle)
                          || std::any_of(parts.begin(), parts.end(), [&](const Part& other) {
                                 return &other != &part && are_twins(part, other, middle, size);
                             }));
    return matched;
}

/// Takes out what has no twin on the other side, such as a weapon in a hand. The middle is that of the part about which
/// most have one.
std::vector<Part> take_held(std::vector<Part>& parts, double size)
{
    std::vector<bool> best;
    for (const Part& part : parts) {
        const std::vector<bool> matched = find_matched(parts, part.box.center().x(), size);
        if (std::count(matched.begin(), matched.end(), true) > std::count(best.begin(), best.end(), true))
            best = matched;
    }
    const std::vector<Part> all = std::exchange(parts, {});
    std::vector<Part> held;
    for (std::size_t p = 0; p < all.size(); ++p)
        (best[p] ? parts : held).push_back(all[p]);
    return held;
}

/// Which curve a part belongs to beside this trunk: arms 0, 1 and legs 2, 3, the first of each at +x.
int curve_beside(const Part& trunk, const Part& part)
{
    const Vec3 off = part.box.center() - trunk.box.center();
    const double half_width = 0.5 * trunk.width(0), half_height = 0.5 * trunk.width(1);
    const int side = off.x() > 0 ? 0 : 1;
    if (std::abs(off.x()) > k_beside_trunk * half_width)
        return off.y() > -k_arm_below_trunk * half_height ? side : 2 + side;
    const double least_out = k_out_of_trunk * part.width(1);
    if (part.box.max().y() - trunk.box.max().y() > least_out)
        return k_head_curve;
    if (trunk.box.min().y() - part.box.min().y() > least_out && std::abs(off.x()) > k_leg_off_middle * half_width)
        return 2 + side;
    return k_trunk_curve;
}

using Places = std::vector<Vec3>;

/// The mean of the places that are farthest along a direction, within a share of their extent.
Vec3 end_along(const Places& places, const Vec3& direction)
{
    double least = places.front().dot(direction), most = least;
    for (const Vec3& p : places) {
        least = std::min(least, p.dot(direction));
        most = std::max(most, p.dot(direction));
    }
    Eigen::AlignedBox3d box;
    for (const Vec3& p : places)
        if (p.dot(direction) >= most - k_end_of_part * (most - least))
            box.extend(p);
    Vec3 end = box.center();
    return end + (most - end.dot(direction)) * direction;
}

double extent_along(const Places& places, const Vec3& direction)
{
    double least = places.front().dot(direction), most = least;
    for (const Vec3& p : places) {
        least = std::min(least, p.dot(direction));
        most = std::max(most, p.dot(direction));
    }
    return most - least;
}

/// The axes of a cloud of points, the longest first.
Eigen::Matrix3d axes_of(const Places& places)
{
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : places)
        mean += p / double(places.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vec3& p : places)
        covariance += (p - mean) * (p - mean).transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().rowwise().reverse();
}

LimbJoints straight_limb(const Vec3& root, const Vec3& end, double middle, double last)
{
    LimbJoints limb;
    limb.root = root;
    limb.middle = root + middle * (end - root);
    limb.end = root + last * (end - root);
    limb.tip = end;
    limb.whole = limb.widens = false;
    return limb;
}

struct Limb {
    LimbJoints joints;
    double length = 0, thickness = 0;  ///< m
};

/// From the end that is nearer to where arms leave the trunk, and half as thick as the arm within it.
Limb arm_of(const Places& places, const Vec3& shoulder)
{
    const Eigen::Matrix3d axes = axes_of(places);
    const Vec3 axis = axes.col(0);
    Vec3 from = end_along(places, axis), to = end_along(places, -axis);
    if ((to - shoulder).norm() < (from - shoulder).norm())
        std::swap(from, to);
    Limb arm { {}, (to - from).norm(), 0.5 * (extent_along(places, axes.col(1)) + extent_along(places, axes.col(2))) };
    const double inwards = std::min(0.5 * arm.thickness, k_latest_root * arm.length);
    arm.joints = straight_limb(from + inwards * (to - from).normalized(), to, k_elbow_at, k_wrist_at);
    return arm;
}

Limb leg_of(const Places& places)
{
    const Vec3 top = end_along(places, Vec3::UnitY()), sole = end_along(places, -Vec3::UnitY());
    Limb leg { {}, top.y() - sole.y(), extent_along(places, Vec3::UnitX()) };
    leg.joints = straight_limb(top, { top.x(), sole.y(), top.z() }, k_knee_at, k_ankle_at);
    leg.joints.tip = sole;
    return leg;
}

/// Places of the parts of one curve.
Places places_of(const TriangleMesh& surface, const std::vector<Part>& parts, const std::vector<int>& curves, int curve)
{
    Places places;
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (curves[p] == curve)
            for (const int v : parts[p].vertices)
                places.push_back(surface.positions.row(v));
    return places;
}

double pair_cost(const Limb& one, const Limb& other)
{
    return squared(std::log(one.length / other.length) / k_pair_length_spread)
        + squared(std::log(one.thickness / other.thickness) / k_pair_thickness_spread);
}

/// How far a pair is from being mirrored about the middle of the trunk.
double mirror_cost(const Limb& one, const Limb& other, const Vec3& middle, double size)
{
    const Vec3 a = one.joints.root - middle, b = other.joints.root - middle;
    return squared((a.x() + b.x()) / size / k_pair_fork_spread) + squared((a.y() - b.y()) / size / k_pair_fork_spread);
}

void place_spine(const Eigen::AlignedBox3d& trunk, const Places& head, BodyJoints& joints)
{
    const Vec3 middle = trunk.center();
    const double height = trunk.sizes().y(), top = trunk.max().y();
    joints.pelvis = { middle.x(), joints.legs[0].root.y() + k_pelvis_in_trunk * height, middle.z() };
    joints.neck_base = { middle.x(), top - k_pelvis_in_trunk * height, middle.z() };
    joints.crown = { middle.x(), top, middle.z() };
    joints.skull_base = joints.crown;
    if (!head.empty()) {
        joints.crown = end_along(head, Vec3::UnitY());
        joints.skull_base = end_along(head, -Vec3::UnitY());
        joints.skull_base += k_pelvis_in_trunk * (joints.crown - joints.skull_base);
    }
    joints.mid_neck = 0.5 * (joints.neck_base + joints.skull_base);
    joints.lower_spine = joints.pelvis + (joints.neck_base - joints.pelvis) / 3;
    joints.upper_spine = joints.pelvis + (joints.neck_base - joints.pelvis) * 2 / 3;
}

/// @param held  what hangs on the figure and does not matter to it
std::optional<ShellFigure> figure_about(const TriangleMesh& surface, const std::vector<Part>& parts, std::size_t trunk,
                                        const std::vector<Part>& held)
{
    std::vector<int> curves;
    double rest = 0, all = 0;
    Eigen::AlignedBox3d trunk_box = parts[trunk].box, whole;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        curves.push_back(p == trunk ? k_trunk_curve : curve_beside(parts[trunk], parts[p]));
        all += parts[p].volume();
        whole.extend(parts[p].box);
        if (curves.back() == k_trunk_curve && p != trunk)
            rest += parts[p].volume();
    }
    std::array<Places, k_trunk_curve> places;
    for (int c = 0; c < k_trunk_curve; ++c) {
        places[c] = places_of(surface, parts, curves, c);
        if (c < k_head_curve && places[c].empty())
            return {};
    }
    const Vec3 middle = trunk_box.center();
    std::array<Limb, 2> arms, legs;
    for (const int i : { 0, 1 }) {
        const double out = (i == 0 ? 0.5 : -0.5) * trunk_box.sizes().x();
        arms[i] = arm_of(places[i], { middle.x() + out, trunk_box.max().y(), middle.z() });
        legs[i] = leg_of(places[2 + i]);
    }
    ShellFigure figure;
    BodyJoints& joints = figure.joints;
    joints.arms = { arms[0].joints, arms[1].joints };
    joints.legs = { legs[0].joints, legs[1].joints };
    joints.size = whole.sizes().y();
    place_spine(trunk_box, places[k_head_curve], joints);
    const double leg = 0.5 * (legs[0].length + legs[1].length), arm = 0.5 * (arms[0].length + arms[1].length),
                 hull = joints.neck_base.y() - joints.pelvis.y();
    if (!(std::min({ leg, arm, hull }) > k_shortest_limb * joints.size))
        return {};
    double cost = pair_cost(arms[0], arms[1]) + pair_cost(legs[0], legs[1]);
    cost += mirror_cost(arms[0], arms[1], middle, joints.size) + mirror_cost(legs[0], legs[1], middle, joints.size);
    cost += squared(std::log(arm / leg / k_arm_to_leg) / k_arm_ratio_spread);
    cost += squared(std::log(hull / leg / k_trunk_to_leg) / k_trunk_ratio_spread);
    cost += squared(rest / all / k_rest_spread) + (places[k_head_curve].empty() ? k_no_head_cost : 0);
    figure.cost = 0.5 * cost;
    figure.curve_of_vertex.assign(std::size_t(surface.positions.rows()), k_trunk_curve);
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const int v : parts[p].vertices)
            figure.curve_of_vertex[std::size_t(v)] = curves[p];
    for (const Part& part : held)
        for (const int v : part.vertices)
            figure.curve_of_vertex[std::size_t(v)] = curve_beside(parts[trunk], part);
    return figure;
}

/// The highest part that lies across the middle of the trunk and, by its centre, below it, or -1.
int next_below(const std::vector<Part>& parts, std::size_t trunk)
{
    const Vec3 middle = parts[trunk].box.center();
    int next = -1;
    for (int p = 0; p < int(parts.size()); ++p) {
        const Eigen::AlignedBox3d& box = parts[std::size_t(p)].box;
        if (box.min().x() < middle.x() && box.max().x() > middle.x() && box.center().y() < parts[trunk].box.min().y()
            && (next < 0 || box.center().y() > parts[std::size_t(next)].box.center().y()))
            next = p;
    }
    return next;
}

/// A trunk may be of several parts, such as chest, belly and hips: each is tried with those below it.
/// @param best  the likeliest so far, or none
void look_for_trunk(const TriangleMesh& surface, std::vector<Part> parts, const std::vector<Part>& held, double size,
                    std::optional<ShellFigure>& best)
{
    join_nested(parts, k_shell_padding * size);
    if (parts.size() > k_most_parts)
        return;
    for (const Part& first : parts) {
        std::vector<Part> others = parts;
        others.erase(others.begin() + (&first - parts.data()));
        others.insert(others.begin(), first);
        for (int below = 0; below >= 0; below = next_below(others, 0)) {
            if (below > 0)
                join(others, 0, std::size_t(below));
            if (std::optional<ShellFigure> figure = figure_about(surface, others, 0, held)) {
                figure->cost += held.empty() ? 0 : k_held_cost;
                if (figure->cost < (best ? best->cost : k_most_figure_cost))
                    best = std::move(figure);
            }
        }
    }
}

}  // namespace

std::optional<ShellFigure> shell_figure(const TriangleMesh& surface)
{
    std::vector<Part> shells = shells_of(surface);
    if (shells.empty() || shells.size() > k_most_shells)
        return {};
    Eigen::AlignedBox3d box;
    for (const Part& shell : shells)
        box.extend(shell.box);
    const double size = box.diagonal().norm();
    std::optional<ShellFigure> best;
    look_for_trunk(surface, shells, {}, size, best);
    if (const std::vector<Part> held = take_held(shells, size); !held.empty())
        look_for_trunk(surface, std::move(shells), held, size, best);
    return best;
}

}  // namespace garmentfit
