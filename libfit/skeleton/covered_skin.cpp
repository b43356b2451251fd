// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/covered_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "depth_picture.h"
#include "edge_distances.h"
#include "garmentfit/error.h"
#include "garmentfit/mesh.h"
#include "hidden_by_cloth.h"
#include "keyframes.h"
#include "parallel.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

using Directions = std::vector<Vec3>;

/// Other ones for each pose.
Directions directions_of_pose(int pose, int poses) { return viewing_directions(k_pictures_of_a_pose, pose, poses); }

/// A ring round each direction.
Directions directions_around(const Directions& directions, double angle)
{
    Directions ring;
    for (const Vec3& direction : directions) {
        const Vec3 aside = direction.unitOrthogonal(), across = direction.cross(aside);
        for (int i = 0; i < k_pictures_around; ++i) {
            const double turn = 2 * std::numbers::pi * (i + 0.5) / k_pictures_around;
            ring.push_back(std::cos(angle) * direction
                           + std::sin(angle) * (std::cos(turn) * aside + std::sin(turn) * across));
        }
    }
    return ring;
}

/// Where a ray meets a surface first; and last, which a ray the other way meets first.
struct Depths {
    float first = std::numeric_limits<float>::infinity(), last = -std::numeric_limits<float>::infinity();
};

struct Skin {
    Depths depths;
    int first = -1, last = -1;  // faces

    void add(float depth, int face)
    {
        if (depth < depths.first) {
            depths.first = depth;
            first = face;
        }
        if (depth > depths.last) {
            depths.last = depth;
            last = face;
        }
    }
};

struct Ray {
    Depths cloth;
    Skin front, back;  // faces that turn their outside and their inside to who looks along the ray
};

struct SeenFace {
    float depth;
    int face;
};

/// The face of the body that has to stay for what is seen along a ray, or -1. What lies behind it is not seen. Where
/// blending pushed skin through its cloth, cloth inside the body shows in place of skin that is left out.
int face_that_shows(float cloth, const SeenFace& outside, const SeenFace& inside, float most_bulge)
{
    if (inside.depth <= outside.depth)
        return inside.depth < cloth ? inside.face : -1;
    const bool shows_cloth = cloth <= inside.depth && cloth <= outside.depth + most_bulge;
    return shows_cloth ? -1 : outside.face;
}

struct Dressed {
    TriangleMesh body, cloth;
};

/// What is seen of a body and its clothes in one direction and in the opposite one.
class DepthPicture {
public:
    void draw(const Dressed& dressed, const Vec3& direction, double pixel)
    {
        const auto& [body, cloth] = dressed;
        const PictureFrame frame(direction, pixel, body.positions);
        rays_.assign(frame.pixels(), Ray());
        paint_triangles(frame, frame.project(cloth.positions), cloth.triangles,
                        [&](std::size_t at, float depth, int, bool) {
                            Depths& depths = rays_[at].cloth;
                            depths = { std::min(depths.first, depth), std::max(depths.last, depth) };
                        });
        paint_triangles(frame, frame.project(body.positions), body.triangles,
                        [&](std::size_t at, float depth, int face, bool is_front) {
                            (is_front ? rays_[at].front : rays_[at].back).add(depth, face);
                        });
    }

    /// Calls mark(face) for each face that has to stay.
    template <class Mark>
    void for_each_seen(float most_bulge, const Mark& mark) const
    {
        for (const auto& [cloth, front, back] : rays_)
            for (const int face : { face_that_shows(cloth.first, { front.depths.first, front.first },
                                                    { back.depths.first, back.first }, most_bulge),
                                    face_that_shows(-cloth.last, { -back.depths.last, back.last },
                                                    { -front.depths.last, front.last }, most_bulge) })
                if (face >= 0)
                    mark(face);
    }

private:
    std::vector<Ray> rays_;
};

TriangleMesh joined_clothes(const std::vector<SkinnedCloth>& clothes, const BoneTransforms& transforms)
{
    std::vector<TriangleMesh> posed;
    for (const auto& [surface, weights] : clothes)
        posed.push_back({ blend_linearly(surface.positions, weights, transforms), surface.triangles });
    return joined(posed);
}

/// Draws pictures, several at once. look(i, picture) gets that of directions[i].
template <class Look>
void draw_pictures(const Dressed& dressed, const Directions& directions, double pixel, const Look& look)
{
    constexpr std::size_t k_chunk = 8;  // unit: pictures that share memory
    parallel_for((directions.size() + k_chunk - 1) / k_chunk, [&](std::size_t chunk) {
        DepthPicture picture;
        for (std::size_t i = k_chunk * chunk; i < std::min(directions.size(), k_chunk * (chunk + 1)); ++i) {
            picture.draw(dressed, directions[i], pixel);
            look(i, picture);
        }
    });
}

/// Vertices that are seen, and those within a margin of them along the edges.
class SeenSkin {
public:
    SeenSkin(const TriangleMesh& body, double margin) :
        topology_(body.triangles, int(body.positions.rows())), margin_(margin),
        reach_(std::max(margin, k_edges_to_news * mean_edge_length(body.positions, topology_.edges()))),
        distances_(body.positions, topology_, reach_)
    {
    }

    bool is_seen(int vertex) const { return distances_[vertex] == 0; }
    bool is_in_margin(int vertex) const { return distances_[vertex] < margin_; }
    bool is_near(int vertex) const { return distances_[vertex] < reach_; }
    void add(const std::vector<int>& vertices) { distances_.add(vertices); }

private:
    MeshTopology topology_;
    double margin_, reach_;
    EdgeDistances distances_;  // from skin that is seen
};

/// What one picture adds to the skin that is seen.
struct News {
    std::vector<int> vertices;
    bool is_far = false;  // from all that was seen before
};

News news_of(const DepthPicture& picture, const Triangles& triangles, double most_bulge, const SeenSkin& seen)
{
    News news;
    picture.for_each_seen(float(most_bulge), [&](int face) {
        for (const int corner : triangles.row(face))
            if (!seen.is_seen(corner)) {
                news.vertices.push_back(corner);
                news.is_far = news.is_far || !seen.is_near(corner);
            }
    });
    return news;
}

/// Looks at one pose. Where a picture shows something far from all that was seen, more are drawn around it: one looks
/// into sleeves, collars and trouser legs within a few degrees only.
void look_around(const Dressed& dressed, Directions directions, double size, SeenSkin& seen)
{
    double angle = std::sqrt(2 * std::numbers::pi / k_pictures_of_a_pose);  // between neighbours of the lattice
    for (int level = 0; level <= k_levels_of_sight && !directions.empty(); ++level, angle /= 2) {
        std::vector<News> news(directions.size());
        draw_pictures(dressed, directions, k_pixel_of_sight * size, [&](std::size_t i, const DepthPicture& picture) {
            news[i] = news_of(picture, dressed.body.triangles, k_most_bulge * size, seen);
        });
        Directions far;
        for (std::size_t i = 0; i < news.size(); ++i) {
            seen.add(news[i].vertices);
            if (news[i].is_far)
                far.push_back(directions[i]);
        }
        directions = directions_around(far, angle / 2);
    }
}

void require_rows(const Positions& positions, const SkinWeights& weights, const char* what)
{
    if (weights.weights.rows() != positions.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           std::string("covered skin: ") + what + " has " + std::to_string(positions.rows())
                               + " vertices and " + std::to_string(weights.weights.rows())
                               + " rows of weights; give a row for each vertex");
}

}  // namespace

std::vector<char> find_covered_skin(const TriangleMesh& body, const Rig& rig, const std::vector<SkinnedCloth>& clothes)
{
    require_rows(body.positions, rig.weights, "the body");
    for (const SkinnedCloth& cloth : clothes)
        require_rows(cloth.surface.positions, cloth.weights, "a garment");

    const std::vector<Keyframe> keys = keyframes_of(rig);
    const double size = diagonal(body.positions);
    const int poses = 1 + int(keys.size());
    const Dressed at_rest { body, joined_clothes(clothes, bone_transforms(rig.skeleton, Pose())) };
    const Eigen::VectorXd hidden
        = shares_hidden_by_cloth(at_rest.body, at_rest.cloth, directions_of_pose(0, poses), k_pixel_of_sight * size);
    SeenSkin seen(body, k_margin_of_sight * size);
    std::vector<int> bare;
    for (int v = 0; v < int(hidden.size()); ++v)
        if (hidden[v] <= 0.5)  // bare to most who see it
            bare.push_back(v);
    seen.add(bare);
    look_around(at_rest, directions_of_pose(0, poses), size, seen);
    for (int pose = 1; pose < poses; ++pose) {
        const BoneTransforms transforms = bone_transforms(rig.skeleton, keys[std::size_t(pose - 1)].pose);
        look_around({ { blend_linearly(body.positions, rig.weights, transforms), body.triangles },
                      joined_clothes(clothes, transforms) },
                    directions_of_pose(pose, poses), size, seen);
    }
    std::vector<char> is_covered;
    for (int v = 0; v < int(body.positions.rows()); ++v)
        is_covered.push_back(!seen.is_in_margin(v));
    return is_covered;
}

Triangles uncovered_faces(const Triangles& triangles, const std::vector<char>& is_covered)
{
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (!(is_covered[std::size_t(triangles(f, 0))] && is_covered[std::size_t(triangles(f, 1))]
              && is_covered[std::size_t(triangles(f, 2))]))
            kept.push_back(f);
    return triangles(kept, Eigen::all);
}

}  // namespace garmentfit
