// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Moves a garment and an obstacle together, only by motions without collision. No other code changes their positions.
//
// Each step has a target for every vertex: the obstacle's is given, the cloth's is the minimum of its energy. Every
// vertex goes as far towards its target as nothing crosses. A vertex that is held back lags, and goes on at the next
// step; the others do not wait for it.
//
// Units    metres, kilograms, seconds.

#include <optional>

#include "cloth_energy.h"
#include "contact.h"
#include "garmentfit/progress.h"
#include "prepared_cloth.h"
#include "stick_memory.h"
#include "tuning.h"

namespace garmentfit {

/// m/s^2. literature: standard gravity [cgpm_1901_gravity], 9.80665, rounded.
constexpr double k_gravity = 9.81;

struct MotionStep {
    const Positions* obstacle_target;  ///< where the obstacle should go
    double largest_move = k_largest_cloth_move;  ///< m; no cloth vertex goes further
    double largest_obstacle_move = k_largest_obstacle_move;  ///< m; no obstacle vertex goes further towards its target
    double time_step = k_cloth_time_step;  ///< s
    double velocity_kept = 0;  ///< fraction of the cloth's velocity kept from the step before
    double gravity = 0;  ///< m/s^2, along -y
    double friction_fraction = 0;  ///< of the cloth's own friction
    double contact_stiffness = k_pushing_contact_stiffness;  ///< in stretch stiffnesses of the cloth
    /// m; the depth within which contact grows to its stiffness. 0: it is as stiff from the first touch on
    double contact_softening = 0;
    /// m^2; the area of cloth whose contact has that stiffness, in proportion. 0: each contact has it
    double contact_area = 0;
    /// share of the way from the minimum distance to where contact begins, within which a force grows without bound that
    /// keeps them apart. 0: there is none
    double barrier = 0;
    int iterations = k_moving_iterations;  ///< of conjugate gradients
};

struct RestResult {
    ForceResidual residual;  ///< how far the forces on the cloth are from balance
    bool out_of_time;  ///< the deadline passed
};

/// Shortens each displacement to this length, where it is longer.
void limit_lengths(Positions& displacements, double longest);

/// m, at which contact of cloth with itself begins.
/// @param edges  of the cloth
double self_contact_distance(const ClothOptions& options, const Positions& rest, const Edges& edges);

class ClothMotion {
public:
    /// `cloth` and the obstacle must not cross.
    /// @param fabrics  of each garment, where the cloth has several; empty: that of `options`
    ClothMotion(PreparedCloth cloth, const Obstacle& obstacle, const ClothOptions& options,
                const std::vector<Fabric>& fabrics = {});

    /// The same from a garment as it is, over an obstacle that is all body: where the cloth crosses itself it is
    /// untangled first, as far as it can be. `start` is n x 3, the obstacle m x 3.
    /// @param garments  of each vertex its garment, where `rest` has several. Empty: one.
    ClothMotion(const GarmentMesh& rest, const Positions& start, const TriangleMesh& obstacle,
                const ClothOptions& options, const std::vector<int>& garments = {},
                const std::vector<Fabric>& fabrics = {});

    /// Gives the cloth another rest shape: the same garment in another size.
    void set_rest(const GarmentMesh& rest);

    /// Moves cloth and obstacle together by these displacements (n x 3, m x 3), as far as each vertex freely may. What
    /// lagged before keeps its lag, and nothing is left behind by it.
    void advect(const Positions& cloth, const Positions& obstacle);

    /// Moves the obstacle towards a target, as far as each vertex freely may, while the cloth stands still.
    /// @return as advance()
    double advect_obstacle(const Positions& target);

    /// Lets the obstacle go to its target and the cloth find its rest around it.
    /// @return the longest distance of an obstacle vertex from its target, metres
    double advance(const MotionStep& step);

    /// The positions of cloth and obstacle, for restore().
    const Positions& state() const { return x_; }
    /// Puts cloth and obstacle back where they were, at rest.
    void restore(const Positions& state);

    Positions cloth() const;  ///< as the garment's own vertices, n x 3
    Positions obstacle() const;  ///< m x 3
    const ClothSeconds& seconds() const { return seconds_; }
    /// How far the forces on the cloth are from balance where friction holds nothing yet.
    ForceResidual residual();

    /// Moves the cloth to a static equilibrium, or as near to one as k_most_rest_moves go. The obstacle stands still.
    /// @param seconds  of simulated time to go on for afterwards
    RestResult find_rest(double seconds, const Progress& progress);

    double speed() const;  ///< m/s, of the fastest vertex of the cloth
    int vertices() const { return weld_.given(); }  ///< of the garment

private:
    /// A pair near contact, linear in the positions: distance = normal . (sum of weight * position).
    struct ActiveContact {
        ContactPair pair;
        Vec3 normal;
        double rest_distance;  // m; force begins below it
        Vec3 stored_slip;  // m, across the normal
        bool is_guard;  // repeats another contact, and keeps the pair off the distance that stops motion
    };
    /// A force that grows from 0, without a kink, where a gap enters a zone, without bound as the gap closes. Both are in
    /// units of the stiffness of contact.
    struct Barrier {
        double length;  // m, of the spring with that force
        double slope;  // of its length over that of the gap
    };
    class RestSearch;
    Positions move_freely(const Positions& displacements);
    void move(const Positions& displacements);
    Margins contact_margins() const;
    double contact_distance(ContactReason reason) const;
    double snap_obstacle(const Positions& target);
    Positions minimise_energy(const MotionStep& step, const Positions& displacements,
                              const std::vector<ActiveContact>& contacts);
    std::vector<ActiveContact> find_active_contacts(const Positions& targets, double guarded_distance = 0) const;
    void add_active_contact(const ContactPair& pair, const Positions& targets, bool is_guard,
                            std::vector<ActiveContact>& contacts) const;
    void relinearise(std::vector<ActiveContact>& contacts, double within) const;
    static bool passes_by(const ActiveContact& contact, const Positions& targets);
    Material material_at(const ContactPair& pair) const;
    double area_at(const ContactPair& pair) const;
    Barrier barrier_at(const ActiveContact& contact, double gap, double gap_before, const MotionStep& step) const;
    std::optional<SoftConstraint> contact_constraint(const ActiveContact& contact, const Positions& targets,
                                                     const MotionStep& step) const;
    std::vector<SoftConstraint> contact_constraints(const std::vector<ActiveContact>& contacts,
                                                    const Positions& targets, const MotionStep& step) const;
    void remember_slips(const std::vector<ActiveContact>& contacts, const Positions& before, const MotionStep& step);

    ClothOptions options_;
    Materials materials_;
    Weld weld_;
    GarmentMesh rest_;  // welded
    MeshTopology topology_;  // of rest_
    int cloth_vertices_;
    double self_contact_distance_;  // m
    ContactDetector contact_;
    Positions x_;  // cloth, then obstacle
    std::vector<std::pair<int, int>> held_pairs_;  // of vertices, across what crosses at the start
    SewnPieces sewn_;
    std::optional<ClothEnergy> energy_;  // its factor cannot be assigned
    Positions velocity_;  // of the cloth, m/s
    StickMemory sticking_;
    ClothSeconds seconds_;
};

/// Repeats a step until the whole obstacle is at its target, for as long as that is worth the time. Ends after one step
/// when the deadline has passed. @return as advance()
double step_until_converged(ClothMotion& motion, const MotionStep& step, const Progress& progress);

struct SettleResult {
    double lag;  ///< m; the longest distance of an obstacle vertex from its target
    double speed;  ///< m/s, of the fastest vertex of the cloth
    bool out_of_time;  ///< the deadline passed before the cloth was settled
};

/// Hangs the cloth on the obstacle under gravity, for so many time steps, and some more while parts of the obstacle are
/// still held back.
SettleResult settle(ClothMotion& motion, const Positions& target, int steps, const Progress& progress);

}  // namespace garmentfit
