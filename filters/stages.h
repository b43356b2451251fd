// SPDX-License-Identifier: GPL-3.0-or-later
// What each stage does to the scene.
#pragma once

#include "garmentfit/filters/filters.h"

namespace garmentfit {

using RunStage = void(Scene&, const Parameters&, const Progress&);

void rig_stage(Scene& scene, const Parameters& parameters, const Progress& progress);

/// Fits the skeleton to each garment, then to all of them in one pose, and puts them in layers.
void fit_stage(Scene& scene, const Parameters& parameters, const Progress& progress);

/// Fits the skeleton to garments that were changed, for the same way of wearing: what is wider may look like another
/// type, but was found to be too small in this one. @return whether the body fits so; else the scene stays
bool fit_again(Scene& scene, const Parameters& parameters, const Progress& progress);

/// Puts the garments on from the inside out; those already worn move to the pose of the next one. Ends at the first that
/// cannot be put on.
void drape_stage(Scene& scene, const Parameters& parameters, const Progress& progress);

/// The same where recover_stage comes next: garments that follow stand-ins are made clean at the end alone.
void drape_on_the_way_stage(Scene& scene, const Parameters& parameters, const Progress& progress);

/// Moves the dressed body to its input pose.
void recover_stage(Scene& scene, const Parameters& parameters, const Progress& progress);

/// A garment that is too narrow for the hips slides down to where it is not. That does not make it large enough, and to
/// stay there it must not have to stretch.
void judge_hips(const Scene& scene, Dressing& dressing);

/// Makes the garments that are too small wider where they are, until their fabric allows the rest (widen_garment.h).
/// @param most   share by which girths grow at most
/// @param share  1: as far as the fabric needs; 0.5: half as far
/// @return whether there are any, and all may be made wider so far
bool widen_too_small(Scene& scene, double most, double share);

/// Makes fitted garments wider before they are put on, at parts round which a tape says that their fabric gives far too
/// little. @param most  share by which girths grow at most @return whether there are any
bool widen_far_too_narrow(Scene& scene, const Parameters& parameters, double most);

/// Gives garments whose size is a guess that of their most probable unit, if it is larger.
/// @return whether there are any
bool take_size_in_unit(Scene& scene);

/// Gives a garment a size, as a share of its own. What is the most probable way of wearing it is asked anew.
void take_size(GarmentInput& garment, double share);

/// Takes the four before back, and a fabric that was guessed. What was made of changed garments stays.
void take_as_given(GarmentInput& garment);

/// Enlarges the garments that are put on, but found too small in the end, until their fabric allows the rest. @return whether
/// there are any, and all may be enlarged so far
bool enlarge_too_small(Scene& scene, const Parameters& parameters);

/// Whether what did not end well may do so if it is put on otherwise: nothing helps where the part that is held back
/// furthest crosses another part of the body, or far too much girth is missing.
bool may_be_worn_in_the_end(const Scene& scene);
/// Takes garments that are too small, and of whose fabric nothing was said, to be of the knit that is usual for their type,
/// if one is. @param parameters  as given
void take_usual_knits(Scene& scene, const Parameters& parameters);
/// Whether one of these is stretched by more than cotton gives round most parts of the body that it goes round: it is made
/// for a smaller person, whatever it is of.
bool is_knit_stretched_all_over(const Scene& scene);
/// Putting on as if the garments were of soft cloth that gives far. How far their own fabric gives is asked in the pose in
/// which they are worn: in that in which they are put on, arms may hang, and pull at narrow shoulders.
Parameters putting_on_softly(Parameters parameters);

/// Whether what did not end well was caught on the way: it is drawn out at one place, as what is too small is not, or
/// holds back a body that does not cross itself.
bool is_caught(const Scene& scene);
/// Putting on, or moving, in smaller steps, in which cloth may not be caught.
Parameters growing_slowly(Parameters parameters);
Parameters moving_slowly(Parameters parameters);
/// Enlarges the garments whose size is a guess, as their files have no unit, where cloth holds parts of the body back.
/// @param size  DrapeOptions::size
/// @return whether there are any
bool loosen(Scene& scene, double size);

}  // namespace garmentfit
