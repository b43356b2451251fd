// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Stretches bent hands out along their forearms while garments are put on.
//
// No bone moves a hand, so it keeps the bend that it has in the pose of the input (on a hip, say). A bent hand may
// stand across a sleeve. Then it is stretched out, as people do, and bent back on the path to the pose of the input
// (docs/decisions/0010-straight-hands.md).

#include <array>

#include "extremity_skin.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

class HandStretch {
public:
    /// For the left and the right hand the share of its bend that is taken back: 0 as in the pose of the input, 1 along
    /// the forearm.
    using Shares = std::array<double, 2>;

    /// @param input  the body's vertices in the pose of the input, n x 3; rig and input must outlive this
    HandStretch(const Rig& rig, const Positions& input);

    /// 1 for the hands that pass through the garment when bent, and do not from wrist to fingertip when straight; 0 for
    /// others.
    Shares find_clear_stretch(const GarmentMesh& garment, const Pose& pose) const;
    /// The stretch of a body that was left in a pose (n x 3; none: as in the pose of the input).
    Shares find_stretch(const Positions& left, const Pose& pose) const;

    /// The vertices in the pose of the input, hands stretched; bit for bit the input where nothing is stretched. O(n).
    Positions stretch_skin(const Shares& shares) const;
    /// The joints likewise.
    Skeleton stretch_skeleton(const Shares& shares) const;

private:
    struct Hand {
        ExtremityBend bend;  // in the pose of the input
        Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  // from bent to straight
        std::vector<std::pair<int, double>> skin {};  // vertices, and how far they belong to the hand
    };

    const Rig& rig_;
    const Positions& input_;
    std::array<Hand, 2> hands_;  // a stump has no skin to turn
};

}  // namespace garmentfit
