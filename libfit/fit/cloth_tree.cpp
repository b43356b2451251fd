// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 4;
constexpr int k_parts = 8;  // of a block
constexpr float k_pi = float(std::numbers::pi);
constexpr float k_far = 1.4f;  // radii; beyond, a dipole is good to some per cent
constexpr float k_tolerance = 1.1f;  // of a distance
constexpr int k_largest_parts = 40;  // of a triangle's side
constexpr double k_largest_grid = 4e6;  // cells

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

}  // namespace

std::vector<ClothPatch> cloth_patches(const TriangleMesh& outward, double cell)
{
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

ClothTree::ClothTree(std::vector<ClothPatch> patches) : patches_(std::move(patches))
{
    balls_.reserve(patches_.size());
    build(0, int(patches_.size()));
}

int ClothTree::build(int begin, int end)
{
    const int here = int(balls_.size());
    balls_.emplace_back();
    Ball ball { Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), 0, 0, begin, end, 0 };
    Eigen::AlignedBox3f box;
    for (int i = begin; i < end; ++i) {
        const float area = patches_[i].area_vector.norm();
        ball.centre += area * patches_[i].centre;
        ball.area_vector += patches_[i].area_vector;
        ball.size += area;
        box.extend(patches_[i].centre);
    }
    ball.centre = ball.size > 0 ? Eigen::Vector3f(ball.centre / ball.size) : Eigen::Vector3f(box.center());
    for (int i = begin; i < end; ++i)
        ball.radius = std::max(ball.radius, (patches_[i].centre - ball.centre).norm());
    if (end - begin > k_leaf_size) {
        int axis = 0;
        box.sizes().maxCoeff(&axis);
        const int middle = begin + (end - begin) / 2;
        std::nth_element(patches_.begin() + begin, patches_.begin() + middle, patches_.begin() + end,
                         [axis](const ClothPatch& a, const ClothPatch& b) { return a.centre[axis] < b.centre[axis]; });
        build(begin, middle);
        ball.right = build(middle, end);
    }
    balls_[here] = ball;
    return here;
}

float ClothTree::distance(const Vec3& query) const
{
    float nearest = std::numeric_limits<float>::infinity();
    look_into(0, query.cast<float>(), nearest);
    return nearest;
}

void ClothTree::look_into(int b, const Eigen::Vector3f& query, float& nearest) const
{
    const Ball& ball = balls_[b];
    if (ball.right == 0) {
        for (int i = ball.begin; i < ball.end; ++i)
            nearest = std::min(nearest, (patches_[i].centre - query).norm());
        return;
    }
    const auto least = [&](int child) { return (balls_[child].centre - query).norm() - balls_[child].radius; };
    int first = b + 1, second = ball.right;
    float to_first = least(first), to_second = least(second);
    if (to_second < to_first) {
        std::swap(first, second);
        std::swap(to_first, to_second);
    }
    if (k_tolerance * to_first < nearest)
        look_into(first, query, nearest);
    if (k_tolerance * to_second < nearest)
        look_into(second, query, nearest);
}

// The dipole of a patch softened over the size of its disc, so that it does not blow up at its middle.
float softened_angle(const ClothPatch& patch, const Eigen::Vector3f& query)
{
    const Eigen::Vector3f to = patch.centre - query;
    const float squared = to.squaredNorm() + patch.area_vector.norm() / k_pi;
    return patch.area_vector.dot(to) / (squared * std::sqrt(squared));
}

float ClothTree::winding(const Vec3& query) const
{
    const Eigen::Vector3f q = query.cast<float>();
    float angle = 0;
    std::array<int, 64> stack;  // deeper than any tree of 2^31 patches halved at each level
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const int b = stack[--size];
        const Ball& ball = balls_[b];
        const Eigen::Vector3f to = ball.centre - q;
        const float squared = to.squaredNorm(), far = k_far * ball.radius;
        if (squared > far * far && squared > ball.size) {
            angle += ball.area_vector.dot(to) / (squared * std::sqrt(squared));
        } else if (ball.right == 0) {
            for (int i = ball.begin; i < ball.end; ++i)
                angle += softened_angle(patches_[i], q);
        } else {
            stack[size++] = ball.right;
            stack[size++] = b + 1;
        }
    }
    return angle / (4 * k_pi);
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

// Those no further than `reach` from the centre.
void ClothTree::gather(int b, const Eigen::Vector3f& centre, float reach, std::vector<int>& patches) const
{
    const Ball& ball = balls_[b];
    if ((ball.centre - centre).norm() > reach + ball.radius)
        return;
    if (ball.right != 0) {
        gather(b + 1, centre, reach, patches);
        gather(ball.right, centre, reach, patches);
        return;
    }
    for (int i = ball.begin; i < ball.end; ++i)
        if ((patches_[i].centre - centre).squaredNorm() <= reach * reach)
            patches.push_back(i);
}

// A patch further from a cube's centre than the nearest one and the cube's diameter is nearest to none of its nodes: so few are asked by the
// whole block, and of those fewer by each of its eight parts.
ClothTree::Values ClothTree::squared_distances(const Nodes& nodes) const
{
    constexpr float rounding = 1.0001f;
    std::vector<int> some;
    gather(0, nodes.centre, rounding * (distance(nodes.centre.cast<double>()) + 2 * nodes.radius), some);
    Eigen::Array<float, Eigen::Dynamic, 3> centres(Eigen::Index(some.size()), 3);
    for (std::size_t i = 0; i < some.size(); ++i)
        centres.row(Eigen::Index(i)) = patches_[some[i]].centre.transpose();

    Values squared = Values::Constant(std::numeric_limits<float>::max());
    Eigen::ArrayXf to_middle;
    for (int part = 0; part < k_parts; ++part) {
        const Nodes::Part cube = nodes.part(part);
        to_middle = (centres.col(0) - cube.centre.x()).square() + (centres.col(1) - cube.centre.y()).square()
            + (centres.col(2) - cube.centre.z()).square();
        const float reach = rounding * (std::sqrt(to_middle.minCoeff()) + 2 * cube.radius);
        auto least = Nodes::PartValues(Nodes::PartValues::Constant(std::numeric_limits<float>::max()));
        for (Eigen::Index i = 0; i < to_middle.size(); ++i)
            if (to_middle[i] <= reach * reach)
                least = least.min(cube.squared_distances(centres.row(i)));
        for (int i = 0; i < k_parts; ++i)
            squared[Nodes::node_of(part, i)] = least[i];
    }
    return squared;
}

void ClothTree::add_windings(int b, const Nodes& nodes, Values& angles) const
{
    const Ball& ball = balls_[b];
    const float distance = (ball.centre - nodes.centre).norm() - nodes.radius;
    if (distance > k_far * ball.radius && distance > std::sqrt(ball.size)) {
        angles += nodes.angles(ball.area_vector, ball.centre, 0);
    } else if (ball.right != 0) {
        add_windings(b + 1, nodes, angles);
        add_windings(ball.right, nodes, angles);
    } else {
        for (int i = ball.begin; i < ball.end; ++i)
            angles += nodes.angles(patches_[i].area_vector, patches_[i].centre, patches_[i].area_vector.norm() / k_pi);
    }
}

ClothTree::Block ClothTree::block(const Vec3& first_node, double spacing) const
{
    const Nodes nodes(first_node, spacing);
    Block result { squared_distances(nodes).sqrt(), Values::Zero() };
    add_windings(0, nodes, result.windings);
    result.windings /= 4 * k_pi;
    return result;
}

}  // namespace garmentfit
