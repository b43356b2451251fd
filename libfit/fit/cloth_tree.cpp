// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tuning.h"

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 4;  // unit: decides speed, and single precision of windings
constexpr int k_parts = 8;  // derived: cubes of 2 x 2 x 2 nodes in a block of 4 x 4 x 4
constexpr float k_pi = float(std::numbers::pi);  // derived
constexpr int k_largest_parts = 40;  // unit: of a triangle's side; bounds the time for huge triangles
constexpr double k_largest_grid = 4e6;  // unit: cells; bounds the memory

// Calls visit(middle, area vector) for parts of a triangle that are no larger than a cell.
template <class Visit>
void for_each_part(const std::array<Vec3, 3>& corner, double cell, const Visit& visit)
{
    const double longest
        = std::max({ (corner[0] - corner[1]).norm(), (corner[1] - corner[2]).norm(), (corner[2] - corner[0]).norm() });
    const int n = std::clamp(int(std::ceil(longest / cell)), 1, k_largest_parts);
    const Vec3 u = (corner[1] - corner[0]) / n, v = (corner[2] - corner[0]) / n, area = 0.5 * u.cross(v);
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            visit(Vec3(corner[0] + (i + 1.0 / 3) * u + (j + 1.0 / 3) * v), area);
            if (i + j + 1 < n)  // the upside-down one beside it
                visit(Vec3(corner[0] + (i + 2.0 / 3) * u + (j + 2.0 / 3) * v), area);
        }
}

// The dipole of a patch softened over the size of its disc, so that it does not blow up at its middle.
float softened_angle(const ClothPatch& patch, const Eigen::Vector3f& query)
{
    const Eigen::Vector3f to = patch.centre - query;
    const float squared = to.squaredNorm() + patch.area_vector.norm() / k_pi;
    return patch.area_vector.dot(to) / (squared * std::sqrt(squared));
}

}  // namespace

std::vector<ClothPatch> cloth_patches(const TriangleMesh& outward, double cell)
{
    if (outward.triangles.rows() == 0)
        return {};
    const Vec3 low = outward.positions.colwise().minCoeff(), size = Vec3(outward.positions.colwise().maxCoeff()) - low;
    cell = std::max(cell, std::cbrt(size.prod() / k_largest_grid));
    const Eigen::Vector3i cells = (size / cell).cast<int>() + Eigen::Vector3i::Ones();
    std::vector<int> patch_of(std::size_t(cells.x()) * cells.y() * cells.z(), -1);
    std::vector<ClothPatch> patches;
    std::vector<float> areas;
    for (Eigen::Index f = 0; f < outward.triangles.rows(); ++f) {
        const std::array<Vec3, 3> corner { outward.positions.row(outward.triangles(f, 0)),
                                           outward.positions.row(outward.triangles(f, 1)),
                                           outward.positions.row(outward.triangles(f, 2)) };
        for_each_part(corner, cell, [&](const Vec3& middle, const Vec3& area_vector) {
            const Eigen::Vector3i c = ((middle - low) / cell).cast<int>();
            int& patch = patch_of[(std::size_t(c.z()) * cells.y() + c.y()) * cells.x() + c.x()];
            if (patch < 0) {
                patch = int(patches.size());
                patches.push_back({ Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero() });
                areas.push_back(0);
            }
            const float area = float(area_vector.norm());
            patches[patch].centre += area * middle.cast<float>();
            patches[patch].area_vector += area_vector.cast<float>();
            areas[patch] += area;
        });
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
        patches[i].centre /= std::max(areas[i], std::numeric_limits<float>::min());
    return patches;
}

ClothTree::Ball ClothTree::ball_of(std::span<const ClothPatch> patches)
{
    Ball ball { {}, Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), 0, 0 };
    for (const ClothPatch& patch : patches) {
        const float area = patch.area_vector.norm();
        ball.centre += area * patch.centre;
        ball.area_vector += patch.area_vector;
        ball.size += area;
    }
    if (ball.size > 0) {
        ball.centre = Eigen::Vector3f(ball.centre / ball.size);
    } else {
        Eigen::AlignedBox3f box;
        for (const ClothPatch& patch : patches)
            box.extend(patch.centre);
        ball.centre = box.center();
    }
    for (const ClothPatch& patch : patches)
        ball.radius = std::max(ball.radius, (patch.centre - ball.centre).norm());
    return ball;
}

ClothTree::Tree ClothTree::tree_of(std::vector<ClothPatch> patches)
{
    return { std::move(patches), k_leaf_size,
             [](const ClothPatch& patch) -> const Eigen::Vector3f& { return patch.centre; }, ball_of };
}

ClothTree::ClothTree(std::vector<ClothPatch> patches, std::vector<ClothPatch> lids) :
    tree_(tree_of(std::move(patches))), lids_(tree_of(std::move(lids)))
{
}

float ClothTree::distance(const Vec3& query) const
{
    const Eigen::Vector3f q = query.cast<float>();
    float nearest = std::numeric_limits<float>::infinity();
    tree_.walk_nearest_first([&](const Ball& ball) { return (ball.centre - q).norm() - ball.radius; },
                             [&](float distance) { return k_distance_tolerance * distance < nearest; },
                             [&](const Ball& leaf) {
                                 for (const ClothPatch& patch : tree_.items(leaf))
                                     nearest = std::min(nearest, (patch.centre - q).norm());
                             });
    return nearest;
}

float ClothTree::winding(const Vec3& query) const
{
    const Eigen::Vector3f q = query.cast<float>();
    return (angle(tree_, q) + angle(lids_, q)) / (4 * k_pi);
}

float ClothTree::angle(const Tree& tree, const Eigen::Vector3f& query)
{
    float angle = 0;
    tree.walk(
        [&](const Ball& ball) {
            const Eigen::Vector3f to = ball.centre - query;
            const float squared = to.squaredNorm(), far = k_far_dipole * ball.radius;
            if (!(squared > far * far && squared > ball.size))
                return true;
            angle += ball.area_vector.dot(to) / (squared * std::sqrt(squared));
            return false;
        },
        [&](const Ball& leaf) {
            for (const ClothPatch& patch : tree.items(leaf))
                angle += softened_angle(patch, query);
            return true;
        });
    return angle;
}

struct ClothTree::Nodes {
    Nodes(const Vec3& first_node, double spacing) : radius(float(0.5 * (k - 1) * spacing * std::sqrt(3.0)))
    {
        centre = (first_node + Vec3::Constant(0.5 * (k - 1) * spacing)).cast<float>();
        for (int i = 0; i < k * k * k; ++i) {
            x[i] = float(first_node.x() + spacing * (i % k));
            y[i] = float(first_node.y() + spacing * (i / k % k));
            z[i] = float(first_node.z() + spacing * (i / (k * k)));
        }
    }
    Values squared_distances(const Eigen::Vector3f& p) const
    {
        return (p.x() - x).square() + (p.y() - y).square() + (p.z() - z).square();
    }
    Values angles(const Eigen::Vector3f& area_vector, const Eigen::Vector3f& p, float softening) const
    {
        const Values squared = squared_distances(p) + softening;
        return (area_vector.x() * (p.x() - x) + area_vector.y() * (p.y() - y) + area_vector.z() * (p.z() - z))
            / (squared * squared.sqrt());
    }

    /// One of the eight cubes of 2 x 2 x 2 nodes.
    using PartValues = Eigen::Array<float, k_parts, 1>;
    struct Part {
        PartValues x, y, z;
        Eigen::Vector3f centre;
        float radius;
        PartValues squared_distances(const Eigen::Array<float, 1, 3>& p) const
        {
            return (p.x() - x).square() + (p.y() - y).square() + (p.z() - z).square();
        }
    };
    static int node_of(int part, int i)  // bits of both numbers: z, y, x
    {
        const auto along = [&](int axis) { return 2 * (part >> axis & 1) + (i >> axis & 1); };
        return (along(2) * k + along(1)) * k + along(0);
    }
    Part part(int number) const
    {
        Part part;
        for (int i = 0; i < k_parts; ++i) {
            const int node = node_of(number, i);
            part.x[i] = x[node];
            part.y[i] = y[node];
            part.z[i] = z[node];
        }
        part.centre = { part.x.mean(), part.y.mean(), part.z.mean() };
        part.radius = radius / (k - 1);
        return part;
    }

    Values x, y, z;
    Eigen::Vector3f centre;
    float radius;
};

// A patch further from the centre of a cube than the nearest patch plus the diameter of the cube is nearest to none of
// its nodes. The whole block collects candidates by this rule, and each of its eight parts selects from them.
ClothTree::Values ClothTree::squared_distances(const Nodes& nodes) const
{
    constexpr float rounding = 1.0001f;  // unit: more than the distances of a node may be rounded by
    const float reach = rounding * (distance(nodes.centre.cast<double>()) + 2 * nodes.radius);
    std::vector<int> some;
    tree_.walk([&](const Ball& ball) { return !((ball.centre - nodes.centre).norm() > reach + ball.radius); },
               [&](const Ball& leaf) {
                   for (int i = leaf.begin; i < leaf.end; ++i)
                       if ((patches()[i].centre - nodes.centre).squaredNorm() <= reach * reach)
                           some.push_back(i);
                   return true;
               });
    Eigen::Array<float, Eigen::Dynamic, 3> centres(Eigen::Index(some.size()), 3);
    for (std::size_t i = 0; i < some.size(); ++i)
        centres.row(Eigen::Index(i)) = patches()[some[i]].centre.transpose();

    Values squared = Values::Constant(std::numeric_limits<float>::max());
    Eigen::ArrayXf to_middle;
    for (int part = 0; part < k_parts; ++part) {
        const Nodes::Part cube = nodes.part(part);
        to_middle = (centres.col(0) - cube.centre.x()).square() + (centres.col(1) - cube.centre.y()).square()
            + (centres.col(2) - cube.centre.z()).square();
        const float part_reach = rounding * (std::sqrt(to_middle.minCoeff()) + 2 * cube.radius);
        auto least = Nodes::PartValues(Nodes::PartValues::Constant(std::numeric_limits<float>::max()));
        for (Eigen::Index i = 0; i < to_middle.size(); ++i)
            if (to_middle[i] <= part_reach * part_reach)
                least = least.min(cube.squared_distances(centres.row(i)));
        for (int i = 0; i < k_parts; ++i)
            squared[Nodes::node_of(part, i)] = least[i];
    }
    return squared;
}

ClothTree::Values ClothTree::angles(const Tree& tree, const Nodes& nodes)
{
    Values angles = Values::Zero();
    tree.walk(
        [&](const Ball& ball) {
            const float distance = (ball.centre - nodes.centre).norm() - nodes.radius;
            if (!(distance > k_far_dipole * ball.radius && distance > std::sqrt(ball.size)))
                return true;
            angles += nodes.angles(ball.area_vector, ball.centre, 0);
            return false;
        },
        [&](const Ball& leaf) {
            for (const ClothPatch& patch : tree.items(leaf))
                angles += nodes.angles(patch.area_vector, patch.centre, patch.area_vector.norm() / k_pi);
            return true;
        });
    return angles;
}

ClothTree::Block ClothTree::block(const Vec3& first_node, double spacing) const
{
    const Nodes nodes(first_node, spacing);
    return { squared_distances(nodes).sqrt(), (angles(tree_, nodes) + angles(lids_, nodes)) / (4 * k_pi) };
}

}  // namespace garmentfit
