// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The tests that laboratories do on cloth, done on the solver's energy: Peirce's cantilever, Cusick's drape, and the
// tensile and shear moduli of Kawabata's first test. Cloth is held by stiff springs where an instrument clamps it;
// nothing else touches it, and cloth does not touch itself. Metres, kilograms, seconds; gravity along -y.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "cloth_energy.h"
#include "fixtures.h"
#include "limited_memory.h"
#include "surface_measures.h"
#include "topology.h"

namespace garmentfit::trials {

constexpr double k_standard_gravity = 9.81;  // m/s^2

inline ClothOptions of(Fabric fabric)
{
    ClothOptions options;
    options.fabric = fabric;
    return options;
}

/// What minimise() looks for: cloth that hangs still, held at some vertices.
class Hanging {
public:
    Hanging(const GarmentMesh& rest, const std::vector<int>& held, const ClothOptions& options) :
        energy_(rest, MeshTopology(rest.triangles, int(rest.positions.rows())), {}, options), held_(held)
    {
        energy_.set_time_step(0.02);  // of the preconditioner only: some inertia makes it definite
    }

    /// J
    double potential(const Positions& x) const
    {
        double sum = energy_.elastic_energy(x);
        for (Eigen::Index v = 0; v < x.rows(); ++v)
            sum += energy_.masses()[v] * k_standard_gravity * x(v, 1);
        return sum;
    }
    /// Its gradient, N; exact for cloth that is flat at rest, 0 where it is held.
    Positions gradient(const Positions& x) const
    {
        Positions result = -energy_.elastic_forces(x);
        for (Eigen::Index v = 0; v < x.rows(); ++v)
            result(v, 1) += energy_.masses()[v] * k_standard_gravity;
        return free(result);
    }
    Positions precondition(const Positions& g) const { return free(energy_.precondition(g)); }
    /// N, of a vertex on the mean.
    double weight() const
    {
        double sum = 0;
        for (const double mass : energy_.masses())
            sum += mass * k_standard_gravity;
        return sum / double(energy_.masses().size());
    }

private:
    Positions free(Positions x) const
    {
        for (const int v : held_)
            x.row(v).setZero();
        return x;
    }

    ClothEnergy energy_;
    std::vector<int> held_;
};

/// Cloth that is held at some vertices, at rest: no force on a vertex is more than a hundredth of its weight on the mean,
/// or so many iterations are over.
inline Positions settle_held(const GarmentMesh& rest, const std::vector<int>& held, const ClothOptions& options,
                             int iterations = 6000)
{
    const Hanging hanging(rest, held, options);
    const double small = 1e-2 * hanging.weight() * std::sqrt(double(rest.positions.rows()));
    Positions x = rest.positions, g = hanging.gradient(x);
    double e = hanging.potential(x);
    LimitedMemory memory(12);
    const auto solve = [&](const Positions& forces) { return hanging.precondition(forces); };
    for (int i = 0; i < iterations && g.norm() > small; ++i) {
        Positions d = memory.direction(-g, solve);
        if (d.cwiseProduct(g).sum() >= 0) {
            memory.forget();
            d = -hanging.precondition(g);
        }
        const double slope = d.cwiseProduct(g).sum();
        double step = std::min(1.0, 0.01 / d.rowwise().norm().maxCoeff());  // m: no vertex jumps over its neighbours
        double after = hanging.potential(x + step * d);
        while (after > e + 1e-4 * step * slope && step > 1e-12)
            after = hanging.potential(x + (step *= 0.5) * d);
        if (step <= 1e-12)
            break;
        const Positions next = x + step * d, gradient = hanging.gradient(next);
        memory.remember(next - x, gradient - g);
        x = next;
        g = gradient;
        e = after;
    }
    return x;
}

/// A strip along +x with rows of equilateral triangles, in the plane y = 0; its first row is at x = 0.
inline GarmentMesh strip(double length, double width, double edge)
{
    const int along = int(std::lround(length / (edge * std::sqrt(0.75)))) + 1,
              across = int(std::lround(width / edge)) + 1;
    Positions positions(along * across, 3);
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < across; ++j)
            positions.row(i * across + j) << length * i / (along - 1), 0, edge * (j + 0.5 * (i % 2));
    Triangles triangles(2 * (along - 1) * (across - 1), 3);
    Eigen::Index f = 0;
    for (int i = 0; i + 1 < along; ++i)
        for (int j = 0; j + 1 < across; ++j) {
            const int a = i * across + j, b = a + 1, c = a + across, d = c + 1;
            if (i % 2 == 0) {
                triangles.row(f++) << a, b, c;
                triangles.row(f++) << b, d, c;
            } else {
                triangles.row(f++) << a, d, c;
                triangles.row(f++) << a, b, d;
            }
        }
    return { positions, triangles };
}

/// Peirce's flexometer: a strip stands out over an edge and hangs at some angle. Its bending length is
/// c = l (cos(angle / 2) / (8 tan angle))^(1/3) [peirce_1930_handle]. @return bending stiffness, N m: c^3 times the
/// weight by area, with the least mass that the solver gives to a vertex
inline double cantilever_stiffness(const ClothOptions& options, double overhang, double edge)
{
    const double clamped = 4 * edge;
    const GarmentMesh rest = strip(overhang + clamped, 0.025, edge);
    std::vector<int> held;
    std::vector<int> tip;
    for (int v = 0; v < int(rest.positions.rows()); ++v) {
        if (rest.positions(v, 0) <= clamped + 1e-9)
            held.push_back(v);
        if (rest.positions(v, 0) >= overhang + clamped - 1e-9)
            tip.push_back(v);
    }
    const Positions x = settle_held(rest, held, options);
    double out = 0, down = 0, root = 0;
    for (const int v : held)
        root = std::max(root, rest.positions(v, 0));
    for (const int v : tip) {
        out += (x(v, 0) - root) / double(tip.size());
        down -= x(v, 1) / double(tip.size());
    }
    const double angle = std::atan2(down, out);
    const double length = rest.positions.col(0).maxCoeff() - root;
    const double weight = Hanging(rest, held, options).weight() * double(rest.positions.rows());  // N
    return std::pow(length, 3) * std::cos(angle / 2) / (8 * std::tan(angle)) * weight
        / area({ rest.positions, rest.triangles });
}

/// A disc in the plane y = 0: rings of even edges, each turned by a random angle, so that it has no axis of symmetry.
inline GarmentMesh disc(double radius, double edge, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
    const int rings = int(std::lround(radius / edge));
    std::vector<std::vector<int>> ring(rings + 1);
    std::vector<std::vector<double>> angle(rings + 1);
    Positions positions(1 + 3 * rings * (rings + 1), 3);
    positions.row(0).setZero();
    int v = 1;
    for (int r = 1; r <= rings; ++r) {
        const double first = turn(random) / (6 * r);
        for (int k = 0; k < 6 * r; ++k, ++v) {
            angle[r].push_back(first + 2 * std::numbers::pi * k / (6 * r));
            ring[r].push_back(v);
            positions.row(v) << radius * r / rings * std::cos(angle[r].back()), 0,
                -radius * r / rings * std::sin(angle[r].back());
        }
    }
    std::vector<Eigen::RowVector3i> faces;
    for (int k = 0; k < 6; ++k)
        faces.emplace_back(0, ring[1][k], ring[1][(k + 1) % 6]);
    for (int r = 2; r <= rings; ++r) {
        const int inner = 6 * (r - 1), outer = 6 * r;
        const auto at = [](const std::vector<double>& a, int k) {
            return a[k % int(a.size())] + 2 * std::numbers::pi * (k / int(a.size()));
        };
        int i = 0, o = 0;  // the two rings are sewn together by angle, once round
        while (i < inner || o < outer) {
            const int vi = ring[r - 1][i % inner], vo = ring[r][o % outer];
            if (o < outer && (i == inner || at(angle[r], o + 1) <= at(angle[r - 1], i + 1)))
                faces.emplace_back(vi, vo, ring[r][++o % outer]);
            else
                faces.emplace_back(vi, vo, ring[r - 1][++i % inner]);
        }
    }
    Triangles triangles(Eigen::Index(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        triangles.row(Eigen::Index(f)) = faces[f];
    return { positions, triangles };
}

/// Area of the shadow of a mesh under light along -y, m^2, counted in squares of a millimetre.
inline double shadow(const Positions& x, const Triangles& triangles, double radius)
{
    constexpr double k_pixel = 1e-3;
    const int n = 2 * int(std::ceil(1.1 * radius / k_pixel));
    std::vector<char> dark(std::size_t(n) * n, 0);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        Eigen::Matrix<double, 3, 2> c;
        for (int k = 0; k < 3; ++k)
            c.row(k) << x(triangles(f, k), 0) / k_pixel + 0.5 * n, x(triangles(f, k), 2) / k_pixel + 0.5 * n;
        const auto side = [&](int k, double px, double py) {
            const auto a = c.row(k), b = c.row((k + 1) % 3);
            return (b(0) - a(0)) * (py - a(1)) - (b(1) - a(1)) * (px - a(0));
        };
        for (int i = std::max(0, int(c.col(0).minCoeff())); i <= std::min(n - 1, int(c.col(0).maxCoeff())); ++i)
            for (int j = std::max(0, int(c.col(1).minCoeff())); j <= std::min(n - 1, int(c.col(1).maxCoeff())); ++j) {
                const double p = side(0, i + 0.5, j + 0.5), q = side(1, i + 0.5, j + 0.5),
                             r = side(2, i + 0.5, j + 0.5);
                if ((p >= 0 && q >= 0 && r >= 0) || (p <= 0 && q <= 0 && r <= 0))
                    dark[std::size_t(i) * n + j] = 1;
            }
    }
    return double(std::count(dark.begin(), dark.end(), 1)) * k_pixel * k_pixel;
}

struct Draped {
    double coefficient;  ///< share of the overhanging ring that the shadow covers
    int nodes;  ///< folds: how often the border comes out
    double lowest;  ///< m, of the border below the support
    GarmentMesh rest;
    Positions positions;
};

/// Folds of the border, which is the last ring of the disc.
inline int count_nodes(const Positions& x, int border)
{
    std::vector<double> out;
    for (Eigen::Index v = x.rows() - border; v < x.rows(); ++v)
        out.push_back(std::hypot(x(v, 0), x(v, 2)));
    double mean = 0;
    for (const double r : out)
        mean += r / double(border);
    int nodes = 0;
    for (int k = 0; k < border; ++k)
        nodes += out[k] <= mean && out[(k + 1) % border] > mean;
    return nodes;
}

/// Cusick's drapemeter [cusick_1965_drape, iso_9073_9]: a disc lies between two smaller ones, and its ring hangs down.
inline Draped cusick(const ClothOptions& options, double radius = 0.15, double support = 0.09, double edge = 0.01,
                     unsigned seed = 1)
{
    Draped result { 0, 0, 0, disc(radius, edge, seed), {} };
    std::vector<int> held;
    for (int v = 0; v < int(result.rest.positions.rows()); ++v)
        if (result.rest.positions.row(v).norm() <= support + 1e-9)
            held.push_back(v);
    result.positions = settle_held(result.rest, held, options);
    const double whole = shadow(result.rest.positions, result.rest.triangles, radius),
                 plate = std::numbers::pi * support * support;
    result.coefficient = (shadow(result.positions, result.rest.triangles, radius) - plate) / (whole - plate);
    result.nodes = count_nodes(result.positions, 6 * int(std::lround(radius / edge)));
    result.lowest = -result.positions.col(1).minCoeff();
    return result;
}

/// The sheet with its warp at an angle to +x, radians.
inline GarmentMesh cut_at(const GarmentMesh& sheet, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    const auto uv_at
        = [&](const Vec3& at) { return Eigen::RowVector2d(c * at.z() - s * at.x(), c * at.x() + s * at.z()); };
    return make_garment(sheet.positions, sheet.triangles, fixtures::uvs_of(sheet, uv_at));
}

struct Moduli {
    double young, shear;  ///< N/m
    double poisson;
};

/// Tension of a wide sheet that is stretched along x by `strain` and free to narrow, N/m, and its shear stiffness for
/// small shear angles.
/// @param rest  in the plane y = 0
inline Moduli moduli(const ClothOptions& options, double strain, const GarmentMesh& rest = strip(0.2, 0.2, 0.01))
{
    const ClothEnergy energy(rest, MeshTopology(rest.triangles, int(rest.positions.rows())), {}, options);
    const double sheet = area({ rest.positions, rest.triangles });
    const auto density = [&](double along, double across, double shear) {
        Positions x = rest.positions;
        x.col(0) = (1 + along) * rest.positions.col(0) + shear * rest.positions.col(2);
        x.col(2) = (1 + across) * rest.positions.col(2);
        return energy.elastic_energy(x) / sheet;
    };
    const auto narrowed = [&](double along) {  // by golden section
        constexpr double k_ratio = 0.6180339887498949;
        double low = -along, high = 0;
        for (int i = 0; i < 80; ++i) {
            const double a = high - k_ratio * (high - low), b = low + k_ratio * (high - low);
            (density(along, a, 0) < density(along, b, 0) ? high : low)
                = density(along, a, 0) < density(along, b, 0) ? b : a;
        }
        return 0.5 * (low + high);
    };
    constexpr double h = 1e-4;
    const double tension
        = (density(strain + h, narrowed(strain + h), 0) - density(strain - h, narrowed(strain - h), 0)) / (2 * h);
    return { tension / strain, (density(0, 0, h) + density(0, 0, -h)) / (h * h), -narrowed(strain) / strain };
}

}  // namespace garmentfit::trials
