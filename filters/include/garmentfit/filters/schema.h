// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every parameter, written once: name, unit, range and help here, the default in its options struct.
//
// describe(options, visitor) calls visitor(value, about) for each parameter; options may be const.

#include <type_traits>

#include "garmentfit/drape_garment.h"
#include "garmentfit/filters/parameters.h"
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/layer_order.h"
#include "garmentfit/recover_pose.h"
#include "garmentfit/rig_body.h"

namespace garmentfit {

template <class Options, class Struct>
using IfOptionsOf = std::enable_if_t<std::is_same_v<std::remove_const_t<Options>, Struct>>;

template <class Options, class Visitor, IfOptionsOf<Options, RigOptions>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    visit(o.proxy_vertices,
          About { "proxy_vertices", "Proxy vertices", "", 1000, 50000,
                  "The skeleton is found on a copy of the body that is simplified to about this many vertices" });
    visit(o.swap_sides,
          About { "swap_sides", "Swap sides", "", 0, 1,
                  "Exchange left and right, where the program mistook one for the other" });
    visit(o.humanlike,
          About { "humanlike", "Humanlike", "", 0, 0,
                  "Which bodies are rigged: any (whatever has two arms, two legs and a trunk, with a warning where it "
                  "is far from human), or strict (human bodies only; others are refused)",
                  &humanlike_names() });
}

template <class Options, class Visitor, IfOptionsOf<Options, FitOptions>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    visit(o.type,
          About { "type", "Garment type", "", 0, 0,
                  "What the garment is, which decides the bones that it covers; auto finds it from the openings",
                  &garment_type_names() });
    visit(o.method,
          About { "method", "Method", "", 0, 0,
                  "How the pose is searched for: fast, or slowly by a published method, for comparison: paper "
                  "(Wu et al. 2018), tisserand (Tisserand et al. 2017)",
                  &fit_method_names(), Group::research });
    visit(o.iterations,
          About { "iterations", "Iterations", "", 1, 20,
                  "Of the methods paper and tisserand: rounds of moving the body, turning it and turning its bones",
                  nullptr, Group::research });
    visit(o.nearest,
          About { "nearest", "Nearest vertex", "", 0, 0,
                  "Of the methods paper and tisserand: how the nearest vertex is looked for; the result is the same",
                  &nearest_search_names(), Group::research });
    visit(o.as_placed,
          About { "as_placed", "As placed", "", 0, 1,
                  "Body and garment come from one scene, and the garment lies round the body already" });
}

/// What the user knows of the sizes of meshes. Hosts apply it where they read a mesh (frame_choice.h).
struct BodySizes {
    std::optional<double> height;  ///< m
};
struct GarmentSizes {
    double scale = 1;
};

template <class Options, class Visitor, IfOptionsOf<Options, BodySizes>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    visit(o.height,
          About { "height", "Height", "m", 0.2, 10,
                  "How tall the body is in metres, from its lowest to its highest point as it stands in its file; "
                  "overrides its unit",
                  nullptr, Group::everyday, "auto" });
}

template <class Options, class Visitor, IfOptionsOf<Options, GarmentSizes>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    visit(o.scale,
          About { "garment_scale", "Garment scale", "", 0.001, 1000,
                  "The garment's file is multiplied by this, after its unit" });
}

/// The time that a whole filter may take.
template <class Seconds, class Visitor>
void describe_time_limit(Seconds& time_limit, Visitor&& visit)
{
    visit(time_limit,
          About { "time_limit", "Time limit", "s", 0, 1e6,
                  "After this time the work ends with the last state that is free of crossings, where there is one; 0 "
                  "for no limit" });
}

/// How several garments are worn together.
template <class Order, class Visitor>
void describe_layers(Order& layer_order, Visitor&& visit)
{
    visit(layer_order,
          About { "layer_order", "Layer order", "", 0, 0,
                  "Which of several garments goes over which: given (from the inside out), or auto (by type and width: "
                  "coats over jackets, the wider of two shirts over the narrower)",
                  &layer_order_names() });
}

/// What cloth is and how it behaves, whatever is done with it.
template <class Options, class Visitor, IfOptionsOf<Options, ClothOptions>* = nullptr>
void describe_cloth(Options& o, Visitor&& visit)
{
    visit(o.fabric,
          About { "fabric", "Fabric", "", 0, 0,
                  "Sets density, stiffness, friction and largest stretch, where they are not given", &fabric_names() });
    visit(o.contact_distance,
          About { "contact_distance", "Contact distance", "m", 5e-4, 0.02,
                  "Cloth nearer than this to the body, or to other cloth, is pushed away from it" });
    visit(o.min_distance,
          About { "min_distance", "Minimum distance", "m", 1e-6, 5e-4, "No motion makes a gap smaller than this" });
    constexpr std::string_view fabric = "of the fabric";
    visit(o.density,
          About { "density", "Density", "kg/m^2", 0.01, 5, "Mass of the cloth by area", nullptr, Group::everyday,
                  fabric });
    visit(o.stretch_stiffness,
          About { "stretch_stiffness", "Stretch stiffness", "N/m", 1, 1e5, "Resistance of the cloth to being stretched",
                  nullptr, Group::everyday, fabric });
    visit(o.weft_to_warp,
          About {
              "weft_to_warp", "Weft to warp", "", 0.1, 10,
              "Stretch stiffness along the weft by that along the warp, of garments whose texture coordinates say how "
              "these run",
              nullptr, Group::everyday, fabric });
    visit(
        o.shear_stiffness,
        About { "shear_stiffness", "Shear stiffness", "N/m", 0.1, 1e5,
                "Resistance of warp and weft to being turned towards each other, of garments whose texture coordinates "
                "say how these run",
                nullptr, Group::everyday, fabric });
    visit(o.bend_stiffness,
          About { "bend_stiffness", "Bend stiffness", "N m", 0, 1,
                  "Resistance of the cloth to being bent away from the folds that it was given with", nullptr,
                  Group::everyday, fabric });
    visit(o.friction,
          About { "friction", "Friction", "", 0, 2, "Coefficient of friction of cloth on body", nullptr,
                  Group::everyday, fabric });
    visit(o.largest_stretch,
          About { "largest_stretch", "Largest stretch", "", 0.01, 2,
                  "A garment is too small where the body would stretch it by more than this share", nullptr,
                  Group::everyday, fabric });
}

template <class Options, class Visitor, IfOptionsOf<Options, ClothOptions>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    describe_cloth(o, visit);
    visit(o.largest_enlargement,
          About { "enlarge", "Enlarge", "", 0, 1,
                  "A garment that is too small is made wider where it is, or larger, by up to this share" });
}

template <class Options, class Visitor, IfOptionsOf<Options, DrapeOptions>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    describe(o.cloth, visit);
    visit(o.growing_steps,
          About { "growing_steps", "Growing steps", "", 4, 1000,
                  "Steps in which the body grows from its bones to its full size" });
    visit(o.settling_steps,
          About { "settling_steps", "Settling steps", "", 0, 10000,
                  "Time steps under gravity, once the body has its full size" });
}

/// How worn garments move from one pose to another.
template <class Options, class Visitor, IfOptionsOf<Options, RecoverOptions>* = nullptr>
void describe_pose_path(Options& o, Visitor&& visit)
{
    visit(o.largest_steps,
          About { "recovery_steps", "Recovery steps", "", 1, 100000,
                  "No more steps than these back to the input pose; they get longer instead" });
    visit(o.step_length,
          About { "recovery_step_length", "Recovery step length", "m", 1e-4, 0.1,
                  "No part of the body near the cloth moves further than this in a step" });
    visit(o.settling_steps,
          About { "recovery_settling_steps", "Recovery settling steps", "", 0, 10000,
                  "Time steps under gravity, once the input pose is reached" });
}

/// What the return to the input pose adds to cloth and pose path, which it shares with draping.
template <class Options, class Visitor, IfOptionsOf<Options, RecoverOptions>* = nullptr>
void describe_end(Options& o, Visitor&& visit)
{
    visit(o.quality,
          About { "quality", "Quality", "", 0, 0,
                  "How far the cloth is led at the end: standard (until the forces on it balance), or draft (only the "
                  "settling steps, much faster; it would go on to slide)",
                  &quality_names() });
    visit(o.settle_time,
          About { "settle_time", "Settle time", "s", 0, 600,
                  "So much simulated time the cloth goes on for once it is at rest, to see whether it stays there" });
    visit(o.press,
          About {
              "press", "Press", "m", 0, k_largest_press,
              "Skin that cloth holds back from its place by no more than this stays pressed in: where the body crosses "
              "itself, no cloth fits between unless it gives way" });
    visit(o.frames,
          About { "frames", "Frames", "", 0, 1000,
                  "States to keep on the return to the input pose, evenly spread; 1 for the end alone, 0 for none" });
}

template <class Options, class Visitor, IfOptionsOf<Options, RecoverOptions>* = nullptr>
void describe(Options& o, Visitor&& visit)
{
    describe_cloth(o.cloth, visit);  // a worn garment is not made larger
    describe_pose_path(o, visit);
    describe_end(o, visit);
}

}  // namespace garmentfit
