// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Hands follow their forearms stiffly, for no bone moves them. A hand that is bent in the body's own pose (on a hip, say) may stand
// across a sleeve; then it is stretched out while garments are put on, as people do, and bent back on the way to the own pose.

#include <array>

#include "extremity_skin.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

class StraightHands {
public:
    /// Of the left and the right hand the share of its bend that is taken back: 0 as in the own pose, 1 along the forearm.
    using Stretch = std::array<double, 2>;

    /// @param own  the body's vertices in its own pose, n x 3; both must outlive this
    StraightHands(const Rig& rig, const Positions& own);

    /// Stretches out the hands that, bent, pass through a garment when the body is in a pose, and that are clear of it when straight, wrist to
    /// fingertip.
    Stretch clear_of(const GarmentMesh& garment, const Pose& pose) const;
    /// The stretch with which the body was left in a pose (n x 3; none: as in the own pose).
    Stretch of(const Positions& left, const Pose& pose) const;

    /// The vertices in the own pose but for the hands; bit for bit those of the own pose where nothing is stretched. O(n).
    Positions stretched(const Stretch& stretch) const;
    /// The joints likewise.
    Skeleton skeleton(const Stretch& stretch) const;

private:
    struct Hand {
        ExtremityBend bend;  // in the own pose
        Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  // from bent to straight
        std::vector<std::pair<int, double>> skin {};  // vertices, and how far they belong to the hand
    };
    Positions pose_skeleton(const Stretch& stretch, const Pose& pose) const;

    const Rig& rig_;
    const Positions& own_;
    std::array<Hand, 2> hands_;  // a stump has no skin to turn
};

}  // namespace garmentfit
