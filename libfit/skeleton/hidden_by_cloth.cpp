// SPDX-License-Identifier: GPL-3.0-or-later
#include "hidden_by_cloth.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "depth_picture.h"
#include "parallel.h"

namespace garmentfit {
namespace {

/// Where a ray meets cloth first; and last, which a ray the other way meets first.
struct Depths {
    float first = std::numeric_limits<float>::infinity(), last = -std::numeric_limits<float>::infinity();
};

}  // namespace

TriangleMesh joined(const std::vector<TriangleMesh>& clothes)
{
    Eigen::Index vertices = 0, faces = 0;
    for (const TriangleMesh& cloth : clothes) {
        vertices += cloth.positions.rows();
        faces += cloth.triangles.rows();
    }
    TriangleMesh all { Positions(vertices, 3), Triangles(faces, 3) };
    vertices = faces = 0;
    for (const auto& [positions, triangles] : clothes) {
        all.positions.middleRows(vertices, positions.rows()) = positions;
        all.triangles.middleRows(faces, triangles.rows()) = triangles.array() + int(vertices);
        vertices += positions.rows();
        faces += triangles.rows();
    }
    return all;
}

std::vector<Vec3> viewing_directions(int count, int phase, int phases)
{
    std::vector<Vec3> directions;
    const int all = count * phases;  // every so many directions of one Fibonacci lattice
    for (int i = phase; i < all; i += phases) {
        const double height = (i + 0.5) / all, radius = std::sqrt(1 - height * height);
        const double turn = 2 * std::numbers::pi * i / std::numbers::phi;
        directions.emplace_back(radius * std::cos(turn), height, radius * std::sin(turn));
    }
    return directions;
}

Eigen::VectorXd shares_hidden_by_cloth(const TriangleMesh& body, const TriangleMesh& cloth,
                                       const std::vector<Vec3>& directions, double pixel)
{
    const Positions normals = vertex_normals(body.positions, body.triangles);
    std::vector<std::atomic<int>> hidden(std::size_t(normals.rows()));
    parallel_for(directions.size(), [&](std::size_t i) {
        const PictureFrame frame(directions[i], pixel, body.positions);
        std::vector<Depths> depths(frame.pixels());
        paint_triangles(frame, frame.project(cloth.positions), cloth.triangles,
                        [&](std::size_t at, float depth, int, bool) {
                            Depths& here = depths[at];
                            here = { std::min(here.first, depth), std::max(here.last, depth) };
                        });
        const Positions places = frame.project(body.positions);
        for (Eigen::Index v = 0; v < normals.rows(); ++v) {
            const Eigen::RowVector3d place = places.row(v);
            const Depths& here = depths[std::size_t(place.y()) * std::size_t(frame.width()) + std::size_t(place.x())];
            const bool looks_along = normals.row(v).dot(directions[i]) < 0;
            if (looks_along ? here.first < place.z() : here.last > place.z())
                hidden[std::size_t(v)].fetch_add(1, std::memory_order_relaxed);
        }
    });
    Eigen::VectorXd shares(normals.rows());
    for (Eigen::Index v = 0; v < shares.size(); ++v)
        shares[v] = hidden[std::size_t(v)] / double(directions.size());
    return shares;
}

}  // namespace garmentfit
