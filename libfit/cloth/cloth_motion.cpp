// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_motion.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/stopwatch.h"
#include "loose_parts.h"
#include "untangle.h"

namespace garmentfit {
namespace {

// Once nothing is held back any more, contact as stiff as the cloth will do: a tight garment still presses less than a
// millimetre into its contact zone, and the forces find their balance in half the steps.
constexpr double k_settling_contact_stiffness = 1;
// Pairs up to so many contact distances apart may come into contact while a step is solved.
constexpr double k_lookout = 1.6;
// Which touches press is asked anew after so many steps of descent: at each one, it would flicker, and nothing converge.
constexpr int k_presses_stay = 3;
// A search for pairs looks this share further that it lasts for several steps of cloth near its rest.
constexpr double k_spare = 0.375;
// Cloth keeps off itself by no more than this share of its edges' mean length: else pairs of neighbours within one smooth sheet,
// which grow with the square of the vertices, are all that is ever looked at.
constexpr double k_off_itself = 0.3;

double mean_edge(const GarmentMesh& mesh)
{
    const auto edges = edges_of(mesh.triangles);
    double sum = 0;
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        sum += (mesh.positions.row(edges(e, 0)) - mesh.positions.row(edges(e, 1))).norm();
    return sum / double(std::max<Eigen::Index>(1, edges.rows()));
}

// Cloth that crosses itself is parted first, where it can be without meeting the obstacle.
Untangled parted(const TriangleMesh& cloth, const TriangleMesh& obstacle)
{
    Untangled result = untangle(cloth);
    if (result.positions != cloth.positions && crossing_count({ result.positions, cloth.triangles }, obstacle) > 0)
        return { cloth.positions, self_crossings(cloth) };
    return result;
}

// What still crosses is held together as it is: it can neither part nor cross further.
std::vector<std::pair<int, int>> ties_across(const std::vector<Crossing>& crossings, const Triangles& triangles)
{
    const auto edges = edges_of(triangles);
    std::vector<std::pair<int, int>> ties;
    for (const auto& [e, f] : crossings)
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 3; ++k)
                ties.emplace_back(std::minmax(edges(e, i), triangles(f, k)));
    std::sort(ties.begin(), ties.end());
    ties.erase(std::unique(ties.begin(), ties.end()), ties.end());
    return ties;
}

// A motion that leaves less than this share of the way was worth making.
constexpr double k_nearer = 0.95;

/// Waiting for what cloth holds back.
class Patience {
public:
    explicit Patience(int most) : most_(most) { }

    /// Whether to take one more step: what lags has come nearer lately.
    bool goes_on(double lag)
    {
        constexpr int k_lately = 15;
        if (lag < k_nearer * least_) {
            least_ = lag;
            since_ = 0;
        }
        return lag > 0 && ++since_ <= k_lately && ++taken_ <= most_;
    }

private:
    double least_ = INFINITY;
    int most_, taken_ = 0, since_ = 0;
};

void shorten(Positions& displacements, double longest)
{
    for (Eigen::Index v = 0; v < displacements.rows(); ++v)
        if (const double length = displacements.row(v).norm(); length > longest)
            displacements.row(v) *= longest / length;
}

}  // namespace

/// A pair near contact, linear in the positions: gap = normal . (sum of weight * position).
struct ClothMotion::Touch {
    const ContactPair* pair;
    Vec3 normal;
    double wanted;  // m; the gap below which force begins
};

ClothMotion::ClothMotion(const GarmentMesh& rest, const Positions& start, const TriangleMesh& obstacle,
                         const ClothOptions& options) :
    options_(options), material_(material_of(options)),
    weld_(rest), rest_(weld_.gathered(rest)), cloth_vertices_(int(rest_.positions.rows())),
    off_itself_(std::min(options_.contact_distance, k_off_itself * mean_edge(rest_))),
    contact_(rest_.triangles, cloth_vertices_, obstacle.triangles,
             { k_spare * touching().cloth, k_spare * touching().obstacle }),
    x_(cloth_vertices_ + obstacle.positions.rows(), 3), velocity_(Positions::Zero(cloth_vertices_, 3))
{
    const Untangled cloth = parted({ weld_.gathered(start), rest_.triangles }, obstacle);
    x_ << cloth.positions, obstacle.positions;
    ties_ = ties_across(cloth.left, rest_.triangles);
    const auto parts = ties_of_loose_parts(rest_);
    ties_.insert(ties_.end(), parts.begin(), parts.end());
    energy_.emplace(rest_, ties_, options_);
}

// Half of the lookout of cloth for itself, and what is then left to the obstacle of that between both.
Margins ClothMotion::touching() const
{
    const double cloth = 0.5 * k_lookout * off_itself_;
    return { cloth, k_lookout * options_.contact_distance - cloth };
}

void ClothMotion::set_rest(const GarmentMesh& rest)
{
    rest_ = weld_.gathered(rest);
    energy_.emplace(rest_, ties_, options_);
}

void ClothMotion::restore(const Positions& state)
{
    x_ = state;
    velocity_.setZero();
}

Positions ClothMotion::cloth() const { return weld_.placed(x_.topRows(cloth_vertices_)); }

double ClothMotion::speed() const { return velocity_.rowwise().norm().maxCoeff(); }

Positions ClothMotion::obstacle() const { return x_.bottomRows(x_.rows() - cloth_vertices_); }

// The one place where positions change. What locks itself (a pinched fold, sheets that cross as given) is held back though all of it
// wants about the same way: the rest of the way it goes as one, as the rigid impact zones of Provot 1997 do.
void ClothMotion::move(const Positions& displacements)
{
    const Stopwatch watch(seconds_.detection);
    const auto go = [&](const Positions& way) {
        contact_.detect(x_, way, { options_.min_distance, options_.min_distance });
        const std::vector<double> shares = contact_.free_shares(x_, way, options_.min_distance);
        return Positions(Eigen::Map<const Eigen::VectorXd>(shares.data(), Eigen::Index(shares.size())).asDiagonal()
                         * way);
    };
    const Positions first = go(displacements);
    x_ += first;
    if (first != displacements)
        x_ += go(contact_.joined(x_, displacements - first, options_.min_distance));
}

void ClothMotion::advect(const Positions& cloth, const Positions& obstacle)
{
    Positions displacements(x_.rows(), 3);
    displacements << weld_.gathered(cloth), obstacle;
    move(displacements);
}

std::vector<ClothMotion::Touch> ClothMotion::touches(const Positions& wished) const
{
    std::vector<Touch> result;
    for (const ContactPair& pair : contact_.pairs()) {
        Corners now, next, rest;
        for (int k = 0; k < 4; ++k) {
            now[k] = x_.row(pair.vertices[k]);
            next[k] = wished.row(pair.vertices[k]);
        }
        const Vec3 normal = separation(pair.at.weights, now) / pair.at.distance;
        double wanted = pair.self ? off_itself_ : options_.contact_distance;
        if (normal.dot(separation(pair.at.weights, next)) > k_lookout * wanted)
            continue;
        if (pair.self) {  // sheets that lie closer at rest are left as they are
            for (int k = 0; k < 4; ++k)
                rest[k] = rest_.positions.row(pair.vertices[k]);
            wanted = std::min(wanted, closest(pair.kind, rest).distance);
        }
        result.push_back({ &pair, normal, wanted });
    }
    return result;
}

// A touch that is too near wants its gap back along the normal, and holds against slipping with Coulomb's force.
std::vector<Press> ClothMotion::presses(const std::vector<Touch>& touches, const Positions& wished,
                                        const MotionStep& step) const
{
    const double contact_stiffness = step.contact_stiffness * material_.stretch_stiffness;
    const double friction = step.friction_share * material_.friction;
    std::vector<Press> result;
    for (const Touch& touch : touches) {
        Press press { touch.pair->vertices, touch.pair->at.weights, Vec3::Zero(), touch.normal, contact_stiffness, 0 };
        Vec3 before = Vec3::Zero(), now = Vec3::Zero(), obstacle = Vec3::Zero();
        for (int k = 0; k < 4; ++k) {
            const int v = press.vertices[k];
            before += press.weights[k] * x_.row(v).transpose();
            now += press.weights[k] * wished.row(v).transpose();
            if (v >= cloth_vertices_) {
                obstacle += press.weights[k] * wished.row(v).transpose();
                press.vertices[k] = -1;
            }
        }
        const double depth = touch.wanted - touch.normal.dot(now);
        if (depth <= 0)
            continue;
        const Vec3 slip = (now - before) - (now - before).dot(touch.normal) * touch.normal;
        const double slipped = slip.norm();
        press.tangent_stiffness
            = press.normal_stiffness * (slipped > 0 ? std::min(1.0, friction * depth / slipped) : 1.0) * (friction > 0);
        press.target = touch.wanted * touch.normal + (before - before.dot(touch.normal) * touch.normal) - obstacle;
        result.push_back(press);
    }
    return result;
}

// A single motion uses up only part of the room to what it meets; as long as the next one gets nearer, it is worth making.
double ClothMotion::advect_obstacle(const Positions& target)
{
    constexpr int k_most_motions = 20;
    double lag = INFINITY, before;
    int motions = 0;
    do {
        before = lag;
        advect(Positions::Zero(vertices(), 3), target - obstacle());
        lag = snap_obstacle(target);
    } while (lag > 0 && lag < k_nearer * before && ++motions < k_most_motions);
    return lag;
}

// Where the cloth wishes to be, n x 3, while the obstacle makes these moves (of all vertices).
Positions ClothMotion::relaxed(const MotionStep& step, const Positions& displacements)
{
    const Stopwatch watch(seconds_.solver);
    Positions wished = x_ + displacements;
    const std::vector<Touch> near = touches(wished);
    energy_->set_time_step(step.time_step);
    Positions inertial = x_.topRows(cloth_vertices_) + step.velocity_kept * step.time_step * velocity_;
    inertial.col(1).array() -= step.gravity * step.time_step * step.time_step;
    Descent descent(*energy_, x_.topRows(cloth_vertices_), inertial);
    for (int i = 0; i < step.iterations; ++i) {
        if (i % k_presses_stay == 0) {
            wished.topRows(cloth_vertices_) = descent.positions();
            descent.press(presses(near, wished, step));
        }
        descent.step();
    }
    return descent.positions();
}

double ClothMotion::advance(const MotionStep& step)
{
    const Eigen::Index obstacle_vertices = x_.rows() - cloth_vertices_;
    Positions displacements = Positions::Zero(x_.rows(), 3);
    displacements.bottomRows(obstacle_vertices) = *step.obstacle_target - x_.bottomRows(obstacle_vertices);
    shorten(displacements, step.largest_obstacle_move);
    {
        const Stopwatch watch(seconds_.detection);
        contact_.detect(x_, displacements, touching());
    }
    displacements.topRows(cloth_vertices_) = relaxed(step, displacements) - x_.topRows(cloth_vertices_);
    shorten(displacements, step.largest_move);
    const Positions before = x_.topRows(cloth_vertices_);
    move(displacements);
    velocity_ = (x_.topRows(cloth_vertices_) - before) / step.time_step;
    return snap_obstacle(*step.obstacle_target);
}

double ClothMotion::snap_obstacle(const Positions& target)
{
    constexpr double k_rounding = 1e-12;  // m; nearer than this the target's own bits are taken
    double longest_lag = 0;
    for (Eigen::Index v = 0; v < target.rows(); ++v) {
        auto here = x_.row(cloth_vertices_ + v);
        if (const double lag = (target.row(v) - here).norm(); lag > k_rounding)
            longest_lag = std::max(longest_lag, lag);
        else
            here = target.row(v);
    }
    return longest_lag;
}

double step_until_converged(ClothMotion& motion, const MotionStep& step)
{
    constexpr int k_most_steps = 30;
    Patience patience(k_most_steps);
    double lag = INFINITY;
    while (patience.goes_on(lag))
        lag = motion.advance(step);
    return lag;
}

Settled settle(ClothMotion& motion, const Positions& target, int steps, int to_rest, const Progress& progress)
{
    constexpr int k_more_steps = 60;
    constexpr double k_swinging = 0.7;  // share of the steps; then it comes to rest
    MotionStep step;
    step.obstacle_target = &target;
    step.gravity = k_gravity;
    step.friction_share = 1;
    step.iterations = 18;
    const double pushing = step.contact_stiffness;
    Patience patience(k_more_steps);
    double lag = INFINITY;
    const auto moves = [&](int i) { return i < steps + to_rest && motion.speed() >= k_at_rest; };
    for (int i = 0; i < steps || patience.goes_on(lag) || moves(i); ++i) {
        progress.at(double(i) / (steps + k_more_steps));
        step.velocity_kept = i < k_swinging * steps ? 0.9 : 0.3;
        step.contact_stiffness = lag > 0 ? pushing : k_settling_contact_stiffness;
        lag = motion.advance(step);
        if (lag > 0)
            lag = motion.advect_obstacle(target);
    }
    return { lag == 0, motion.speed() };
}

}  // namespace garmentfit
