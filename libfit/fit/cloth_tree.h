// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The cloth as the fit measures it: small patches, each with its centre and its area vector, in a MedianTree of balls.
// In single precision and to a tolerance: a sixteenth of the time of an exact distance by TriangleTree, a quarter of
// that of WindingNumber, on a coat.

#include <vector>

#include "median_tree.h"

namespace garmentfit {

/// Cloth in one small cell.
struct ClothPatch {
    Eigen::Vector3f centre;  // m, of its area
    Eigen::Vector3f area_vector;  // m^2, the sum of area times normal
};

/// One patch for each cell of a grid that has cloth, so that their number depends on the cloth's area and not on its
/// vertices.
/// Cost O(n). All cloth lies within `cell` of a patch's centre.
std::vector<ClothPatch> cloth_patches(const TriangleMesh& outward, double cell);

class ClothTree {
public:
    /// @param lids  of openings, facing outwards: they count for windings, and are no cloth for distances
    /// Cost O(n log n).
    explicit ClothTree(std::vector<ClothPatch> patches, std::vector<ClothPatch> lids = {});

    /// m, to a patch's centre that is at most a tenth further away than the nearest. O(log n).
    float distance(const Vec3& query) const;

    /// Generalized winding number: 1 well inside, 0 outside, fading through openings; within a patch's size of the
    /// cloth it passes smoothly from one to the other. Method: a dipole for each patch near by, one for each ball of
    /// the tree far away [barill_2018_fast_winding_numbers]. O(log n).
    float winding(const Vec3& query) const;

    /// Both at the k x k x k nodes of a small grid, x fastest, in one walk down the tree; distances here are exact.
    static constexpr int k = 4;  // unit: decides speed, and the precision of windings
    using Values = Eigen::Array<float, k * k * k, 1>;
    struct Block {
        Values distances, windings;
    };
    Block block(const Vec3& first_node, double spacing) const;

    const std::vector<ClothPatch>& patches() const { return tree_.items(); }

private:
    struct Ball : TreeNode {
        Eigen::Vector3f centre, area_vector;
        float radius;  // of a ball about the centre with the centres of all its patches
        float size;  // sum of areas' lengths: how wide a single patch is
    };
    static Ball ball_of(std::span<const ClothPatch> patches);
    using Tree = MedianTree<ClothPatch, Ball>;
    static Tree tree_of(std::vector<ClothPatch> patches);
    struct Nodes;
    Values squared_distances(const Nodes& nodes) const;
    static float angle(const Tree& tree, const Eigen::Vector3f& query);
    static Values angles(const Tree& tree, const Nodes& nodes);

    Tree tree_, lids_;
};

}  // namespace garmentfit
