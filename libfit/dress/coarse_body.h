// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "garmentfit/recover_pose.h"
#include "partial_body.h"

namespace garmentfit {

/// A body of many vertices with some of them only, and where the others are to these. Contact takes time with every vertex
/// of a body, and cloth feels no detail of less than a millimetre (docs/decisions/0053-coarse-bodies.md). A body of few
/// vertices, or one with details everywhere, stays as it is, to the bit.
class CoarseBody {
public:
    /// Keeps a reference to the body. O(n log n)
    CoarseBody(const Rig& rig, const BodyMesh& body);

    /// Whether it differs from the body that was given.
    bool is_other() const { return coarse_.has_value(); }
    // The others: @pre is_other()
    const Rig& rig() const { return coarse_->rig; }
    const BodyMesh& body() const { return coarse_->body; }
    /// With the positions of the coarse body.
    DressedBody gather(DressedBody dressed) const;
    /// Positions of all vertices: each as it is to the coarse surface in the input; those of the input where the coarse
    /// body is as there.
    Positions spread(const Positions& coarse) const;
    /// Positions of all vertices on the coarse surface: what is clear of that is clear of them, up to chords of the given
    /// body's edges.
    Positions lay(const Positions& coarse) const;

private:
    /// Where a vertex is to a triangle of the coarse body that it is joined with.
    struct Binding {
        int triangle;
        std::array<double, 3> shares;  // of its corners at the nearest point
        Vec3 offset;  // from there, in the triangle's frame
    };
    /// @param round  triangles by vertex
    Binding bind(const Vec3& place, int from, const std::vector<std::vector<int>>& round) const;
    Binding bound_to(int triangle, const Vec3& place) const;
    /// @param height  share of the offsets
    Positions place(const Positions& coarse, double height) const;

    const Positions& given_;
    std::vector<int> vertices_;  // of the given body, that are the coarse one's
    std::optional<PartialBody> coarse_;
    std::vector<Binding> bindings_;  // of all
};

/// Whether the garments are clear of the coarse body where they are. @pre gathered
bool are_clear_of(const CoarseBody& coarse, const DressedBody& dressed);

/// Puts what the coarse body wears on the given one, and certifies it: with its own skin where the garments are clear of
/// that, else with the skin laid on the coarse surface. @return whether it has its own skin
bool put_on_given(const CoarseBody& coarse, const Triangles& given, DressedBody& dressed);

/// The same for a state along the way. @return whether it is clean
bool put_on_given(const CoarseBody& coarse, const Triangles& given, RecoverFrame& frame, DressedBody dressed);

/// What `move` makes of the coarse body, put on the given one. What is certified on the former `settle` settles on the
/// latter. Where that does not end certified, what `move` makes of the given body.
/// @param move    of a rig, a body, what it wears and a Progress a DrapeResult or a RecoverResult
/// @param settle  such a result on the given body; it is told whether that has its own skin, and gets a Progress
template <class Move, class Settle>
auto move_coarse(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const Progress& progress,
                 const Move& move, const Settle& settle)
{
    constexpr double k_progress_of_coarse = 0.8, k_progress_of_settled = 0.9;  // unit: shares of the progress
    const CoarseBody coarse(rig, body);
    const DressedBody gathered = coarse.is_other() ? coarse.gather(dressed) : DressedBody();
    if (!coarse.is_other() || !are_clear_of(coarse, gathered))
        return move(rig, body, dressed, progress);
    auto result = move(coarse.rig(), coarse.body(), gathered, progress.part(0, k_progress_of_coarse));
    const Triangles& triangles = body.surface.triangles;
    if constexpr (requires { result.frames; })
        std::erase_if(result.frames, [&](auto& frame) { return !put_on_given(coarse, triangles, frame, result); });
    const bool was_certified = result.certified, was_clean = all_clean(result.garments),
               has_own_skin = put_on_given(coarse, triangles, result), is_clean = all_clean(result.garments);
    if (was_certified && is_clean)
        settle(result, has_own_skin, progress.part(k_progress_of_coarse, k_progress_of_settled));
    const bool is_as_good = was_certified ? is_clean && result.certified : is_clean || !was_clean;
    result.certified &= is_as_good;
    if (is_as_good || progress.is_late())
        return result;
    return move(rig, body, dressed, progress.part(k_progress_of_settled, 1));
}

}  // namespace garmentfit
