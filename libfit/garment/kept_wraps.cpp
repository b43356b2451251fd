// SPDX-License-Identifier: GPL-3.0-or-later
#include "kept_wraps.h"

#include <algorithm>
#include <optional>

#include <Eigen/Geometry>

#include "surface_measures.h"

namespace garmentfit {
namespace {

constexpr std::size_t k_kept = 4;  // unit: garments of an outfit; some 10 MB each
constexpr double k_rounding = 1e-7;  // unit: share of the diagonal; a file's numbers, times a unit, turned

bool are_same(const Triangles& a, const Triangles& b) { return a.rows() == b.rows() && a == b; }

/// Takes the one set of points to the other, which has to be the same but for place, size and turn
/// [umeyama_1991_similarity].
std::optional<Eigen::Matrix4d> similarity(const Positions& from, const Positions& to)
{
    if (from.rows() != to.rows())
        return {};
    if (from == to)
        return Eigen::Matrix4d::Identity();
    const Eigen::Matrix4d found = Eigen::umeyama(from.transpose(), to.transpose());
    const Positions moved
        = (from * found.topLeftCorner<3, 3>().transpose()).rowwise() + found.topRightCorner<3, 1>().transpose();
    const bool is_same = (moved - to).rowwise().norm().maxCoeff() < k_rounding * diagonal(to);
    return is_same ? std::optional(found) : std::nullopt;
}

}  // namespace

TriangleMesh KeptWraps::of(const GarmentMesh& garment, const std::function<TriangleMesh()>& make)
{
    const std::lock_guard lock(mutex_);
    for (auto kept = kept_.begin(); kept != kept_.end(); ++kept) {
        if (!are_same(kept->garment.triangles, garment.triangles))
            continue;
        const auto move = similarity(kept->garment.positions, garment.positions);
        if (!move)
            continue;
        std::rotate(kept_.begin(), kept, kept + 1);
        TriangleMesh wrap = kept_.front().wrap;
        if (!move->isIdentity(0))
            wrap.positions = (wrap.positions * move->topLeftCorner<3, 3>().transpose()).rowwise()
                + move->topRightCorner<3, 1>().transpose();
        return wrap;
    }
    kept_.push_front({ garment, make() });
    if (kept_.size() > k_kept)
        kept_.pop_back();
    return kept_.front().wrap;
}

}  // namespace garmentfit
