// SPDX-License-Identifier: GPL-3.0-or-later
#include "joints_by_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

double squared(double x) { return x * x; }

/// How many standard deviations a value is from what is usual, squared.
double cost_of(double value, const Usual& usual) { return squared((value - usual.mean) / usual.deviation); }

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The joints with what lies beyond each.
class Tree {
public:
    explicit Tree(const UnnamedJoints& joints) :
        joints_(joints), children_(joints.parents.size()), mass_(joints.masses),
        moment_(joints.parents.size(), Vec3::Zero()), reach_(joints.parents.size(), 0), next_(joints.parents.size(), -1)
    {
        for (int j = 0; j < size(); ++j)
            (parent(j) < 0 ? roots_ : children_[std::size_t(parent(j))]).push_back(j);
        order_ = roots_;
        for (std::size_t i = 0; i < order_.size(); ++i)
            order_.insert(order_.end(), children(order_[i]).begin(), children(order_[i]).end());
        for (auto j = order_.rbegin(); j != order_.rend(); ++j)
            add_up(*j);
    }

    int size() const { return int(joints_.parents.size()); }
    int parent(int joint) const { return joints_.parents[std::size_t(joint)]; }
    const Vec3& place(int joint) const { return joints_.places[std::size_t(joint)]; }
    const std::vector<int>& children(int joint) const { return children_[std::size_t(joint)]; }
    const std::vector<int>& parents_first() const { return order_; }
    double edge(int joint) const { return (place(joint) - place(parent(joint))).norm(); }

    double mass_from(int joint) const { return mass_[std::size_t(joint)]; }  ///< of the joint and all beyond it
    Vec3 centre_from(int joint) const { return moment_[std::size_t(joint)] / mass_from(joint); }
    double reach(int joint) const { return reach_[std::size_t(joint)]; }  ///< along bones to the farthest joint

    /// The joint and those on the way to the farthest one beyond it.
    std::vector<int> longest_path(int joint) const
    {
        std::vector<int> path;
        for (; joint >= 0; joint = next_[std::size_t(joint)])
            path.push_back(joint);
        return path;
    }

    bool is_above(int ancestor, int joint) const
    {
        while (joint >= 0 && joint != ancestor)
            joint = parent(joint);
        return joint >= 0;
    }

private:
    void add_up(int j)
    {
        const auto row = std::size_t(j);
        if (joints_.masses[row] > 0)
            moment_[row] += joints_.masses[row] * joints_.centres[row];
        for (const int child : children(j)) {
            mass_[row] += mass_from(child);
            moment_[row] += moment_[std::size_t(child)];
            if (const double far = edge(child) + reach(child); far > reach(j) || next_[row] < 0) {
                reach_[row] = far;
                next_[row] = child;
            }
        }
    }

    const UnnamedJoints& joints_;
    std::vector<std::vector<int>> children_;
    std::vector<int> roots_, order_;
    std::vector<double> mass_;
    std::vector<Vec3> moment_;
    std::vector<double> reach_;
    std::vector<int> next_;  // towards the farthest
};

/// Three joints of an arm (shoulder, elbow, wrist) or leg (hip, knee, ankle).
struct Limb {
    int first = -1, middle = -1, last = -1;
    double length = 0;
    double cost = std::numeric_limits<double>::infinity();
};

/// Two joints with a common parent and alike trees.
struct Pair {
    int base = -1;
    std::array<int, 2> starts {};
    std::array<Limb, 2> arms {}, legs {};
};

class LimbFinder {
public:
    /// @param trunk  where it leaves the trunk
    LimbFinder(const Tree& tree, const Vec3& trunk, int start) :
        tree_(tree), trunk_(trunk), path_(tree.longest_path(start))
    {
    }

    /// The likeliest three joints of the path.
    Limb find(const UsualLimb& usual, bool has_fingers) const
    {
        Limb best;
        for (std::size_t i = 0; i < path_.size() && i < k_most_joints_of_limb; ++i)
            for (std::size_t j = i + 1; j < path_.size() && j < k_most_joints_of_limb; ++j)
                for (std::size_t k = j + 1; k < path_.size() && k < k_most_joints_of_limb; ++k)
                    if (const Limb limb = limb_of(i, j, k, usual, has_fingers); limb.cost < best.cost)
                        best = limb;
        return best;
    }

private:
    const Vec3& place(std::size_t step) const { return tree_.place(path_[step]); }

    Limb limb_of(std::size_t i, std::size_t j, std::size_t k, const UsualLimb& usual, bool has_fingers) const
    {
        const double upper = (place(j) - place(i)).norm(), lower = (place(k) - place(j)).norm();
        Limb limb { path_[i], path_[j], path_[k], upper + lower };
        if (!(upper > 0 && lower > 0))
            return limb;
        const double beyond = tree_.reach(path_[k]) / limb.length,
                     from_trunk = (place(i) - trunk_).norm() / limb.length;
        limb.cost = cost_of(std::log(lower / upper), usual.log_ratio) + cost_of(from_trunk, usual.from_trunk)
            + cost_of(beyond, usual.beyond);
        if (has_fingers)
            limb.cost -= long_children(path_[k], limb.length) >= 3 ? k_fingers_gain : 0;
        else if (const auto next = k + 1; next < path_.size())
            limb.cost += cost_of(angle_between(place(k) - place(j), place(next) - place(k)), k_usual_ankle);
        return limb;
    }

    /// Branches that go on for some length, as fingers do.
    int long_children(int joint, double length) const
    {
        const std::vector<int>& children = tree_.children(joint);
        return int(std::count_if(children.begin(), children.end(), [&](int child) {
            return tree_.edge(child) + tree_.reach(child) > k_least_finger * length;
        }));
    }

    const Tree& tree_;
    Vec3 trunk_;
    std::vector<int> path_;
};

/// Where a pair leaves the trunk: limbs that begin at one place do so there, though the joint before them may be at the
/// other end of the chest.
Vec3 trunk_at(const Tree& tree, const Pair& pair)
{
    const Vec3 &left = tree.place(pair.starts[0]), &right = tree.place(pair.starts[1]);
    return (left - right).norm() <= k_one_place * tree.reach(pair.starts[0]) ? left : tree.place(pair.base);
}

bool are_alike(double a, double b) { return std::abs(a - b) <= k_alike * std::max(a, b); }

std::vector<Pair> pairs_in(const Tree& tree)
{
    double all = 0;
    for (const int joint : tree.parents_first())
        if (tree.parent(joint) < 0)
            all += tree.mass_from(joint);
    std::vector<Pair> pairs;
    for (const int base : tree.parents_first()) {
        const std::vector<int>& children = tree.children(base);
        for (std::size_t a = 0; a < children.size(); ++a)
            for (std::size_t b = a + 1; b < children.size(); ++b) {
                const int left = children[a], right = children[b];
                if (std::min(tree.mass_from(left), tree.mass_from(right)) > k_least_limb_mass * all
                    && are_alike(tree.reach(left), tree.reach(right)) && tree.reach(left) > 0
                    && are_alike(tree.edge(left) + tree.reach(left), tree.edge(right) + tree.reach(right)))
                    pairs.push_back({ base, { left, right } });
            }
    }
    const auto mass = [&](const Pair& p) { return tree.mass_from(p.starts[0]) + tree.mass_from(p.starts[1]); };
    std::stable_sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) { return mass(a) > mass(b); });
    pairs.resize(std::min<std::size_t>(pairs.size(), k_most_pairs));
    for (Pair& pair : pairs)
        for (int side = 0; side < 2; ++side) {
            const LimbFinder finder(tree, trunk_at(tree, pair), pair.starts[side]);
            pair.arms[side] = finder.find(k_usual_arm, true);
            pair.legs[side] = finder.find(k_usual_leg, false);
        }
    return pairs;
}

/// A whole human.
struct Human {
    Pair legs, arms;
    std::vector<int> neck;  ///< from the trunk to the head, which is the last
    double cost = std::numeric_limits<double>::infinity();
};

class HumanFinder {
public:
    explicit HumanFinder(const Tree& tree) : tree_(tree), pairs_(pairs_in(tree)) { }

    Human find() const
    {
        Human best;
        for (const Pair& legs : pairs_)
            for (const Pair& arms : pairs_)
                if (legs.base != arms.base)
                    if (Human human = human_of(legs, arms); human.cost < best.cost)
                        best = std::move(human);
        return best;
    }

private:
    Human human_of(const Pair& legs, const Pair& arms) const
    {
        Human human { legs, arms, {} };
        const Vec3 trunk = tree_.place(arms.base) - tree_.place(legs.base);
        const double leg = legs.legs[0].length + legs.legs[1].length, arm = arms.arms[0].length + arms.arms[1].length;
        human.neck = neck_of(arms, trunk);
        if (human.neck.empty() || !(leg > 0 && arm > 0))
            return human;
        human.cost = legs.legs[0].cost + legs.legs[1].cost + arms.arms[0].cost + arms.arms[1].cost
            + cost_of(std::log(arm / leg), k_usual_arm_by_leg) + cost_of(2 * trunk.norm() / leg, k_usual_trunk_by_leg)
            + (tree_.is_above(legs.base, arms.base) ? 0 : k_other_root_cost);
        for (const Limb& limb : legs.legs)
            human.cost += cost_of(angle_between(tree_.place(limb.last) - tree_.place(limb.first), -trunk), k_usual_hip);
        return human;
    }

    /// The heaviest branch beyond the arms that goes on along the trunk. Empty: none.
    std::vector<int> neck_of(const Pair& arms, const Vec3& trunk) const
    {
        int start = -1;
        for (const int base : { arms.base, tree_.parent(arms.base) })
            if (base >= 0 && start < 0)
                for (const int child : tree_.children(base)) {
                    const bool is_limb = tree_.is_above(child, arms.starts[0]) || tree_.is_above(child, arms.starts[1]);
                    if (!is_limb && tree_.mass_from(child) > 0
                        && (tree_.centre_from(child) - tree_.place(arms.base)).dot(trunk) > 0
                        && (start < 0 || tree_.mass_from(child) > tree_.mass_from(start)))
                        start = child;
                }
        std::vector<int> neck;
        for (int joint = start; joint >= 0; joint = heaviest_child(joint)) {
            if (tree_.mass_from(joint) < k_least_head_mass * tree_.mass_from(start))
                break;
            neck.push_back(joint);
        }
        return neck;
    }

    int heaviest_child(int joint) const
    {
        const std::vector<int>& children = tree_.children(joint);
        const auto found = std::max_element(children.begin(), children.end(),
                                            [&](int a, int b) { return tree_.mass_from(a) < tree_.mass_from(b); });
        return found == children.end() ? -1 : *found;
    }

    const Tree& tree_;
    std::vector<Pair> pairs_;
};

class Namer {
public:
    Namer(const Tree& tree, const Human& human) : tree_(tree), human_(human), names_(std::size_t(tree.size())) { }

    /// Empty where the feet do not tell front from back.
    std::vector<std::optional<NamedJoint>> name()
    {
        if (!find_sides())
            return {};
        for (int joint = human_.arms.base; joint >= 0; joint = tree_.parent(joint))
            name_joint(joint, JointKind::spine, 0);
        for (int joint = tree_.parent(human_.legs.base); joint >= 0; joint = tree_.parent(joint))
            names_[std::size_t(joint)].reset();  // a root on the floor
        name_joint(human_.legs.base, JointKind::pelvis, 0);
        name_neck();
        for (int side = 0; side < 2; ++side) {
            const int is_right = 1 + (side != left_leg_);
            const Limb &leg = human_.legs.legs[side], &arm = human_.arms.arms[side];
            name_joint(leg.first, JointKind::hip, is_right);
            name_joint(leg.middle, JointKind::knee, is_right);
            name_joint(leg.last, JointKind::ankle, is_right);
            name_arm(arm, 1 + (side != left_arm_));
        }
        return std::move(names_);
    }

private:
    void name_joint(int joint, JointKind kind, int side) { names_[std::size_t(joint)] = NamedJoint { kind, side }; }

    void name_arm(const Limb& arm, int side)
    {
        for (int joint = tree_.parent(arm.first); joint != human_.arms.base; joint = tree_.parent(joint))
            name_joint(joint, JointKind::clavicle, side);
        name_joint(arm.first, JointKind::shoulder, side);
        name_joint(arm.middle, JointKind::elbow, side);
        name_joint(arm.last, JointKind::wrist, side);
    }

    /// Where clavicles hang on the neck, as those of 3ds Max do, only the head is beyond it.
    void name_neck()
    {
        for (const int joint : human_.neck)
            name_joint(joint, JointKind::neck, 0);
        name_joint(human_.neck.back(), JointKind::head, 0);
        const auto along = [&](int joint) { return (tree_.place(joint) - tree_.place(human_.legs.base)).dot(up_); };
        const double shoulders = 0.5 * (along(human_.arms.arms[0].first) + along(human_.arms.arms[1].first));
        if (human_.neck.size() == 1 && along(human_.arms.base) > shoulders)
            name_joint(human_.arms.base, JointKind::neck, 0);
    }

    /// From the ankle, where the skin of the foot lies; without skin, where its bones go.
    Vec3 foot(int ankle) const
    {
        if (tree_.mass_from(ankle) > 0)
            return tree_.centre_from(ankle) - tree_.place(ankle);
        return tree_.place(tree_.longest_path(ankle).back()) - tree_.place(ankle);
    }

    bool find_sides()
    {
        const auto &legs = human_.legs.legs, &arms = human_.arms.arms;
        const Vec3 across = tree_.place(legs[0].first) - tree_.place(legs[1].first);
        up_ = (tree_.place(human_.arms.base) - tree_.place(human_.legs.base)).normalized();
        const Vec3 front = across.cross(up_).normalized();  // if the first one is the left one
        const double forwards
            = (foot(legs[0].last) + foot(legs[1].last)).dot(front) / (legs[0].length + legs[1].length);
        left_leg_ = forwards > 0 ? 0 : 1;
        const auto upper_arm = [&](const Limb& arm) -> Vec3 {  // both may begin at one joint of the spine
            return tree_.place(arm.first) + tree_.place(arm.middle);
        };
        left_arm_ = (upper_arm(arms[0]) - upper_arm(arms[1])).dot(across) > 0 ? left_leg_ : 1 - left_leg_;
        return std::abs(forwards) > k_least_foot;
    }

    const Tree& tree_;
    const Human& human_;
    std::vector<std::optional<NamedJoint>> names_;
    Vec3 up_ = Vec3::UnitY();
    int left_leg_ = 0, left_arm_ = 0;
};

}  // namespace

std::vector<std::optional<NamedJoint>> joints_by_tree(const UnnamedJoints& joints)
{
    const Tree tree(joints);
    const Human human = HumanFinder(tree).find();
    return human.cost < k_likely_human ? Namer(tree, human).name() : std::vector<std::optional<NamedJoint>>();
}

}  // namespace garmentfit
