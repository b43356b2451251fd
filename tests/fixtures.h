// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small shapes that tests share, built in code.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "garmentfit/error.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit::fixtures {

/// What `run` is refused with, in the user's words; empty, and a failed test, where it is not.
inline std::string refusal(const std::function<void()>& run)
{
    try {
        run();
    } catch (const InvalidInput& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return {};
}

inline void expect_invalid(const std::function<void()>& run, const std::string& text)
{
    const std::string message = refusal(run);
    EXPECT_NE(message.find(text), std::string::npos) << message;
}

/// Skin that follows one bone only.
inline SkinWeights on_bone(Bone bone, Eigen::Index vertices)
{
    SkinWeights weights;
    weights.bones.setConstant(vertices, 4, int(bone));
    weights.weights.setZero(vertices, 4);
    weights.weights.col(0).setOnes();
    return weights;
}

/// The zero level of `distance` (negative inside) as a closed surface: marching tetrahedra on a grid of cubes, each cut
/// into six tetrahedra round its diagonal, left and right of x = 0 like mirror images. Watertight and 2-manifold as
/// long as the level keeps off the grid's border.
inline TriangleMesh polygonise(const std::function<double(const Vec3&)>& distance, const Vec3& low, const Vec3& high,
                               double spacing)
{
    using Node = std::array<int, 3>;
    const Vec3 cells = (high / spacing).array().ceil() - (low / spacing).array().floor();
    const Node n { int(cells.x()) + 1, int(cells.y()) + 1, int(cells.z()) + 1 };
    const auto id = [&](const Node& c) { return (c[2] * n[1] + c[1]) * n[0] + c[0]; };
    const Vec3 origin = spacing * (low / spacing).array().floor();
    const auto place = [&](const Node& c) { return Vec3(origin + spacing * Vec3(c[0], c[1], c[2])); };

    std::vector<double> values(std::size_t(n[0]) * n[1] * n[2]);
    for (int z = 0; z < n[2]; ++z)
        for (int y = 0; y < n[1]; ++y)
            for (int x = 0; x < n[0]; ++x) {
                const double d = distance(place({ x, y, z }));
                values[id({ x, y, z })] = d == 0 ? spacing * 1e-6 : d;
            }

    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> faces;
    std::map<std::pair<int, int>, int> cut;  // grid edge -> vertex
    const auto vertex_on = [&](Node a, Node b) {
        if (id(a) > id(b))
            std::swap(a, b);
        const auto [found, is_new] = cut.try_emplace({ id(a), id(b) }, int(points.size()));
        if (is_new) {  // kept off the ends: no slivers, same topology
            const double t = values[id(a)] / (values[id(a)] - values[id(b)]);
            points.push_back(place(a) + std::clamp(t, 0.15, 0.85) * (place(b) - place(a)));
        }
        return found->second;
    };
    const auto add_face = [&](int a, int b, int c, const Vec3& inside) {
        const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
        if (normal.dot(points[a] - inside) < 0)
            std::swap(b, c);
        faces.push_back({ a, b, c });
    };
    const auto march = [&](const std::array<Node, 4>& tet) {
        std::vector<Node> in, out;
        for (const Node& c : tet)
            (values[id(c)] < 0 ? in : out).push_back(c);
        if (in.empty() || out.empty())
            return;
        if (in.size() == 1)
            add_face(vertex_on(in[0], out[0]), vertex_on(in[0], out[1]), vertex_on(in[0], out[2]), place(in[0]));
        else if (out.size() == 1) {
            const int a = vertex_on(in[0], out[0]), b = vertex_on(in[1], out[0]), c = vertex_on(in[2], out[0]);
            add_face(a, b, c, 2 * points[a] - place(out[0]));
        } else {
            const int a = vertex_on(in[0], out[0]), b = vertex_on(in[0], out[1]), c = vertex_on(in[1], out[1]),
                      d = vertex_on(in[1], out[0]);
            const Vec3 inside = 0.5 * (place(in[0]) + place(in[1]));
            add_face(a, b, c, inside);
            add_face(a, c, d, inside);
        }
    };

    constexpr int orders[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 } };
    for (int z = 0; z + 1 < n[2]; ++z)
        for (int y = 0; y + 1 < n[1]; ++y)
            for (int x = 0; x + 1 < n[0]; ++x)
                for (const auto& order : orders) {
                    const bool left = place({ x, y, z }).x() > -0.5 * spacing;
                    std::array<Node, 4> tet;
                    tet[0] = { left ? x + 1 : x, y, z };
                    for (int k = 0; k < 3; ++k) {
                        tet[k + 1] = tet[k];
                        tet[k + 1][order[k]] += order[k] == 0 && left ? -1 : 1;
                    }
                    march(tet);
                }

    TriangleMesh mesh;
    mesh.positions.resize(points.size(), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        mesh.positions.row(v) = points[v];
    mesh.triangles.resize(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        mesh.triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

/// Both meshes as one, the first one's vertices and faces first.
inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b)
{
    TriangleMesh result;
    result.positions.resize(a.positions.rows() + b.positions.rows(), 3);
    result.positions << a.positions, b.positions;
    result.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
    result.triangles << a.triangles, (b.triangles.array() + int(a.positions.rows())).matrix();
    return result;
}

/// A sheet with thickness: closed by a second sheet, moved by `offset` (n x 3) and turned over, and by walls at the
/// border.
inline TriangleMesh thickened(const TriangleMesh& sheet, const Positions& offset)
{
    const int n = int(sheet.positions.rows());
    TriangleMesh back { sheet.positions + offset, sheet.triangles };
    back.triangles.col(1).swap(back.triangles.col(2));
    TriangleMesh closed = joined(sheet, back);
    std::vector<Eigen::RowVector3i> walls;
    std::set<std::pair<int, int>> sides;
    for (const auto& corners : sheet.triangles.rowwise())
        for (int k = 0; k < 3; ++k)
            sides.emplace(corners[k], corners[(k + 1) % 3]);
    for (const auto& [a, b] : sides)
        if (!sides.contains({ b, a })) {
            walls.emplace_back(b, a, a + n);
            walls.emplace_back(b, a + n, b + n);
        }
    const Eigen::Index faces = closed.triangles.rows();
    closed.triangles.conservativeResize(faces + Eigen::Index(walls.size()), 3);
    for (std::size_t w = 0; w < walls.size(); ++w)
        closed.triangles.row(faces + Eigen::Index(w)) = walls[w];
    return closed;
}

/// Texture coordinates of the corners by their places: uv_at(place) is (u, v).
template <class Mesh, class UvAt>
CornerUvs uvs_of(const Mesh& mesh, const UvAt& uv_at)
{
    CornerUvs uvs(mesh.triangles.rows(), 6);
    for (Eigen::Index f = 0; f < uvs.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            uvs.row(f).segment<2>(2 * k) = uv_at(Vec3(mesh.positions.row(mesh.triangles(f, k))));
    return uvs;
}

/// A square sheet of n by n vertices, the first at the origin, at height(x, z) over the plane y = 0.
inline TriangleMesh sheet(int n, double spacing, const std::function<double(double, double)>& height)
{
    TriangleMesh mesh;
    mesh.positions.resize(n * n, 3);
    mesh.triangles.resize(2 * (n - 1) * (n - 1), 3);
    for (int v = 0; v < n * n; ++v) {
        const double x = spacing * (v % n), z = spacing * (v / n);
        mesh.positions.row(v) << x, height(x, z), z;
    }
    int f = 0;
    for (int v = 0; v < n * (n - 1); ++v)
        if (v % n + 1 < n) {
            mesh.triangles.row(f++) << v, v + n, v + 1;
            mesh.triangles.row(f++) << v + 1, v + n, v + n + 1;
        }
    return mesh;
}

/// A flat sheet from a corner on. @param n  as of sheet
inline TriangleMesh flat(int n, double spacing, const Vec3& corner)
{
    TriangleMesh mesh = sheet(n, spacing, [](double, double) { return 0; });
    mesh.positions.rowwise() += corner.transpose();
    return mesh;
}

struct PersonOptions {
    double arm_angle = 45;  ///< degrees below the horizontal: 0 = T-pose, 70 = arms down, -70 = arms up
    double elbow_angle = 15;  ///< degrees that the elbows flex, forearms forward
    double wrist_angle = 0;  ///< degrees that the hands hang down from the forearms
    double knee_angle = 0;  ///< degrees that the knees flex, shins back
    double hip_angle = 0;  ///< degrees that the thighs are raised forward
    double scale = 1;  ///< 1: 1.75 m tall in the A-pose
    double spacing = 0.05;  ///< m, at scale 1: of the grid that it is polygonised on
};

struct Person {
    TriangleMesh mesh;  ///< closed, one piece, genus 0; left is +x, up is +y, front is +z
    Skeleton skeleton;  ///< that the capsules were built round
};

/// The skeleton that capsule_person is built round, at scale 1.
inline Skeleton person_skeleton(const PersonOptions& options)
{
    constexpr double degree = 3.14159265358979323846 / 180;
    Skeleton s;
    s.root = Vec3(0, 0.93, 0);
    s.tails[lowerback] = Vec3(0, 1.06, -0.01);
    s.tails[upperback] = Vec3(0, 1.22, -0.01);
    s.tails[thorax] = Vec3(0, 1.42, -0.01);
    s.tails[lowerneck] = Vec3(0, 1.48, 0);
    s.tails[upperneck] = Vec3(0, 1.55, 0.01);
    s.tips[head_top] = Vec3(0, 1.75, 0.02);
    for (const double side : { 1.0, -1.0 }) {
        const bool left = side > 0;
        const auto place = [&](const Vec3& from, double length, const Vec3& along) {
            return Vec3(from + length * Vec3(side * along.x(), along.y(), along.z()));
        };
        const double thigh = options.hip_angle * degree, shin = (options.hip_angle - options.knee_angle) * degree;
        const Vec3 hip(side * 0.095, 0.93, 0);
        const Vec3 knee = place(hip, 0.43, Vec3(0.12, -std::cos(thigh), std::sin(thigh)).normalized());
        const Vec3 ankle = place(knee, 0.42, Vec3(0.06, -std::cos(shin), std::sin(shin)).normalized());
        const Vec3 toe
            = place(ankle, 0.19, Vec3(0.1, -0.25 * std::cos(shin) + std::sin(shin), std::cos(shin)).normalized());
        const double arm = options.arm_angle * degree, elbow_flex = options.elbow_angle * degree;
        const Vec3 along(std::cos(arm), -std::sin(arm), 0);
        const Vec3 shoulder(side * 0.18, 1.40, -0.01), elbow = place(shoulder, 0.28, along);
        const Vec3 forearm = std::cos(elbow_flex) * along + std::sin(elbow_flex) * Vec3::UnitZ();
        const double wrist_bend = options.wrist_angle * degree;
        const Vec3 down = (forearm.y() * forearm - Vec3::UnitY()).normalized();
        const Vec3 wrist = place(elbow, 0.265, forearm),
                   hand = place(wrist, 0.18, std::cos(wrist_bend) * forearm + std::sin(wrist_bend) * down);
        s.tails[left ? lhipjoint : rhipjoint] = hip;
        s.tails[left ? lfemur : rfemur] = knee;
        s.tails[left ? ltibia : rtibia] = ankle;
        s.tails[left ? lclavicle : rclavicle] = shoulder;
        s.tails[left ? lhumerus : rhumerus] = elbow;
        s.tails[left ? lradius : rradius] = wrist;
        s.tips[left ? lfoot_tip : rfoot_tip] = toe;
        s.tips[left ? lhand_tip : rhand_tip] = hand;
    }
    return s;
}

/// From a point to the segment from `a` to `b`.
inline double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b)
{
    return (p - a - std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) * (b - a)).norm();
}

/// Negative inside: a smooth union of capsules with radii that change along them, round a skeleton.
inline double person_distance(const Skeleton& s, const Vec3& p)
{
    struct Part {
        Vec3 from, to;
        double from_radius, to_radius;
    };
    std::vector<Part> parts {
        { s.root + Vec3(0.05, -0.01, 0), s.root + Vec3(-0.05, -0.01, 0), 0.105, 0.105 },
        { s.root + Vec3(0, 0, 0), s.tails[upperback], 0.12, 0.12 },
        { s.tails[upperback] + Vec3(0.07, 0.02, 0), s.tails[thorax] + Vec3(0.06, -0.1, 0), 0.085, 0.10 },
        { s.tails[upperback] - Vec3(0.07, -0.02, 0), s.tails[thorax] - Vec3(0.06, 0.1, 0), 0.085, 0.10 },
        { s.tails[thorax], s.tails[upperneck], 0.065, 0.055 },
        { s.tails[upperneck] + Vec3(0, 0.08, 0), s.tips[head_top] - Vec3(0, 0.09, 0.02), 0.08, 0.09 },
        { s.tails[upperneck] + Vec3(0, 0.015, 0.045), s.tails[upperneck] + Vec3(0, 0.06, 0.06), 0.045, 0.05 },
    };
    for (const int arm : { lclavicle, rclavicle }) {
        const Vec3 shoulder = s.tails[arm], elbow = s.tails[arm + 1], wrist = s.tails[arm + 2];
        const Vec3 tip = s.tips[arm == lclavicle ? lhand_tip : rhand_tip];
        parts.push_back({ s.tails[thorax] - Vec3(0, 0.03, 0), shoulder, 0.06, 0.06 });
        parts.push_back({ shoulder, elbow, 0.058, 0.046 });
        parts.push_back({ elbow, wrist, 0.046, 0.040 });
        parts.push_back({ wrist + 0.3 * (tip - wrist), tip - 0.035 * (tip - wrist).normalized(), 0.046, 0.040 });
    }
    for (const int leg : { lhipjoint, rhipjoint }) {
        const Vec3 hip = s.tails[leg], knee = s.tails[leg + 1], ankle = s.tails[leg + 2];
        const Vec3 tip = s.tips[leg == lhipjoint ? lfoot_tip : rfoot_tip];
        const Vec3 foot = (tip - ankle).normalized(), shin = (ankle - knee).normalized();
        parts.push_back({ hip, knee, 0.088, 0.058 });
        parts.push_back({ knee, ankle, 0.060, 0.045 });
        parts.push_back({ ankle + 0.03 * shin - 0.02 * foot, tip - 0.035 * foot, 0.047, 0.042 });
    }
    double sum = 0;
    constexpr double sharpness = 90;  // 1/m; blends over about 1 cm
    for (const Part& part : parts) {
        const Vec3 axis = part.to - part.from;
        const double t = std::clamp((p - part.from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
        const double radius = part.from_radius + t * (part.to_radius - part.from_radius);
        sum += std::exp(-sharpness * ((p - part.from - t * axis).norm() - radius));
    }
    return -std::log(sum) / sharpness;
}

/// A closed one-piece human of one to three thousand vertices.
inline Person capsule_person(const PersonOptions& options = {})
{
    Person person;
    person.skeleton = person_skeleton(options);
    Vec3 low = person.skeleton.root, high = low;
    const auto take_in = [&](const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    };
    std::for_each(person.skeleton.tails.begin(), person.skeleton.tails.end(), take_in);
    std::for_each(person.skeleton.tips.begin(), person.skeleton.tips.end(), take_in);
    const Vec3 margin = Vec3::Constant(0.2);
    person.mesh = polygonise([&](const Vec3& p) { return person_distance(person.skeleton, p); }, low - margin,
                             high + margin, options.spacing);
    person.mesh.positions *= options.scale;
    person.skeleton.root *= options.scale;
    for (Vec3& joint : person.skeleton.tails)
        joint *= options.scale;
    for (Vec3& tip : person.skeleton.tips)
        tip *= options.scale;
    return person;
}

/// A rig that needs no search: every vertex hangs on two bones.
inline Rig simple_rig(const Person& person)
{
    Rig rig;
    rig.skeleton = person.skeleton;
    const Eigen::Index n = person.mesh.positions.rows();
    rig.weights.bones = Eigen::Matrix<int, Eigen::Dynamic, 4>::Zero(n, 4);
    rig.weights.weights = Eigen::Matrix<double, Eigen::Dynamic, 4>::Zero(n, 4);
    for (Eigen::Index v = 0; v < n; ++v) {
        rig.weights.bones(v, 0) = int(v % bone_count);
        rig.weights.bones(v, 1) = int((v + 3) % bone_count);
        rig.weights.weights(v, 0) = 0.75;
        rig.weights.weights(v, 1) = 0.25;
    }
    return rig;
}

/// A mesh whose vertices hang on the bone that they lie nearest to.
inline Rig nearest_rig(const Person& person)
{
    Rig rig = simple_rig(person);
    rig.weights.weights.setZero();
    rig.weights.weights.col(0).setOnes();
    for (Eigen::Index v = 0; v < person.mesh.positions.rows(); ++v) {
        double nearest = 1e9;
        for (int b = 0; b < bone_count; ++b) {
            const double d
                = segment_distance(person.mesh.positions.row(v), person.skeleton.head(b), person.skeleton.tail(b));
            if (d < nearest - 1e-9) {
                nearest = d;
                rig.weights.bones(v, 0) = b;
            }
        }
    }
    return rig;
}

/// An open tube about a bone's line, between two distances (metres) from the bone's head.
inline GarmentMesh sleeve_round(const Skeleton& skeleton, Bone bone, double radius, double from, double to)
{
    constexpr int around = 24, along = 12;
    const Vec3 axis = skeleton.direction(bone), side = axis.unitOrthogonal(), other = axis.cross(side);
    GarmentMesh result { Positions(around * along, 3), Triangles(2 * around * (along - 1), 3) };
    for (int i = 0; i < along; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * M_PI * k / around, distance = from + (to - from) * i / (along - 1);
            result.positions.row(i * around + k)
                = skeleton.head(bone) + distance * axis + radius * (std::cos(angle) * side + std::sin(angle) * other);
            if (i + 1 < along) {
                const int next = i * around + (k + 1) % around, here = i * around + k;
                result.triangles.row(2 * here) << here, next, here + around;
                result.triangles.row(2 * here + 1) << next, next + around, here + around;
            }
        }
    return result;
}

/// A garment round a skeleton's capsules, `ease` metres off the skin: the surface where `keep` says so, holes where
/// not.
inline TriangleMesh garment_round(const Skeleton& skeleton, double ease, const std::function<bool(const Vec3&)>& keep,
                                  double spacing = 0.03)
{
    const Vec3 low(-1, -0.2, -0.9), high(1, 2, 0.9);
    TriangleMesh whole
        = polygonise([&](const Vec3& p) { return person_distance(skeleton, p) - ease; }, low, high, spacing);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < whole.triangles.rows(); ++f)
        if (keep(whole.positions(whole.triangles.row(f), Eigen::all).colwise().mean().transpose()))
            rows.push_back(f);
    return { whole.positions, whole.triangles(rows, Eigen::all) };
}

}  // namespace garmentfit::fixtures
