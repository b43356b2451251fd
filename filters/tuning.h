// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fitted numbers of the filters. "Body metres" are metres on a body of human size: any other body is scaled to it first
// (body_scale.h).

#include <array>
#include <string_view>

#include "garmentfit/cloth.h"
#include "garmentfit/garment_type.h"

namespace garmentfit {

/// Dimensionless, 0 undecided to 1 certain. Guesses of a smaller confidence get a warning.
/// fitted: guess, on the twelve pairs of the house data
inline constexpr double k_low_confidence = 0.2;
/// Probability that a body is human, below which a warning says that it is not. fitted: guess.
inline constexpr double k_far_from_human = 0.6;
/// The same, below which the warning says that the skeleton is wrong. fitted: on strangers' bodies; of those that are
/// rigged right a tyrannosaur has the least, 0.01; seven wrong ones have at most 0.0004.
inline constexpr double k_hopeless_figure = 0.001;

/// Cosine between the trunk of a file's skeleton and an axis, from which the body stands along it. fitted: guess; the
/// trunks of 60 bind poses have .95 and more.
inline constexpr double k_least_along_axis = 0.9;

/// Diagonals of the body's box. What lies further from the origin is moved there (near_origin.h). fitted: guess. Where
/// nothing is moved, the sample in its skirt is dressed alike from 0 to 1e4 m, takes twice as long at 1e5 m and is
/// refused at 1e7 m.
inline constexpr double k_far = 100;

/// Guesses of a smaller probability get a warning. derived: of what is said with more, four in five at least are right
/// (libfit/fit/evidence.h)
inline constexpr double k_low_probability = 0.8;

/// Probability below which another way of wearing a garment is not tried, where the most probable one ends badly, and
/// how many are. fitted: guess
inline constexpr double k_worth_trying = 0.05;
inline constexpr int k_other_wearings = 2;

/// Factors on the probability of a way of wearing by how dressing ends (End in other_wearings.h). guess, on 31 garments
/// dressed as they should be and in two other ways each (decision 23): how it ends says little about the way, so these
/// say which answer serves more
inline constexpr std::array<double, 5> k_end_likelihoods { 1, 0.3, 0.8, 0.2, 0 };

/// l / l0 - 1 of an edge. Cloth that is stretched further has torn: it hangs on a part of the body that another way of
/// wearing it may leave free. fitted: guess, on the wild clothes
inline constexpr double k_torn = 2;

/// m on a body of human size. Edges that are longer than at rest by less are pinched, not torn: three of 1.7 mm on the
/// buckle of a skirt were 5 mm long. guess, on that skirt
inline constexpr double k_torn_length = 0.01;

/// m on a body of human size. Cloth with an edge that is longer than at rest by so much is drawn out into a strand.
/// fitted: guess, on a T-shirt with an edge of 2 m; pinched edges are short
inline constexpr double k_strand = 0.1;

/// Share of the cloth's area that triangles which more than doubled have gained. Cloth with more, and not too tight, is
/// drawn out into strands. fitted: guess, between a hoodie that was torn (0.031) and 50 clothes of strangers that are
/// worn, of which the most have 0.010, 0.009 and 0.008
inline constexpr double k_drawn_area = 0.02;

/// Share of the body's edges. Where more are drawn out, the body ends in spikes: something is caught, and no girth is
/// missing. fitted: guess, twice the most (0.5 %) that six garments leave, of the house data, the wild clothes and the
/// samples, which are plainly too small, by 20 % of girth and more
inline constexpr double k_spiked_share = 1e-2;

/// Share of what its fabric gives from which a garment counts as tight. The solver's stiffness is soft for woven cloth,
/// so its pressure alone says too little. fitted: guess
inline constexpr double k_tight_share = 0.5;

/// Pa. Pressure of clothes is comfortable up to 1.96 to 3.92 kPa, by person and part of the body: here the lower end.
/// literature: [denton_1972_fit], [makabe_1991_pressure]
inline constexpr double k_comfortable_pressure = 1960;

/// Share of the body's girth. A garment with more ease is roomy. literature: blouses and dresses are called
/// loose-fitting from 13 cm of ease at a bust of 92 cm [mccall_ease]
inline constexpr double k_roomy_ease = 0.14;

/// m. Longest side of a garment whose parts are measured to find its size. unit: of the order of people's clothes
inline constexpr double k_usual_longest_side = 1;

/// Share of the stature that the longest clothes have, hoods and trains apart, that the shortest have, and the spread
/// of the logarithm beyond them. fitted: guess; from shoulder to floor it is about 0.82. With 0.95, a dress of a shop
/// was 1.89 m long, in metres; of 152 garments with a unit none is read differently on three bodies.
inline constexpr double k_longest_share = 0.86, k_shortest_share = 0.1, k_length_spread = 0.05;
/// m. Tallest people for whom clothes are made, where the body is not taller. fitted: guess; as the longest share is
/// ample, a garment without a hood may be made for people of 2 m
inline constexpr double k_tallest_wearer = 1.9;

/// Of the body's stature: how tall the people are whom a garment fits, by the median of its measures; a unit in which
/// it is smaller is not its own. fitted: guess, that of the fit's refusals
inline constexpr double k_least_wearer = 0.45;
/// Likewise; where a smaller one lies round the body, that is chance. fitted: guess; of 29 clothes of one collection on
/// their own body, parts of bikinis and a camisole have the least, 0.68 to 0.71; two that lay in a man by chance, in
/// decimetres, have 0.41 and 0.56
inline constexpr double k_least_wearer_in_place = 0.6;
/// Likewise in another unit than the body's. fitted: guess; trousers of 6.7 units lay round a man's legs in decimetres,
/// as those of somebody two thirds as tall
inline constexpr double k_least_wearer_in_other_unit = 0.75;

// The size of a garment (garment_scale.h), in natural logarithms. fitted: guesses, on one half of 125 garments of a
// catalogue, in their units and multiplied by factors of 0.1 to 1000, judged on the other half.

/// Probability that a measure of a garment is none of the size, but a style or mistaken, and its density then.
inline constexpr double k_mistaken = 0.1, k_mistaken_density = 0.25;
/// A wide garment is wide everywhere: so many measures say as much as one that is independent.
inline constexpr double k_dependence = 2;
/// Of people for whom clothes are made, against the body that wears them; share of clothes of children and other people
/// of another size, and their mean and spread.
inline constexpr double k_wearer_spread = 0.12, k_children = 0.15, k_child_size = -0.1, k_child_spread = 0.35;
/// Spread of how much larger clothes are made than for the tallest people, as a style. fitted: guess, on two clothes
/// of a web shop that kept their metres at twice the size.
inline constexpr double k_oversize = 0.1;
/// Probability that a file has no unit, and its density then: the same in fourteen units, a factor of a million.
inline constexpr double k_without_unit = 0.2, k_without_unit_density = 0.07;
/// How near the longest side of a model that was scaled to one or two units comes to that, as a share; and how much
/// more often sides of files without a unit are as near than those of others. fitted: guess; of 65 clothes of web shops
/// four are that near, whose size no unit explains, and of 152 garments with a unit none is.
inline constexpr double k_normalised = 0.002, k_normalised_odds = 60;
/// Share by which a garment that was scaled to the body, because no unit explains its size, is made larger at most
/// where it is too small then: shoulders and sleeves say how tall its wearer is, not how stout. fitted: guess; five of
/// 34 clothes of web shops needed .08 to .17.
inline constexpr double k_enlarged_without_unit = 0.2;
/// Sizes in which such a garment is tried, from the first, where it holds parts of the body back. fitted: guess; a
/// sweater and a dress of web shops held a forearm and a thigh back by 15 and 9 mm.
inline constexpr std::array<double, 2> k_looser_sizes { 1.05, 1.1 };
/// Share of what its fabric gives by which a garment that is enlarged is stretched then. derived: as
/// k_enlarged_stretch_share of the room dress
inline constexpr double k_stretch_of_enlarged = 0.5;
/// Times what its fabric gives: a garment that a tape finds narrower than the body by more is made wider before it is put
/// on, instead of after that failed. fitted: guess
inline constexpr double k_far_too_narrow = 1.1;
/// Exponent: how much a garment that is wider by a factor is that of a larger person: less, for people of one stature
/// differ in girth. fitted: guess: with 1, a T-shirt that is 29 % wider at the shoulders loses to a skirt
inline constexpr double k_size_of_girth = 0.5;
/// Share, of the logarithm, by which a garment is made wider that does not end well with the widening tried before.
/// fitted: guess
inline constexpr double k_smaller_share = 0.5;
/// Strain, the 95th percentile, that fine cloth may have beyond that of the stand-in that it follows; with more, it
/// moves as it is. fitted: guess; fine clothes of web shops that follow well have .01 to .03, a jumpsuit that is a
/// child's too long .25.
inline constexpr double k_follower_strain = 0.1;
/// Time steps that a garment hangs for where it followed a rough stand-in, before it seeks a rest of its own; and the
/// share of the time that leading it takes, for the progress bar. fitted: guesses
inline constexpr int k_own_settling_steps = 8;
inline constexpr double k_progress_of_leading = 0.4;
/// How usual the units are in mesh files, and by how much more that of the file's format, or else the body's own.
struct UsualUnit {
    std::string_view name;
    double usualness;
};
inline constexpr std::array<UsualUnit, 6> k_usual_units {
    { { "m", 1 }, { "dm", 0.6 }, { "cm", 0.8 }, { "mm", 0.8 }, { "in", 0.1 }, { "ft", 0.05 } }
};
inline constexpr double k_usual_unit = 10;
/// Sizes that differ by less serve alike: clothes of two sizes do.
inline constexpr double k_same_size = 0.2;
/// unit: steps in which all factors are gone through
inline constexpr double k_step = 0.01;

/// Log odds per unit of the openings' evidence that a garment is upright along one axis and not along another, beside
/// those of its box and symmetry (guess_garment_frame). fitted: on one half of 126 garments of three catalogues, turned
/// about +y, with +y or +z up; from 1 to 2 nothing changes. Without a preference for the body's axes, 118 of 122
/// are right on the other half (98 without openings), and 112 of 130 on the half that it was fitted on (64). That
/// absolute values count was chosen with both halves in view.
inline constexpr double k_openings_up_weight = 1;

/// The fabric that clothes are put on as, where they do not end well as their own. fitted: guess, the softest one that
/// gives most; of nine dressings of strangers' clothes that were called too small or not certified six are worn with it
inline constexpr Fabric k_put_on_as = Fabric::rib;

/// Knits of which garments of a type mostly are. fitted: guess; nothing was counted. A top with long sleeves may be a
/// sweater or a shirt, so it has that of the two knits which gives least.
struct UsualKnit {
    GarmentType type;
    Fabric fabric;
};
inline constexpr std::array<UsualKnit, 9> k_usual_knits { { { GarmentType::tshirt, Fabric::jersey },
                                                            { GarmentType::vest, Fabric::jersey },
                                                            { GarmentType::tanktop, Fabric::jersey },
                                                            { GarmentType::camisole, Fabric::jersey },
                                                            { GarmentType::strapless, Fabric::jersey },
                                                            { GarmentType::halter, Fabric::jersey },
                                                            { GarmentType::longsleeve, Fabric::fleece },
                                                            { GarmentType::hoodie, Fabric::fleece },
                                                            { GarmentType::leggings, Fabric::swimwear } } };

/// Times what its fabric gives: a garment that has to be larger by more is not put on once more. fitted: guess; those that
/// are worn then had to be larger by up to 29 %, three that are too small in truth by 38 to 48 %
inline constexpr double k_hopelessly_small = 2;

/// How many times as many steps, each as much shorter, cloth is given that was caught on the way. fitted: guess; of ten
/// dressings of strangers' clothes that had failed, trousers on two men are worn with it, and a sweater. Which clothes are
/// caught is chance: a T-shirt and two pairs of trousers that are worn without it are not, if it is taken from the start
inline constexpr int k_slower = 2;

/// Body metres. A piece that went further from the cloth that it lay on gets a warning.
/// fitted: guess.
inline constexpr double k_piece_gone = 0.05;
/// Body metres. A garment that slipped down by more gets a warning.
/// fitted: guess, on the twelve pairs of the house data: cloth that settles sinks by some centimetres, a coat by nine
inline constexpr double k_slipped = 0.15;
/// Shares of its guessed size in which a garment whose file has no unit is tried where it is too small or cannot be put
/// on, and where it slips off; and body metres down to which it stays where it was put on. fitted: guesses, on a halter
/// dress of a stranger
inline constexpr std::array<double, 2> k_larger_sizes { 1.25, 1.5 }, k_smaller_sizes { 0.8, 0.65 };
inline constexpr double k_stays = 0.05;

/// Share of a radius; and for thin bones metres, or on a body less than a metre across, a share of its diagonal. A rig
/// whose radii differ from the body's by more is another body's: files keep fewer digits than the rig was found with,
/// and two people differ by more.
/// fitted: guess, on tests/bodies
inline constexpr double k_same_radius = 0.02, k_same_place = 5e-4;

}  // namespace garmentfit
