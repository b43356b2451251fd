// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments in many parts or with many vertices: their stand-ins are draped and return to the input pose, and they follow
// (stand_in.h, docs/decisions/0033-stand-ins.md).

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// Looks for the stand-ins of garments where nobody has. Beside stand-ins that are not rough there are none that are: what
/// follows the others has no rest of its own, so there is none for all to find. @return whether a garment has one
bool find_stand_ins(Scene& scene);

/// Whether all stand-ins are rough: the garments are to find a rest of their own after them.
bool is_led_roughly(const Scene& scene);

/// A scene of stand-ins, which may be led by coarser ones in turn.
Scene with_stand_ins_to_be_found(Scene led);

/// The scene with stand-ins in the places of their garments, also of those that are draped. A garment keeps its place,
/// and has no stand-in there, where it is draped and its stand-in would cross the body.
Scene lead(Scene scene);

/// Where garments that follow stand-ins which are not needed come out badly, they are to move as they are.
/// @return whether there is one
bool give_up_stand_ins(Scene& scene);

/// Where a dressing ended uncertified, or the body did not reach its size in cloth that passes through itself, garments
/// that moved as they are are to follow the inner sheets of their wraps.
/// @return whether there is one
bool find_linings(Scene& scene);

struct Leading {
    const Scene& scene;
    const Scene& led;  ///< lead(scene)
    const std::vector<std::size_t>& order;  ///< which of the garments are worn, from the inside out
    bool is_on_the_way;  ///< the dressing goes on to another pose: what follows need not be made clean here
};

/// Takes the garments of a dressing of the led scene where their stand-ins went; each is certified. Frames in which one
/// is not clean are left out. After the deadline, they follow without what makes them clean.
Dressing follow_stand_ins(const Leading& leading, Dressing dressing, const ClothOptions& cloth,
                          const Progress& progress);

}  // namespace garmentfit
