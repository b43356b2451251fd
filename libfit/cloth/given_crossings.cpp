// SPDX-License-Identifier: GPL-3.0-or-later
#include "given_crossings.h"

#include <algorithm>
#include <array>

#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// unit: a fraction of the edge and of the triangle. What crosses nearer to a border may come out of any rounding as
// crossing or as not.
constexpr double k_inside_margin = 1e-7;

/// Where an edge meets a triangle, by the shares of their corners.
struct MeetingPlace {
    double along;  ///< from the first end of the edge
    std::array<double, 3> corners;
};

MeetingPlace meeting_place(const Positions& positions, const Triangles& triangles, const Edges& edges,
                           const Crossing& crossing)
{
    const auto corner = [&](int k) { return Vec3(positions.row(triangles(crossing.second, k))); };
    const Vec3 p = positions.row(edges(crossing.first, 0)), q = positions.row(edges(crossing.first, 1));
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const double along = (corner(0) - p).dot(normal) / (q - p).dot(normal);
    const Vec3 place = p + along * (q - p);
    const auto share = [&](int k) {
        const Vec3 from = corner((k + 1) % 3), to = corner((k + 2) % 3);
        return (to - from).cross(place - from).dot(normal) / normal.squaredNorm();
    };
    return { along, { share(0), share(1), share(2) } };
}

// Well inside both of them.
bool surely_crosses(const MeetingPlace& place)
{
    const auto is_inside = [](double share) { return share > k_inside_margin; };
    return is_inside(place.along) && is_inside(1 - place.along)
        && std::all_of(place.corners.begin(), place.corners.end(), is_inside);
}

// Two triangles cross along a segment, at whose ends an edge of one meets the other one.
class SureSegments {
public:
    SureSegments(const MeshTopology& topology, const std::vector<Crossing>& sure) : topology_(topology)
    {
        for (const Crossing& crossing : sure)
            add_segments(crossing, pairs_);
        std::sort(pairs_.begin(), pairs_.end());
    }

    bool continue_at(const Crossing& crossing) const
    {
        std::vector<Pair> at;
        add_segments(crossing, at);
        return std::any_of(at.begin(), at.end(),
                           [&](const Pair& pair) { return std::binary_search(pairs_.begin(), pairs_.end(), pair); });
    }

private:
    using Pair = std::pair<int, int>;  // of triangles, the smaller number first

    void add_segments(const Crossing& crossing, std::vector<Pair>& pairs) const
    {
        for (const int side : topology_.sides_at(crossing.first))
            pairs.push_back(std::minmax(side / 3, crossing.second));
    }

    const MeshTopology& topology_;
    std::vector<Pair> pairs_;
};

bool is_among(const std::vector<Crossing>& known, const Crossing& crossing)
{
    return std::binary_search(known.begin(), known.end(), crossing);
}

}  // namespace

Vec3 offset_at_rest(const TriangleMesh& rest, const Edges& edges, const Positions& positions, const Crossing& crossing)
{
    const auto [along, corners] = meeting_place(positions, rest.triangles, edges, crossing);
    const auto& [edge, triangle] = crossing;
    Vec3 offset = (1 - along) * rest.positions.row(edges(edge, 0)) + along * rest.positions.row(edges(edge, 1));
    for (int k = 0; k < 3; ++k)
        offset -= corners[k] * rest.positions.row(rest.triangles(triangle, k)).transpose();
    return offset;
}

GivenCrossings::GivenCrossings(const TriangleMesh& given, const Edges& edges, const std::vector<Crossing>& crossings) :
    given_(given), edges_(edges), count_(crossings.size())
{
    std::vector<Crossing> touching;
    for (const Crossing& crossing : crossings) {
        const MeetingPlace place = meeting_place(given.positions, given.triangles, edges, crossing);
        (surely_crosses(place) ? sure_ : touching).push_back(crossing);
    }
    largest_gap_ = k_shifted_gap * diagonal(given.positions);
    if (sure_.empty() || touching.empty())
        return;
    const MeshTopology topology(given.triangles, int(given.positions.rows()));
    const SureSegments segments(topology, sure_);
    std::copy_if(touching.begin(), touching.end(), std::back_inserter(touching_),
                 [&](const Crossing& crossing) { return segments.continue_at(crossing); });
}

// The two places that meet now lay on each other at rest. Cloth that was given without crossings has none forgiven.
bool GivenCrossings::is_shifted(const Positions& positions, const Crossing& crossing) const
{
    return !sure_.empty() && offset_at_rest(given_, edges_, positions, crossing).norm() < largest_gap_;
}

// A pair that only touched in the input did not cross there, unless cloth crosses on both sides of it. Where more pairs
// cross now than surely did before, none that touched is known: others may count it as new. Nor is a shifted one where
// more cross than before.
ComparedCrossings GivenCrossings::compare(const Positions& positions, const std::vector<Crossing>& present) const
{
    const bool forgives_touching = present.size() <= sure_.size(), forgives_shifted = present.size() <= count_;
    ComparedCrossings result;
    for (const Crossing& crossing : present)
        if (is_among(sure_, crossing) || (forgives_touching && is_among(touching_, crossing)))
            result.kept.push_back(crossing);
        else
            (forgives_shifted && is_shifted(positions, crossing) ? result.shifted : result.fresh).push_back(crossing);
    return result;
}

std::vector<Crossing> GivenCrossings::of_cloth_apart(const Positions& positions, std::vector<Crossing> present) const
{
    std::erase_if(present, [&](const Crossing& crossing) {
        return is_among(sure_, crossing) || is_among(touching_, crossing) || is_shifted(positions, crossing);
    });
    return present;
}

}  // namespace garmentfit
