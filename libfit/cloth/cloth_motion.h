// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A garment and an obstacle in motion: the one place where positions change, and only by free motions.
//
// Each step wishes positions for all vertices (the obstacle its targets, the cloth the minimum of its energy) and lets
// every vertex go as far towards its wish as nothing crosses. A vertex that is held back lags, and goes on at the next step;
// nothing else waits for it.

#include <optional>

#include "cloth_energy.h"
#include "contact.h"
#include "garmentfit/progress.h"
#include "weld.h"

namespace garmentfit {

constexpr double k_gravity = 9.81;  ///< m/s^2

struct MotionStep {
    const Positions* obstacle_target;  ///< where the obstacle should go
    double largest_move = 4e-3;  ///< m; no cloth vertex goes further
    double largest_obstacle_move = 3e-3;  ///< m; no obstacle vertex goes further towards its target
    double time_step = 0.02;  ///< s
    double velocity_kept = 0;  ///< share of the cloth's velocity kept from the step before
    double gravity = 0;  ///< m/s^2, along -y
    double friction_share = 0;  ///< of the cloth's own friction
    double contact_stiffness = 3;  ///< times that of the cloth; more pushes harder, and takes longer to balance
    int iterations = 6;  ///< steps of descent towards the minimum of the energy
};

class ClothMotion {
public:
    /// The start must be free of crossings between cloth and obstacle; `start` is n x 3, the obstacle m x 3. Where the
    /// cloth crosses itself it is parted first, as far as it can be (see untangle.h).
    ClothMotion(const GarmentMesh& rest, const Positions& start, const TriangleMesh& obstacle,
                const ClothOptions& options);

    /// From now on the cloth wants this rest shape: the same garment in another size.
    void set_rest(const GarmentMesh& rest);

    /// Moves cloth and obstacle together by these displacements (n x 3, m x 3), as far as each vertex freely may. What was
    /// lagging before keeps its lag, and nothing is left behind by it.
    void advect(const Positions& cloth, const Positions& obstacle);

    /// Moves the obstacle towards a target, as far as each vertex freely may, while the cloth stands still.
    /// @return as advance()
    double advect_obstacle(const Positions& target);

    /// Lets the obstacle go to its target and the cloth find its rest around it.
    /// @return the longest way that an obstacle vertex still has to its target, metres
    double advance(const MotionStep& step);

    /// Everything's place, to be put back there later.
    const Positions& state() const { return x_; }
    /// Puts cloth and obstacle back where they were, at rest.
    void restore(const Positions& state);

    Positions cloth() const;  ///< as the garment's own vertices, n x 3
    Positions obstacle() const;  ///< m x 3
    const ClothSeconds& seconds() const { return seconds_; }
    double speed() const;  ///< m/s, of the fastest vertex of the cloth
    int vertices() const { return weld_.given(); }  ///< of the garment

private:
    struct Touch;
    void move(const Positions& displacements);
    Margins touching() const;
    double snap_obstacle(const Positions& target);
    Positions relaxed(const MotionStep& step, const Positions& displacements);
    std::vector<Touch> touches(const Positions& wished) const;
    std::vector<Press> presses(const std::vector<Touch>& touches, const Positions& wished,
                               const MotionStep& step) const;

    ClothOptions options_;
    Material material_;
    Weld weld_;
    GarmentMesh rest_;  // welded
    int cloth_vertices_;
    double off_itself_;  // m; the contact distance of cloth and cloth
    Contact contact_;
    Positions x_;  // cloth, then obstacle
    std::vector<std::pair<int, int>> ties_;  // across what crosses at the start, and of loose parts
    std::optional<ClothEnergy> energy_;  // made when the ties are known
    Positions velocity_;  // of the cloth, m/s
    ClothSeconds seconds_;
};

/// Repeats a step until the whole obstacle is at its target, for as long as is worth waiting: before the bridges over creases are
/// drawn back, say, for where a bridge is not closed, cloth would go in. @return as advance()
double step_until_converged(ClothMotion& motion, const MotionStep& step);

struct Settled {
    bool arrived;  ///< the whole obstacle at its target
    double speed;  ///< m/s, of the fastest vertex of the cloth
};

/// Hangs the cloth on the obstacle under gravity, for so many time steps and some more where parts of it are still held back.
/// @param to_rest  time steps more, at most, until no vertex is faster than k_at_rest
Settled settle(ClothMotion& motion, const Positions& target, int steps, int to_rest, const Progress& progress);

}  // namespace garmentfit
