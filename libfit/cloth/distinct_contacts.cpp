// SPDX-License-Identifier: GPL-3.0-or-later
#include "distinct_contacts.h"

#include <algorithm>
#include <tuple>

namespace garmentfit {
namespace {

// Whether the closest point of a vertex's triangle lies on a border that it has in common with another triangle.
bool touches_border_of(const ContactPair& pair, const ContactPair& other)
{
    for (int k = 1; k < 4; ++k)
        if (pair.at.weights[k] != 0
            && std::find(other.vertices.begin() + 1, other.vertices.end(), pair.vertices[k]) == other.vertices.end())
            return false;
    return true;
}

// Where two edges are nearly parallel, their closest points jump along them, and faces tell the contact better.
bool are_parallel(const ContactPair& pair, const Positions& x)
{
    constexpr double k_sine_square = 1e-2;  // unit: six degrees
    const Corners c = corners_of(x, pair.vertices);
    const Vec3 a = c[1] - c[0], b = c[3] - c[2];
    return a.cross(b).squaredNorm() < k_sine_square * a.squaredNorm() * b.squaredNorm();
}

}  // namespace

int vertices_at(const ContactPair& pair, int begin, int end)
{
    return int(std::count_if(pair.at.weights.begin() + begin, pair.at.weights.begin() + end,
                             [](double weight) { return weight != 0; }));
}

DistinctContacts distinct_contacts(const std::vector<ContactPair>& pairs, const Positions& x)
{
    std::vector<ContactPair> edges, faces;
    DistinctContacts contacts;
    for (const ContactPair& pair : pairs)
        if (pair.kind == PairKind::vertex_face)
            faces.push_back(pair);
        else if (vertices_at(pair, 0, 2) == 2 && vertices_at(pair, 2, 4) == 2 && !are_parallel(pair, x))
            edges.push_back(pair);
        else
            contacts.repeated.push_back(pair);
    std::stable_sort(faces.begin(), faces.end(), [](const ContactPair& a, const ContactPair& b) {
        return std::tie(a.vertices[0], a.at.distance) < std::tie(b.vertices[0], b.at.distance);
    });
    std::vector<ContactPair>& result = contacts.distinct;
    std::size_t first = 0;  // of the vertex, in result
    for (const ContactPair& pair : faces) {
        if (result.empty() || result.back().vertices[0] != pair.vertices[0])
            first = result.size();
        const bool is_repeated = vertices_at(pair, 1, 4) < 3
            && std::any_of(result.begin() + std::ptrdiff_t(first), result.end(),
                           [&](const ContactPair& nearer) { return touches_border_of(pair, nearer); });
        (is_repeated ? contacts.repeated : result).push_back(pair);
    }
    result.insert(result.end(), edges.begin(), edges.end());
    return contacts;
}

}  // namespace garmentfit
