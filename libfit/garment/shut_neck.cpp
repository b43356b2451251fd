// SPDX-License-Identifier: GPL-3.0-or-later
#include "shut_neck.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>

#include "nearest.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr int k_rounds = 3;  // unit: in which a patch finds its axis
constexpr std::size_t k_seeds = 40;  // unit: places from which patches are grown
constexpr double k_off = 1e-4;  // unit: share of the trunk's width, so that a ray does not start on its own face

/// Connected faces that look nearly alike.
struct Patch {
    std::vector<int> faces;
    double area = 0;  // m^2
    double disc = 0;  // m^2, of a flat disc that closes the same outline
    Vec3 axis = Vec3::Zero();  // unit
    Vec3 middle = Vec3::Zero();
};

class TopOfTrunk {
public:
    TopOfTrunk(const TriangleMesh& cloth, const Trunk& trunk) :
        trunk_(trunk), tree_(cloth), topology_(cloth.triangles, int(cloth.positions.rows())),
        seen_(std::size_t(cloth.triangles.rows()), 0)
    {
        for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
            areas_.push_back(area_vector(cloth.positions, cloth.triangles, f));
            middles_.push_back(cloth.positions(cloth.triangles.row(f), Eigen::all).colwise().mean());
        }
    }

    /// In a hood that stands up it is the floor, most of which is below the hood's crown.
    std::vector<int> neck()
    {
        std::vector<int> middle = faces_in_the_middle(), below;
        const auto is_below = [&](int f) { return is_below_cloth(f); };
        std::copy_if(middle.begin(), middle.end(), std::back_inserter(below), is_below);
        std::vector<int> floor = largest_neck(std::move(below));
        const bool is_in_hood = 2 * std::count_if(floor.begin(), floor.end(), is_below) > std::ssize(floor);
        return is_in_hood ? floor : largest_neck(std::move(middle));
    }

private:
    double off_middle(const Vec3& place) const
    {
        return std::abs((place - trunk_.shoulders).dot(trunk_.across)) / trunk_.width;
    }

    double height_of(int f) const { return (middles_[f] - trunk_.hem).dot(trunk_.up); }

    /// Those that look up.
    std::vector<int> faces_in_the_middle() const
    {
        std::vector<int> middle;
        for (int f = 0; f < int(areas_.size()); ++f)
            if (off_middle(middles_[f]) < k_neck_off_middle
                && areas_[f].stableNormalized().dot(trunk_.up) > k_neck_facing)
                middle.push_back(f);
        return middle;
    }

    bool is_below_cloth(int f) const
    {
        return tree_.first_hit(middles_[f] + k_off * trunk_.width * trunk_.up, trunk_.up).has_value();
    }

    /// The largest patch like a neck that grows from the highest of some faces; empty without any.
    std::vector<int> largest_neck(std::vector<int> seeds)
    {
        double highest = 0;  // m, above the hem
        for (const int f : seeds)
            highest = std::max(highest, height_of(f));
        std::erase_if(seeds, [&](int f) { return height_of(f) < k_neck_height * highest; });
        Patch neck;
        for (std::size_t i = 0; i < seeds.size(); i += 1 + seeds.size() / k_seeds)
            if (auto patch = stable_patch(seeds[i]); patch && patch->area > neck.area)
                neck = *std::move(patch);
        return neck.faces;
    }

    /// Faces connected with one whose directions are within an angle of their mean.
    Patch grown(int seed, double angle)
    {
        Patch patch;
        patch.axis = areas_[seed].stableNormalized();
        for (int round = 0; round < k_rounds; ++round) {
            const Vec3 axis = patch.axis;
            ++mark_;
            patch.faces = { seed };
            seen_[seed] = mark_;
            Vec3 sum = Vec3::Zero();
            patch.area = 0;
            patch.middle.setZero();
            for (std::size_t i = 0; i < patch.faces.size(); ++i) {
                const int f = patch.faces[i];
                const double area = areas_[f].norm();
                sum += areas_[f];
                patch.area += area;
                patch.middle += area * middles_[f];
                for (int side = 3 * f; side < 3 * f + 3; ++side)
                    if (const int other = topology_.opposite(side); other >= 0 && seen_[other / 3] != mark_
                        && areas_[other / 3].stableNormalized().dot(axis) > std::cos(angle)) {
                        seen_[other / 3] = mark_;
                        patch.faces.push_back(other / 3);
                    }
            }
            patch.axis = sum.stableNormalized();
            patch.disc = sum.norm();
            patch.middle /= patch.area;
        }
        return patch;
    }

    /// Whether it fills an ellipse that is as round as a neck.
    bool is_round(const Patch& patch) const
    {
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        for (const int f : patch.faces) {
            const Vec3 away = middles_[f] - patch.middle, across = away - away.dot(patch.axis) * patch.axis;
            spread += areas_[f].norm() / patch.area * across * across.transpose();
        }
        const Vec3 squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
        const double narrow = std::sqrt(std::max(0.0, squares[1])), wide = std::sqrt(squares[2]);
        return narrow > k_neck_roundness * wide && patch.disc > k_neck_filled * 4 * std::numbers::pi * narrow * wide;
    }

    bool is_neck(const Patch& patch) const
    {
        return patch.disc > k_neck_least * trunk_.hem_area && patch.disc < k_neck_most * trunk_.hem_area
            && patch.axis.dot(trunk_.up) > k_neck_facing && off_middle(patch.middle) < k_neck_off_middle
            && is_round(patch);
    }

    /// The widest that a crease holds.
    std::optional<Patch> stable_patch(int seed)
    {
        std::optional<Patch> found;
        Patch narrower = grown(seed, k_neck_angles.front());
        for (std::size_t i = 1; i < k_neck_angles.size(); ++i) {
            Patch patch = grown(seed, k_neck_angles[i]);
            if (patch.disc < k_neck_growth * narrower.disc && is_neck(patch))
                found = patch;
            narrower = std::move(patch);
        }
        return found;
    }

    const Trunk& trunk_;
    TriangleTree tree_;
    MeshTopology topology_;
    std::vector<int> seen_;  // by face, the last patch that has it
    int mark_ = 0;
    std::vector<Vec3> areas_, middles_;  // by face
};

}  // namespace

std::vector<int> find_shut_neck(const TriangleMesh& cloth, const Trunk& trunk)
{
    return TopOfTrunk(cloth, trunk).neck();
}

}  // namespace garmentfit
