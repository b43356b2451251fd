// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What lies side by side at rest moves alike: edges of cloth, and links between sheets that nearly touch.

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "garmentfit/types.h"
#include "topology.h"

namespace garmentfit {

/// The vertices of cloth, linked by its edges and to those near them at rest, of whatever part.
class SideBySide {
public:
    /// @param rest   n x 3, metres
    /// @param moved  n x 3, metres, roughly where they go: what goes far apart only touched, as a sleeve and the trunk
    SideBySide(const Positions& rest, const MeshTopology& topology, const Positions& moved);

    /// Marks also what is within so many links of the marked vertices.
    void spread(std::vector<char>& marks, int links) const;

    /// Makes a field as even as it can be at marked vertices: there it is harmonic on the links, which count by 1 /
    /// length. All others keep their values. Cost: a sparse factor of the marked vertices.
    /// @param field  n x k
    /// @param hold   how much a marked vertex's own value counts, in shares of all its links. Has to be above 0 where no
    ///               link leads from marked vertices to others
    Eigen::MatrixXd evened(const Eigen::MatrixXd& field, const std::vector<char>& marks, double hold) const;

private:
    struct Link {
        int to;
        double weight;
    };
    std::vector<std::vector<Link>> links_;  // by vertex; both ways
};

}  // namespace garmentfit
