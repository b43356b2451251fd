// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dry friction while cloth looks for its rest. A vertex that touches something is held by a spring to the place where it
// touched first, its anchor. It slides where the spring would pull harder than the friction coefficient times the normal
// force, and then is pulled just as hard, however far it slides.
//
// An anchor stays where it is while forces are balanced: positions on the way there are no motions of the cloth, and
// must not wear it off its holds. Then those of the vertices that slid follow. What slides is held less than what
// sticks, so cloth that has come to rest after sliding does not begin to slide again.
//
// Units   metres, newtons. Positions are n x 3.

#include <array>
#include <optional>
#include <vector>

#include "soft_constraint.h"

namespace garmentfit {

class FrictionAnchors {
public:
    /// A vertex presses on what stands still (corners -1), or on a triangle of the cloth itself.
    struct ActiveContact {
        int vertex;
        std::array<int, 3> corners;
        std::array<double, 3> weights;  ///< barycentric, of the nearest point
        Vec3 force;  ///< N, on the vertex, along the normal
        double friction;  ///< coefficient
        double stiffness;  ///< N/m, of the spring
    };

    explicit FrictionAnchors(Eigen::Index vertices) : anchors_(2 * std::size_t(vertices)) { }

    /// The contacts now, at most one for each vertex and kind. Contacts without an anchor get one, here. Friction takes
    /// the mean of the normal forces now and before: those now are an answer to the friction before, and where they
    /// overshoot, both would go to and fro.
    void set_active_contacts(std::vector<ActiveContact> contacts, const Positions& x);

    /// The friction forces on the cloth at x, under the normal forces of the contacts.
    /// @param share  of the friction coefficients beyond which a vertex slides
    std::vector<SoftConstraint> constraints(const Positions& x, double share) const;

    /// Lets the anchors of what slides follow, and forgets those of what no longer touches.
    void follow(const Positions& x, double share);

private:
    struct Anchor {
        std::array<int, 3> corners;
        std::array<double, 3> weights;
        Vec3 place;  // relative to the point of the triangle, if there is one
    };
    static std::size_t index_of(const ActiveContact& contact)
    {
        return 2 * std::size_t(contact.vertex) + (contact.corners[0] >= 0);
    }
    static Vec3 offset(int vertex, const Anchor& anchor, const Positions& x);

    std::vector<std::optional<Anchor>> anchors_;
    std::vector<ActiveContact> contacts_;
};

}  // namespace garmentfit
