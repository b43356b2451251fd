// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_motion.h"

#include <algorithm>
#include <cmath>

#include "collision_free_step.h"
#include "distinct_contacts.h"
#include "garmentfit/stopwatch.h"
#include "parallel.h"
#include "preconditioned_cg.h"
#include "stall_detector.h"

namespace garmentfit {
namespace {

// unit: m; a vertex that is nearer to its target than this takes the target's own bits.
constexpr double k_snap = 1e-12;

PreparedCloth untangle_over(const GarmentMesh& rest, const Positions& start, const TriangleMesh& obstacle,
                            const std::vector<int>& garments)
{
    PreparedCloth result = prepare_cloth(rest, start, garments);
    untangle_clear_of(result, obstacle);
    return result;
}

// What crosses at the start is held together as it is: it can neither part nor cross further.
std::vector<std::pair<int, int>> find_crossing_pairs(const PreparedCloth& cloth)
{
    const Edges& edges = cloth.topology.edges();
    std::vector<std::pair<int, int>> pairs;
    for (const auto& [e, f] : cloth.crossings)
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 3; ++k)
                pairs.emplace_back(std::minmax(edges(e, i), cloth.rest.triangles(f, k)));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

Positions stack(const Positions& cloth, const Positions& obstacle)
{
    Positions result(cloth.rows() + obstacle.rows(), 3);
    result << cloth, obstacle;
    return result;
}

}  // namespace

void limit_lengths(Positions& displacements, double longest)
{
    for (Eigen::Index v = 0; v < displacements.rows(); ++v)
        if (const double length = displacements.row(v).norm(); length > longest)
            displacements.row(v) *= longest / length;
}

double self_contact_distance(const ClothOptions& options, const Positions& rest, const Edges& edges)
{
    return std::min(options.contact_distance, k_self_contact_edges * mean_edge_length(rest, edges));
}

ClothMotion::ClothMotion(const GarmentMesh& rest, const Positions& start, const TriangleMesh& obstacle,
                         const ClothOptions& options, const std::vector<int>& garments,
                         const std::vector<Fabric>& fabrics) :
    ClothMotion(untangle_over(rest, start, obstacle, garments), { obstacle, int(obstacle.positions.rows()) }, options,
                fabrics)
{
}

ClothMotion::ClothMotion(PreparedCloth cloth, const Obstacle& obstacle, const ClothOptions& options,
                         const std::vector<Fabric>& fabrics) :
    options_(options),
    materials_(options, fabrics, std::move(cloth.garments)), weld_(std::move(cloth.weld)), rest_(cloth.rest),
    topology_(cloth.topology), cloth_vertices_(int(rest_.positions.rows())),
    self_contact_distance_(self_contact_distance(options_, rest_.positions, topology_.edges())),
    contact_({ rest_.triangles, topology_.edges(), cloth_vertices_ },
             { obstacle.mesh.triangles, edges_of(obstacle.mesh.triangles), int(obstacle.mesh.positions.rows()) },
             obstacle.body_vertices,
             { k_spare_margin * contact_margins().cloth, k_spare_margin * contact_margins().obstacle }),
    x_(stack(cloth.positions, obstacle.mesh.positions)), held_pairs_(find_crossing_pairs(cloth)),
    sewn_(std::move(cloth.sewn)), velocity_(Positions::Zero(cloth_vertices_, 3))
{
    energy_.emplace(rest_, topology_, held_pairs_, materials_, sewn_.ties);
}

// Half of the active distance of cloth and cloth for the cloth. The obstacle gets the rest of that between both.
Margins ClothMotion::contact_margins() const
{
    const double cloth = 0.5 * k_active_distance * self_contact_distance_;
    return { cloth, k_active_distance * options_.contact_distance - cloth };
}

double ClothMotion::contact_distance(ContactReason reason) const
{
    return reason == ContactReason::self ? self_contact_distance_ : options_.contact_distance;
}

void ClothMotion::set_rest(const GarmentMesh& rest)
{
    rest_ = weld_.gather(rest);
    energy_.emplace(rest_, topology_, held_pairs_, materials_, sewn_.ties);
}

void ClothMotion::restore(const Positions& state)
{
    x_ = state;
    velocity_.setZero();
    sticking_.clear();
}

Positions ClothMotion::cloth() const { return weld_.place(x_.topRows(cloth_vertices_)); }

double ClothMotion::speed() const { return velocity_.rowwise().norm().maxCoeff(); }

Positions ClothMotion::obstacle() const { return x_.bottomRows(x_.rows() - cloth_vertices_); }

// Moves each vertex by the collision-free fraction of its displacement. @return what it moved by
Positions ClothMotion::move_freely(const Positions& displacements)
{
    contact_.detect(x_, displacements, { options_.min_distance, options_.min_distance });
    const std::vector<double> fractions
        = collision_free_fractions(contact_.pairs(), x_, displacements, options_.min_distance);
    const Eigen::Map<const Eigen::VectorXd> diagonal(fractions.data(), Eigen::Index(fractions.size()));
    const Positions moved = diagonal.asDiagonal() * displacements;
    x_ += moved;
    return moved;
}

// The one place where positions change. Vertices that lie between others are held back although all of them have nearly
// the same displacement (a pinched fold, sheets that cross as given). They go the rest of it as rigid impact zones.
void ClothMotion::move(const Positions& displacements)
{
    const Stopwatch watch(seconds_.detection);
    const Positions moved = move_freely(displacements);
    if (moved != displacements)
        move_freely(
            merge_impact_zones(contact_.pairs(), cloth_vertices_, x_, displacements - moved, options_.min_distance));
}

void ClothMotion::advect(const Positions& cloth, const Positions& obstacle)
{
    move(stack(weld_.gather(cloth), obstacle));
}

void ClothMotion::add_active_contact(const ContactPair& pair, const Positions& targets, bool is_guard,
                                     std::vector<ActiveContact>& contacts) const
{
    const Vec3 normal = separation(pair.at.weights, corners_of(x_, pair.vertices)) / pair.at.distance;
    double distance = contact_distance(pair.reason);
    if (normal.dot(separation(pair.at.weights, corners_of(targets, pair.vertices))) > k_active_distance * distance)
        return;
    if (pair.reason == ContactReason::self)  // sheets that lie closer at rest stay as close
        distance = std::min(distance, closest_points(pair.kind, corners_of(rest_.positions, pair.vertices)).distance);
    contacts.push_back({ pair, normal, distance, sticking_.stored(pair, normal), is_guard });
}

std::vector<ClothMotion::ActiveContact> ClothMotion::find_active_contacts(const Positions& targets,
                                                                          double guarded_distance) const
{
    std::vector<ActiveContact> result;
    const DistinctContacts contacts = distinct_contacts(contact_.pairs(), x_);
    for (const ContactPair& pair : contacts.distinct)
        add_active_contact(pair, targets, false, result);
    for (const ContactPair& pair : contacts.repeated)
        if (pair.at.distance < guarded_distance)
            add_active_contact(pair, targets, true, result);
    return result;
}

// Contacts so near turn much in a small motion.
void ClothMotion::relinearise(std::vector<ActiveContact>& contacts, double within) const
{
    for (ActiveContact& contact : contacts)
        if (contact.pair.at.distance < within) {
            const Corners corners = corners_of(x_, contact.pair.vertices);
            contact.pair.at = closest_points(contact.pair.kind, corners);
            contact.normal = separation(contact.pair.at.weights, corners) / contact.pair.at.distance;
        }
}

// Whether a contact at the border of a triangle, which is linear in a direction tilted against the way of the vertex,
// is in truth as far apart as it should be at the targets, and on the same side.
bool ClothMotion::passes_by(const ActiveContact& contact, const Positions& targets)
{
    const ContactPair& pair = contact.pair;
    if (pair.kind != PairKind::vertex_face || vertices_at(pair, 1, 4) == 3)
        return false;
    const Corners corners = corners_of(targets, pair.vertices);
    const ClosestPoints at = closest_points(pair.kind, corners);
    return at.distance >= contact.rest_distance && separation(at.weights, corners).dot(contact.normal) > 0;
}

Material ClothMotion::material_at(const ContactPair& pair) const
{
    const int first = pair.vertices[0], second = pair.vertices[pair.kind == PairKind::vertex_face ? 1 : 2];
    if (first >= cloth_vertices_)
        return materials_.at(second);
    return second < cloth_vertices_ ? mixed(materials_.at(first), materials_.at(second)) : materials_.at(first);
}

// Of the cloth that takes part in a contact: around the point of contact, the smaller of two pieces.
double ClothMotion::area_at(const ContactPair& pair) const
{
    const int first_size = pair.kind == PairKind::vertex_face ? 1 : 2;
    double areas[2] = { 0, 0 };
    for (int k = 0; k < 4; ++k)
        if (const int v = pair.vertices[k]; v < cloth_vertices_)
            areas[k >= first_size] += std::abs(pair.at.weights[k]) * energy_->areas()[v];
    return areas[0] > 0 && areas[1] > 0 ? std::min(areas[0], areas[1]) : areas[0] + areas[1];
}

// What is nearer than the minimum distance was given so: its gap may close further, so it has a barrier of its own.
ClothMotion::Barrier ClothMotion::barrier_at(const ActiveContact& contact, double gap, double gap_before,
                                             const MotionStep& step) const
{
    const bool is_above = contact.pair.at.distance > options_.min_distance;
    const double floor = is_above ? options_.min_distance : 0;
    const double zone = step.barrier * (is_above ? contact.rest_distance - floor : k_least_gap * options_.min_distance);
    // no motion uses up more of the gap than this, wherever the targets are
    const double kept = is_above ? k_kept_above_minimum : k_kept_below_minimum;
    const double left = std::max({ gap - floor, kept * (gap_before - floor), k_least_barrier * zone });
    if (left >= zone)
        return { 0, 0 };
    return { (zone - left) * (zone - left) / left, zone * zone / (left * left) - 1 };
}

// A contact that is too close is pushed to its rest distance along the normal, and held against slipping by Coulomb's
// law. None where it is not.
std::optional<SoftConstraint> ClothMotion::contact_constraint(const ActiveContact& contact, const Positions& targets,
                                                              const MotionStep& step) const
{
    const Vec3& normal = contact.normal;
    SoftConstraint constraint { contact.pair.vertices, contact.pair.at.weights, Vec3::Zero(), normal, 0, 0 };
    Vec3 before = Vec3::Zero(), now = Vec3::Zero(), obstacle = Vec3::Zero();
    for (int k = 0; k < 4; ++k) {
        const int v = constraint.vertices[k];
        before += constraint.weights[k] * x_.row(v).transpose();
        now += constraint.weights[k] * targets.row(v).transpose();
        if (v >= cloth_vertices_) {
            obstacle += constraint.weights[k] * targets.row(v).transpose();
            constraint.vertices[k] = -1;
        }
    }
    const double depth = contact.rest_distance - normal.dot(now);
    if (depth <= 0 || (!contact.is_guard && passes_by(contact, targets)))
        return {};
    const Material material = material_at(contact.pair);
    const double area_share = step.contact_area > 0 ? area_at(contact.pair) / step.contact_area : 1;
    const double contact_stiffness = step.contact_stiffness * material.stretch_stiffness * area_share;
    // The linear contact that has the force and the stiffness of the soft one here.
    double rest_distance = contact.rest_distance - 0.5 * std::min(depth, step.contact_softening);
    constraint.normal_stiffness = contact_stiffness * std::min(1.0, depth / step.contact_softening);
    if (step.barrier > 0) {
        const double gap = normal.dot(now);
        const Barrier barrier = barrier_at(contact, gap, normal.dot(before), step);
        // in proportion to the area, it could not carry what the cloth beside a small detail pulls with
        const double stiffness = std::max(contact_stiffness, step.contact_stiffness * material.stretch_stiffness);
        const double force = constraint.normal_stiffness * (rest_distance - gap) + stiffness * barrier.length;
        constraint.normal_stiffness += stiffness * barrier.slope;
        rest_distance = gap + force / constraint.normal_stiffness;
    }
    const Vec3 slip = contact.stored_slip + (now - before) - (now - before).dot(normal) * normal;
    const double slipped = slip.norm(), friction = step.friction_fraction * material.friction;
    constraint.tangent_stiffness = constraint.normal_stiffness
        * (slipped > 0 ? std::min(1.0, friction * depth / slipped) : 1.0) * (friction > 0);
    constraint.target
        = rest_distance * normal + (before - before.dot(normal) * normal) - contact.stored_slip - obstacle;
    return constraint;
}

std::vector<SoftConstraint> ClothMotion::contact_constraints(const std::vector<ActiveContact>& contacts,
                                                             const Positions& targets, const MotionStep& step) const
{
    return parallel_collect<SoftConstraint>(
        contacts.size(), [&](std::size_t i) { return contact_constraint(contacts[i], targets, step); });
}

// The spring of a contact that slides stays stretched as far as friction holds it.
void ClothMotion::remember_slips(const std::vector<ActiveContact>& contacts, const Positions& before,
                                 const MotionStep& step)
{
    std::vector<StickMemory::Slip> slips;
    for (const ActiveContact& contact : contacts) {
        const double friction = step.friction_fraction * material_at(contact.pair).friction;
        const auto& [kind, reason, vertices, at] = contact.pair;
        const Vec3 now = separation(at.weights, corners_of(x_, vertices)),
                   moved = now - separation(at.weights, corners_of(before, vertices));
        const double longest = friction * (contact.rest_distance - contact.normal.dot(now));
        if (longest <= 0)
            continue;
        Vec3 slip = contact.stored_slip + moved - moved.dot(contact.normal) * contact.normal;
        if (const double length = slip.norm(); length > longest)
            slip *= longest / length;
        slips.push_back({ kind, vertices, slip });
    }
    sticking_.assign(std::move(slips));
}

// A single motion uses up only a part of the free distance, so further ones follow as long as they get nearer.
double ClothMotion::advect_obstacle(const Positions& target)
{
    double lag = INFINITY, before;
    int motions = 0;
    do {
        before = lag;
        advect(Positions::Zero(vertices(), 3), target - obstacle());
        lag = snap_obstacle(target);
    } while (lag > 0 && lag < k_progress * before && ++motions < k_most_obstacle_motions);
    return lag;
}

// The cloth's targets, n x 3, while the obstacle makes these displacements (of all vertices).
Positions ClothMotion::minimise_energy(const MotionStep& step, const Positions& displacements,
                                       const std::vector<ActiveContact>& contacts)
{
    const Stopwatch watch(seconds_.solver);
    Positions targets = x_ + displacements;
    energy_->set_time_step(step.time_step);
    Positions inertial = x_.topRows(cloth_vertices_) + step.velocity_kept * step.time_step * velocity_;
    inertial.col(1).array() -= step.gravity * step.time_step * step.time_step;
    PreconditionedCG solver(*energy_, x_.topRows(cloth_vertices_), inertial);
    for (int i = 0; i < step.iterations; ++i) {
        if (i % k_active_set_period == 0) {
            targets.topRows(cloth_vertices_) = solver.positions();
            if (i == 0)  // what slides at first goes on to
                targets.topRows(cloth_vertices_) += step.time_step * velocity_;
            solver.set_constraints(contact_constraints(contacts, targets, step));
        }
        solver.iterate();
    }
    return solver.positions();
}

double ClothMotion::advance(const MotionStep& step)
{
    const Eigen::Index obstacle_vertices = x_.rows() - cloth_vertices_;
    Positions displacements = Positions::Zero(x_.rows(), 3);
    displacements.bottomRows(obstacle_vertices) = *step.obstacle_target - x_.bottomRows(obstacle_vertices);
    limit_lengths(displacements, step.largest_obstacle_move);
    {
        const Stopwatch watch(seconds_.detection);
        contact_.detect(x_, displacements, contact_margins());
    }
    const std::vector<ActiveContact> contacts = find_active_contacts(x_ + displacements);
    displacements.topRows(cloth_vertices_)
        = minimise_energy(step, displacements, contacts) - x_.topRows(cloth_vertices_);
    limit_lengths(displacements, step.largest_move);
    const Positions before = x_;
    move(displacements);
    velocity_ = (x_ - before).topRows(cloth_vertices_) / step.time_step;
    remember_slips(contacts, before, step);
    return snap_obstacle(*step.obstacle_target);
}

// @return the longest lag that is left
double ClothMotion::snap_obstacle(const Positions& target)
{
    double longest_lag = 0;
    for (Eigen::Index v = 0; v < target.rows(); ++v) {
        auto here = x_.row(cloth_vertices_ + v);
        if (const double lag = (target.row(v) - here).norm(); lag > k_snap)
            longest_lag = std::max(longest_lag, lag);
        else
            here = target.row(v);
    }
    return longest_lag;
}

double step_until_converged(ClothMotion& motion, const MotionStep& step, const Progress& progress)
{
    StallDetector detector(k_most_converging_steps);
    double lag = INFINITY;
    while (detector.goes_on(lag)) {
        lag = motion.advance(step);
        if (progress.is_late())
            break;
    }
    return lag;
}

SettleResult settle(ClothMotion& motion, const Positions& target, int steps, const Progress& progress)
{
    MotionStep step;
    step.obstacle_target = &target;
    step.gravity = k_gravity;
    step.friction_fraction = 1;
    step.iterations = k_settling_iterations;
    StallDetector detector(k_most_extra_settling_steps);
    double lag = INFINITY;
    for (int i = 0; i < steps || detector.goes_on(lag); ++i) {
        if (!progress.goes_on(double(i) / (steps + k_most_extra_settling_steps)))
            return { motion.advect_obstacle(target), motion.speed(), true };
        step.velocity_kept = i < k_swinging_steps * steps ? k_swinging_velocity : k_calming_velocity;
        step.contact_stiffness = lag > 0 ? k_pushing_contact_stiffness : k_settling_contact_stiffness;
        lag = motion.advance(step);
        if (lag > 0)
            lag = motion.advect_obstacle(target);
    }
    return { lag, motion.speed(), false };
}

}  // namespace garmentfit
