// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_labels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "fit/error.h"

namespace fit {
namespace {

// Shares of stature, of joint centres [deleva_1996_segments]; widths and heights of joints [drillis_1966_segments].
constexpr double k_hand = 0.108;           // wrist to fingertip
constexpr double k_leg = 0.485;            // hip to knee to ankle
constexpr double k_ankle_height = 0.041;   // above the sole
constexpr double k_elbow_ratio = 0.51;     // of the way from shoulder to wrist
constexpr double k_knee_ratio = 0.49;      // of the way from hip to ankle
constexpr double k_crotch_to_hip = 0.045;  // hip joint above the crotch, along the thigh
constexpr double k_skull_base = 0.095;     // below the crown
constexpr double k_neck_base = 0.145;      // below the crown: the seventh vertebra of the neck

// How far the bodies of this world stray from these shares, and cuts from straight limbs.
constexpr double k_ratio_spread = 0.03;
constexpr double k_straight_spread = 0.006;  // of stature
constexpr double k_hand_spread = 0.02;       // of stature
constexpr double k_girth_spread = 0.10;      // relative

constexpr double k_spacing = 0.01;  // of stature, between cuts

struct Surface {
    const TriangleMesh& mesh;
    const CurveSkeleton& skeleton;
    const BodyGraph& graph;

    std::vector<Vec3> curve(int c) const
    {
        std::vector<Vec3> points;
        for (const int node : graph.curve(c))
            points.push_back(skeleton.nodes[node]);
        return points;
    }

    /// Whether a vertex hangs on another curve than `c`.
    IsForeign foreign_to(int c) const
    {
        return [this, c](int vertex) {
            const int node = skeleton.node_of_vertex[vertex];
            return node >= 0 && graph.place_of_node[node].curve != c;
        };
    }

    /// The vertices that hang on the last `reach` of a curve, m along it.
    std::vector<Vec3> last(int c, double reach) const
    {
        const std::vector<Vec3> nodes = curve(c);
        std::size_t first = nodes.size() - 1;
        for (double along = 0; first > 0 && along <= reach; --first)
            along += (nodes[first] - nodes[first - 1]).norm();
        std::vector<Vec3> points;
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
            const int node = skeleton.node_of_vertex[v];
            if (node < 0)
                continue;
            const auto& place = graph.place_of_node[node];
            if (place.curve == c && place.row >= int(first))
                points.push_back(mesh.positions.row(v));
        }
        return points;
    }
};

/// The point of `points` where `value` is largest.
Vec3 farthest(const std::vector<Vec3>& points, const std::function<double(const Vec3&)>& value)
{
    return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return value(a) < value(b); });
}

double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const Vec3 axis = b - a;
    const double t = std::clamp((p - a).dot(axis) / std::max(axis.squaredNorm(), 1e-300), 0.0, 1.0);
    return (a + t * axis - p).squaredNorm();
}

/// Row between `from` and `to` where two straight bones explain the line best, weighed against the usual ratio.
int bend(const Centreline& line, int from, int to, const Vec3& root, double usual_ratio, double size)
{
    int best = (from + to) / 2;
    double least = std::numeric_limits<double>::max();
    for (int i = from + 1; i < to; ++i) {
        double squares = 0;
        for (int k = from; k <= to; ++k)
            squares += k < i ? squared_distance_to_segment(line.points[k], root, line.points[i])
                             : squared_distance_to_segment(line.points[k], line.points[i], line.points[to]);
        const double upper = (line.points[i] - root).norm(), lower = (line.points[to] - line.points[i]).norm();
        const double off_line = squares / (to - from + 1) / std::pow(k_straight_spread * size, 2);
        const double off_ratio = std::pow((upper / (upper + lower) - usual_ratio) / k_ratio_spread, 2);
        if (off_line + off_ratio < least) {
            least = off_line + off_ratio;
            best = i;
        }
    }
    return best;
}

/// Row of the smallest girth whose distance from the limb's tip lies between `nearest` and `farthest_off`, m; a distance
/// unlike `usual` counts as a larger girth.
int narrowest(const Centreline& line, const Vec3& tip, double nearest, double farthest_off, double usual, double spread)
{
    const double beyond = (tip - line.points.back()).norm();
    int best = -1;
    double least = std::numeric_limits<double>::max();
    double smallest = std::numeric_limits<double>::max();
    const auto reach = [&](int i) { return line.length() - line.arcs[i] + beyond; };
    const auto in_range = [&](int i) { return line.girths[i] > 0 && reach(i) >= nearest && reach(i) <= farthest_off; };
    for (int i = 0; i < line.size(); ++i)
        if (in_range(i))
            smallest = std::min(smallest, line.girths[i]);
    for (int i = 0; i < line.size(); ++i)
        if (in_range(i)) {
            const double score = (line.girths[i] / smallest - 1) / k_girth_spread + std::pow((reach(i) - usual) / spread, 2);
            if (score < least) {
                least = score;
                best = i;
            }
        }
    return best;
}

void require(bool found, const char* what, const Vec3& near)
{
    if (found)
        return;
    const auto number = [](double x) { return std::to_string(x).substr(0, 6); };
    throw InvalidInput(std::string("body: no ") + what + " found near (" + number(near.x()) + ", " + number(near.y()) + ", "
                       + number(near.z()) + "); give a human body whose limbs are not fused to it");
}

double length(const LimbJoints& limb)
{
    return (limb.middle - limb.root).norm() + (limb.end - limb.middle).norm();
}

LimbJoints arm_joints(const Surface& surface, const Slicer& slicer, int arm, double size)
{
    const Centreline line = centreline(slicer, surface.curve(arm), k_spacing * size, surface.foreign_to(arm));
    LimbJoints joints;
    const Vec3 end = line.points.back();
    const Vec3 elbow_about = line.at(0.5 * (line.arcs[line.first_free] + line.length()));
    joints.tip = farthest(surface.last(arm, 0.12 * size), [&](const Vec3& p) { return (p - elbow_about).dot((end - elbow_about).normalized()); });
    const int wrist = narrowest(line, joints.tip, 0.07 * size, 0.16 * size, k_hand * size, k_hand_spread * size);
    require(wrist > line.first_free + 4, "wrist", end);
    joints.end = line.points[wrist];
    joints.root = line.points[line.first_free];
    joints.middle = line.points[bend(line, line.first_free, wrist, joints.root, k_elbow_ratio, size)];
    return joints;
}

LimbJoints leg_joints(const Surface& surface, const Slicer& slicer, int leg, double size)
{
    const Centreline line = centreline(slicer, surface.curve(leg), k_spacing * size, surface.foreign_to(leg));
    LimbJoints joints;
    const Vec3 end = line.points.back();
    const std::vector<Vec3> foot = surface.last(leg, 0.25 * size);
    const int shin = narrowest(line, end, 0.12 * size, 0.25 * size, 0.17 * size, 0.05 * size);
    require(shin > line.first_free + 4, "ankle", end);
    const int thigh = line.nearest(line.arcs[line.first_free] + 0.05 * size);
    const Vec3 thigh_axis = (line.points[thigh] - line.at(line.arcs[thigh] + 0.1 * size)).normalized();
    joints.root = line.points[line.first_free] + k_crotch_to_hip * size * thigh_axis;
    joints.middle = line.points[bend(line, line.first_free, shin, joints.root, 0.55, size)];
    const Vec3 shin_axis = (line.points[shin] - joints.middle).normalized();
    const auto off_axis = [&](const Vec3& p) { const Vec3 d = p - joints.middle; return (d - d.dot(shin_axis) * shin_axis).norm(); };
    std::vector<Vec3> heel;
    for (const Vec3& p : foot)
        if (off_axis(p) < 0.05 * size)
            heel.push_back(p);
    require(!heel.empty(), "heel", end);
    const Vec3 sole = farthest(heel, [&](const Vec3& p) { return (p - joints.middle).dot(shin_axis); });
    joints.end = joints.middle + ((sole - joints.middle).dot(shin_axis) - k_ankle_height * size) * shin_axis;
    joints.tip = farthest(foot, [&](const Vec3& p) { return (p - joints.end).dot(end - joints.end); });
    return joints;
}

}  // namespace

BodyJoints joint_labels(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const BodyGraph& graph)
{
    const Surface surface { proxy, skeleton, graph };
    const Slicer slicer(proxy);
    BodyJoints joints;
    joints.size = graph.size;
    for (int round = 0; round < 2; ++round) {  // the curve cuts corners: bent legs make the first guess too small
        double legs = 0;
        for (int i = 0; i < 2; ++i) {
            joints.legs[i] = leg_joints(surface, slicer, 2 + i, joints.size);
            legs += 0.5 * length(joints.legs[i]);
        }
        joints.size = legs / k_leg;
    }
    for (int i = 0; i < 2; ++i)
        joints.arms[i] = arm_joints(surface, slicer, i, joints.size);
    joints.pelvis = 0.5 * (joints.legs[0].root + joints.legs[1].root);

    std::vector<Vec3> axis = surface.curve(5);
    axis.insert(axis.begin(), joints.pelvis);
    const std::vector<Vec3> head = surface.curve(4);
    const Vec3 up = (head.back() - head.front()).normalized();
    joints.crown = farthest(surface.last(4, 0.12 * joints.size), [&](const Vec3& p) { return p.dot(up); });
    axis.insert(axis.end(), head.begin() + 1, head.end());
    const Centreline spine = centreline(slicer, axis, k_spacing * joints.size, [](int) { return false; });
    const double top = spine.length() + (joints.crown - spine.points.back()).norm();
    const double neck = top - k_neck_base * joints.size, skull = top - k_skull_base * joints.size;
    joints.lower_spine = spine.at(neck / 3);
    joints.upper_spine = spine.at(neck * 2 / 3);
    joints.neck_base = spine.at(neck);
    joints.skull_base = spine.at(skull);
    joints.mid_neck = spine.at(0.5 * (neck + skull));
    return joints;
}

}  // namespace fit
