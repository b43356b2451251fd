// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Generalized winding number: 1 well inside an outward surface, 0 outside, with a smooth transition at openings.
//
// Method  exact solid angles near by, one dipole per tree node far away [barill_2018_fast_winding_numbers].
// Cost    O(n log n) once, O(log n) a query.

#include "median_tree.h"

namespace garmentfit {

class WindingNumber {
public:
    explicit WindingNumber(const TriangleMesh& surface);

    double operator()(const Vec3& query) const;

private:
    struct Dipole : TreeNode {
        Vec3 centre = Vec3::Zero();  // of area
        Vec3 area_vector = Vec3::Zero();  // sum of area times normal
        double radius = 0;  // of a ball about `centre` with all of the node's triangles
    };
    struct Triangle {
        Eigen::Matrix3d corners;  // one a column
        Vec3 sum;  // of the corners
    };
    static Dipole dipole_of(std::span<const Triangle> triangles);

    MedianTree<Triangle, Dipole> tree_;
};

/// The same for a few queries: the exact sum of all solid angles, without a tree.
double winding_number(const TriangleMesh& surface, const Vec3& query);

}  // namespace garmentfit
