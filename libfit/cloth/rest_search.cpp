// SPDX-License-Identifier: GPL-3.0-or-later

// The search for static equilibrium of ClothMotion: quasi-Newton moves [liu_2017_quasi_newton], in rounds between which
// friction lets go. Hanging cloth buckles, so most of what is in the way of balance is no linear system: the steps of a
// move take the forces where they have led, while contacts stay those of its start.

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "cloth_motion.h"
#include "friction_anchors.h"
#include "limited_memory.h"
#include "stiff_details.h"
#include "tangent_factor.h"

namespace garmentfit {
namespace {

double dot(const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); }

double longest(const Positions& ways) { return std::sqrt(ways.rowwise().squaredNorm().maxCoeff()); }

// Whether a contact is one of a vertex of the cloth with a triangle of the cloth.
bool is_vertex_on_cloth(const SoftConstraint& contact)
{
    return contact.weights[0] == 1 && *std::min_element(contact.vertices.begin(), contact.vertices.end()) >= 0;
}

bool is_on_obstacle(const SoftConstraint& contact)
{
    return *std::min_element(contact.vertices.begin(), contact.vertices.end()) < 0;
}

/// Of what is no detail.
ForceResidual measure(const Positions& forces, const std::vector<double>& masses, const StiffDetails& details)
{
    std::vector<double> shares;
    for (int v = 0; v < int(masses.size()); ++v)
        if (!details.contains(v))
            shares.push_back(forces.row(v).norm() / (masses[v] * k_gravity));
    ForceResidual result;
    for (const double share : shares)
        result.mean += share / double(shares.size());
    const auto at = shares.begin() + std::ptrdiff_t(0.99 * double(shares.size()));
    std::nth_element(shares.begin(), at, shares.end());
    result.percentile_99 = *at;
    return result;
}

}  // namespace

class ClothMotion::RestSearch {
public:
    explicit RestSearch(ClothMotion& motion) :
        motion_(motion), details_(motion.sewn_, cloth()), untied_energy_(untied_energy()),
        energy_(untied_energy_ ? *untied_energy_ : *motion.energy_), anchors_(motion.cloth_vertices_)
    {
        step_.contact_stiffness = k_settling_contact_stiffness;
        step_.contact_softening = k_contact_softening;
        step_.contact_area = k_contact_area;
        step_.barrier = k_barrier;
        find_forces();
    }

    const ForceResidual& residual() const { return residual_; }

    /// Rounds until cloth that is pushed on comes back, and `more` after them. Where forces do not balance, ends where they
    /// did best.
    /// @return whether there was time enough
    bool run(int more, const Progress& progress)
    {
        const int most = k_most_rest_moves + more;
        bool in_time = true;
        std::vector<double> left;  // after each round
        for (int after_rest = -1;
             in_time && after_rest < more && moves_ < most && !has_stalled(left) && !is_hopeless(left);) {
            if (after_rest < 0 && stands_still())
                push_on();
            else if (!left.empty())
                let_go();
            in_time = make_round(left.empty() ? k_enough_at_first : 0, progress, most);
            left.push_back(typical_residual());
            remember_end();
            if (after_rest >= 0 || (stands_still() && has_come_back()))
                ++after_rest;
        }
        if (!residual_.is_at_rest() && best_)
            go_back();
        return in_time;
    }

private:
    struct State {
        ForceResidual residual;
        Positions all;
        Positions found_at;
        FrictionAnchors anchors;
        double grip;
    };

    /// The energy of cloth on which no ties hold the details, for these go along; none where it has no details.
    std::optional<ClothEnergy> untied_energy() const
    {
        if (details_.empty())
            return {};
        return std::optional<ClothEnergy>(std::in_place, motion_.rest_, motion_.topology_, motion_.held_pairs_,
                                          motion_.materials_, details_.other_ties(motion_.sewn_.ties));
    }

    /// A single vertex that is jammed may have more than all others together, so it does not decide.
    static bool is_better(const ForceResidual& one, const ForceResidual& other)
    {
        return one.is_at_rest() != other.is_at_rest() ? one.is_at_rest() : one.percentile_99 < other.percentile_99;
    }

    /// Of the last rounds, as long as forces balance.
    void remember_end()
    {
        if (!residual_.is_at_rest())
            ends_.clear();
        else
            ends_.push_back(cloth());
        if (ends_.size() > std::size_t(k_rounds_of_drift) + 1)
            ends_.pop_front();
    }

    /// Whether the cloth is where it was one round before, or two: it may go to and fro for ever between two balances,
    /// each with other contacts.
    bool stands_still() const
    {
        const std::size_t n = ends_.size();
        return (n > 1 && is_still(ends_[n - 1] - ends_[n - 2])) || (n > 2 && is_still(ends_[n - 1] - ends_[n - 3]));
    }

    /// Single vertices may be anchored to and fro.
    static bool is_still(const Positions& way)
    {
        Eigen::VectorXd lengths = way.rowwise().norm();
        const auto nearly_all = lengths.begin() + Eigen::Index(k_share_still * double(lengths.size() - 1));
        std::nth_element(lengths.begin(), nearly_all, lengths.end());
        return *nearly_all < k_still && lengths.maxCoeff() < k_nearly_still;
    }

    bool has_come_back() const
    {
        return pushed_from_.size() == std::size_t(k_most_pushes)
            || (!pushed_from_.empty() && longest(cloth() - pushed_from_.back()) < k_back);
    }

    /// Along the drift of the last rounds. A fold that is about to give way creeps for tens of rounds under forces that
    /// count as balanced: pushed on, it gives way at once, and everything else comes back.
    void push_on()
    {
        Positions push = k_push_of_drift * (ends_.back() - ends_.front());
        limit_lengths(push, k_longest_push);
        pushed_from_.push_back(cloth());
        ends_.clear();
        move(push);
    }

    /// What is left on a vertex on the mean where none is jammed: such a vertex may have more than all others together. Of
    /// cloth near balance the 99th percentile is ten times the mean or more, as in ForceResidual::is_at_rest.
    double typical_residual() const { return residual_.percentile_99 / 10; }

    /// Whether two rounds brought the forces no nearer to balance. The first one ends early, and cloth may travel after it.
    static bool has_stalled(const std::vector<double>& left)
    {
        const std::size_t n = left.size();
        return n > 3 && left[n - 1] > left[n - 3] && left[n - 1] > k_balanced;
    }

    /// Whether forces far beyond the cloth's weight would not come to balance even if they fell twice as fast from here on:
    /// those of cloth that passes through itself, or that is far too tight.
    bool is_hopeless(const std::vector<double>& left) const
    {
        const std::size_t n = left.size();
        if (n < 2 || left[n - 1] < k_far_from_balance)
            return false;
        const double rounds_left = double(k_most_rest_moves - moves_) / k_most_round_moves;
        return left[n - 1] * std::pow(left[n - 1] / left[n - 2], 2 * rounds_left) > k_balanced;
    }

    /// Moves until forces balance, or leave no more than `enough`.
    /// @return whether there was time enough
    bool make_round(double enough, const Progress& progress, int most)
    {
        for (int move = 0; move == 0 || (move < k_most_round_moves && !is_balanced(enough)); ++move) {
            if (!progress.goes_on(double(moves_) / most))
                return false;
            make_move();
            if (!best_ || is_better(residual_, best_->residual))
                best_ = { residual_, motion_.x_, found_at_, anchors_, grip_ };
        }
        return true;
    }

    bool is_balanced(double enough) const { return typical_residual() < enough || residual_.is_at_rest(); }

    /// To the best state, with the contacts and the anchors that it was in balance with.
    void go_back()
    {
        anchors_ = best_->anchors;
        grip_ = best_->grip;
        motion_.x_.topRows(motion_.cloth_vertices_) = best_->found_at;
        find_contacts();
        motion_.x_ = best_->all;
        find_forces();
    }

    Positions cloth() const { return motion_.x_.topRows(motion_.cloth_vertices_); }

    bool contacts_are_old(const Positions& x) const
    {
        return found_at_.rows() == 0 || longest(x - found_at_) > k_contact_reach;
    }

    /// What is further apart does not come to block motion before contacts are found anew.
    double guarded_distance() const
    {
        return k_blocking_distance * motion_.options_.min_distance + 2 * k_contact_reach;
    }

    void find_contacts()
    {
        motion_.contact_.detect(motion_.x_, Positions::Zero(motion_.x_.rows(), 3), motion_.contact_margins());
        contacts_ = motion_.find_active_contacts(motion_.x_, guarded_distance());
        for (ActiveContact& contact : contacts_)  // motion must stay possible
            contact.rest_distance = contact.is_guard
                ? k_blocking_distance * motion_.options_.min_distance
                : std::max(contact.rest_distance, k_least_gap * motion_.options_.min_distance);
        found_at_ = cloth();
    }

    /// The forces where the cloth is, and what touches there. Contacts are found anew where it has moved on.
    void find_forces()
    {
        const Positions x = cloth();
        if (contacts_are_old(x))
            find_contacts();
        else
            motion_.relinearise(contacts_, guarded_distance());
        anchors_.set_active_contacts(find_active_contacts(x), x);
        forces_ = forces_at(x);
        residual_ = measure(forces_, energy_.masses(), details_);
    }

    std::vector<SoftConstraint> contacts_at(const Positions& x) const
    {
        Positions targets = motion_.x_;
        targets.topRows(motion_.cloth_vertices_) = x;
        return motion_.contact_constraints(contacts_, targets, step_);
    }

    /// Elastic forces, gravity, contact, and friction under the normal forces of the last find_forces(), where details
    /// have followed the cloth.
    Positions forces_at(Positions x)
    {
        details_.follow(x);
        constraints_ = contacts_at(x);
        const std::vector<SoftConstraint> limits = energy_.strain_limits(x), friction = anchors_.constraints(x, grip_);
        constraints_.insert(constraints_.end(), limits.begin(), limits.end());
        constraints_.insert(constraints_.end(), friction.begin(), friction.end());
        Positions result = energy_.elastic_forces(x);
        for (const SoftConstraint& constraint : constraints_)
            add_force(constraint, constraint.stiffness_times(constraint.target - constraint.sum(x)), result);
        for (int v = 0; v < motion_.cloth_vertices_; ++v)
            result(v, 1) -= energy_.masses()[v] * k_gravity;
        details_.hand_down(result, x);
        return result;
    }

    /// Of each vertex all that pushes it off the obstacle, as one, and the strongest contact with a triangle of cloth.
    std::vector<FrictionAnchors::ActiveContact> find_active_contacts(const Positions& x) const
    {
        Positions pushes = Positions::Zero(x.rows(), 3);
        std::vector<FrictionAnchors::ActiveContact> on_cloth, result;
        for (const SoftConstraint& contact : contacts_at(x)) {
            const Vec3 force = contact.stiffness_times(contact.target - contact.sum(x));
            const auto& [v, a, b, c] = contact.vertices;
            if (is_on_obstacle(contact))
                add_force(contact, force, pushes);
            else if (is_vertex_on_cloth(contact))
                on_cloth.push_back({ v,
                                     { a, b, c },
                                     { -contact.weights[1], -contact.weights[2], -contact.weights[3] },
                                     force,
                                     material(v, a).friction,
                                     spring_stiffness(v, a) });
        }
        for (int v = 0; v < int(x.rows()); ++v)
            if (const Vec3 push = pushes.row(v).transpose(); push.norm() > 0)
                result.push_back(
                    { v, { -1, -1, -1 }, { 0, 0, 0 }, push, material(v, v).friction, spring_stiffness(v, v) });
        std::stable_sort(on_cloth.begin(), on_cloth.end(), [](const auto& one, const auto& other) {
            return one.vertex != other.vertex ? one.vertex < other.vertex : one.force.norm() > other.force.norm();
        });
        int last = -1;
        for (const FrictionAnchors::ActiveContact& contact : on_cloth)
            if (std::exchange(last, contact.vertex) != contact.vertex && contact.force.norm() > 0)
                result.push_back(contact);
        return result;
    }

    /// N/m, of the spring by which friction holds a vertex.
    double spring_stiffness(int v, int other) const
    {
        return material(v, other).stretch_stiffness * energy_.areas()[v] / k_contact_area;
    }

    Material material(int v, int other) const { return mixed(motion_.materials_.at(v), motion_.materials_.at(other)); }

    void let_go()
    {
        anchors_.follow(cloth(), grip_);
        grip_ = 1;
        find_contacts();
        find_forces();
    }

    /// Details follow.
    void move(const Positions& way)
    {
        Positions displacements = Positions::Zero(motion_.x_.rows(), 3);
        displacements.topRows(way.rows()) = details_.following(way, cloth());
        motion_.move(displacements);
        find_forces();
    }

    void make_move()
    {
        const Positions from = cloth();
        if (!factor_) {  // only here: its order of elimination costs more than the forces
            energy_.set_time_step(k_rest_time_step);
            factor_.emplace(energy_);
        }
        if (typical_residual() > k_far_contacts || moves_ >= next_factor_) {
            factor_->factorise(from, constraints_);
            next_factor_ = moves_ + k_factor_period;
        }
        ++moves_;
        const auto [way, foretold] = way_to_balance(from);
        move(way);
        steps_ = forces_.norm() < k_foretold * foretold.norm() ? std::min(k_most_steps, 2 * steps_)
                                                               : std::max(k_least_steps, steps_ / 2);
    }

    /// By steps of L-BFGS, whose first guess is the factor, under the contacts and the friction of the start. What they
    /// learn of the forces holds as long as these do.
    /// @return the way of the cloth, and the forces at its end if contacts and friction stayed
    std::pair<Positions, Positions> way_to_balance(const Positions& from)
    {
        LimitedMemory memory(k_most_steps);
        const auto solve = [&](const Positions& forces) { return factor_->solve(forces); };
        Positions x = from, forces = forces_;
        double enough = 0;
        for (int step = 0; step < steps_; ++step) {
            const Positions direction = memory.direction(forces, solve);
            const double work = dot(forces, direction);
            if (step == 0)
                enough = k_forces_left * k_forces_left * work;
            if (!(work > 0))  // no way down is known
                break;
            const auto [share, forces_there] = share_along(direction, x, work);
            const Positions way = share * direction;
            x += way;
            memory.remember(way, forces - forces_there);
            forces = forces_there;
            if (std::abs(dot(forces, direction)) < enough || longest(x - from) > k_reach_of_contacts)
                break;
        }
        const Positions way = x - from;
        return { k_largest_rest_move / std::max(longest(way), k_largest_rest_move) * way, forces };
    }

    /// Contacts that open and close make the forces jump, so a whole step may go too far: then it is cut where the
    /// forces do less work against it.
    /// @param work  of the forces at x along the direction
    /// @return the share of the direction to go, and the forces there
    std::pair<double, Positions> share_along(const Positions& direction, const Positions& x, double work)
    {
        double share = std::min(1.0, k_largest_rest_move / longest(direction));
        Positions forces = forces_at(x + share * direction);
        for (int cut = 0; cut < k_most_cuts; ++cut) {
            const double work_there = dot(forces, direction);
            if (work_there > -k_overshoot * work)
                break;
            share *= std::clamp(work / (work - work_there), 0.2, 0.5);
            forces = forces_at(x + share * direction);
        }
        return { share, forces };
    }

    ClothMotion& motion_;
    StiffDetails details_;
    std::optional<ClothEnergy> untied_energy_;
    ClothEnergy& energy_;
    MotionStep step_ {};
    std::optional<TangentFactor> factor_;
    FrictionAnchors anchors_;
    double grip_ = k_kinetic_friction;  // share of the friction coefficients
    int moves_ = 0, next_factor_ = 0, steps_ = k_most_steps;  // steps_ of the next move at most
    std::optional<State> best_;
    std::deque<Positions> ends_;  // of the last rounds
    std::vector<Positions> pushed_from_;  // the cloth, before each push
    Positions found_at_;  // the cloth, when contacts were found
    std::vector<ActiveContact> contacts_;
    std::vector<SoftConstraint> constraints_;  // of the last forces_at()
    Positions forces_;  // where the cloth is
    ForceResidual residual_;  // of these
};

ForceResidual ClothMotion::residual() { return RestSearch(*this).residual(); }

RestResult ClothMotion::find_rest(double seconds, const Progress& progress)
{
    RestSearch search(*this);
    const bool in_time = search.run(int(std::ceil(seconds / k_rest_time_step)), progress);
    velocity_.setZero();
    sticking_.clear();
    return { search.residual(), !in_time };
}

}  // namespace garmentfit
