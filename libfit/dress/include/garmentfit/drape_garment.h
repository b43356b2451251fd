// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Puts a garment on a body whose skeleton was fitted to it. Cloth and body never cross.
//
// Method   The posed body is collapsed onto its bones, which run inside the garment, and grows to full size. Contact
//          pushes the cloth outwards (projective dynamics [bouaziz_2014_projective_dynamics]). Every motion is cut to
//          its intersection-free part (additive CCD [li_2021_cipc]). Then the cloth settles under gravity.
// Units    metres, kilograms, seconds.
// Cost     contact search dominates: O((n + c) log n) a step, n vertices, c close pairs; some 100 steps.
// Promise  every state returned or shown is certified, or says in its certificate what is wrong with it.

#include <optional>
#include <string>
#include <vector>

#include "garmentfit/certificate.h"
#include "garmentfit/closed_ends.h"
#include "garmentfit/cloth.h"
#include "garmentfit/mesh.h"
#include "garmentfit/pieces.h"
#include "garmentfit/progress.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Defaults are fitted: guesses on the pairs that dress/tuning.h names.
struct DrapeOptions {
    ClothOptions cloth;
    int growing_steps = 24;  ///< in which the body grows from its bones to full size
    int settling_steps = 20;  ///< time steps under gravity
    double size = 1;  ///< by which the garment is enlarged from the start, where it is known to be too small as given
};

/// Where a garment is too small.
struct TooTight {
    int garment;  ///< which: from the inside out, as all of libfit counts them
    std::string part;  ///< "chest", "waist", "hips", "left thigh", ...
    double missing_girth;  ///< m; girth that the cloth lacks there to lie unstretched
    double enlargement;  ///< share by which the garment would have to be larger for that
};

/// Where cloth keeps a part of the body from its place.
struct HeldBack {
    std::string part;  ///< as in TooTight
    double distance;  ///< m; of its furthest vertex from its place
};

/// Cloth that moved in the place of a garment (stand_in.h).
struct WornStandIn {
    GarmentMesh rest;  ///< as WornGarment::rest
    Positions positions;
    bool is_clean = true;  ///< nothing crosses it there
};

/// A garment on a body.
struct WornGarment {
    GarmentMesh rest;  ///< as given without closed ends, or made larger: edge lengths and folds
    Positions positions;  ///< as worn, n x 3
    Certificate certificate = {};
    double size = 1;  ///< of the rest shape; more than 1 where it was enlarged
    double girth = 1;  ///< the same, where girths alone were: the largest of them (widen_garment.h)
    /// m that it sank along the body since it was put on, by the median of its vertices. A large value: the garment is
    /// too wide to stay.
    double slipped = 0;
    PieceCounts pieces = {};  ///< how it was held together
    double piece_shift = 0;  ///< m; longest_piece_shift()
    int closed_ends = 0;  ///< ends whose closing faces `rest` leaves out: a hand, foot or head passes there
    LeftOut left_out = {};  ///< pieces whose faces `rest` leaves out, each drawn into one place of the cloth
    std::optional<Fabric> fabric = {};  ///< what it is made of, where not of the fabric of ClothOptions
    std::optional<WornStandIn> stand_in = {};  ///< that it followed
};

/// What a garment is made of, among others of perhaps other fabrics.
GARMENTFIT_API Material material_of(const ClothOptions& options, const WornGarment& worn);

/// By their certificates.
GARMENTFIT_API bool all_clean(const std::vector<WornGarment>& garments);

/// A body in a pose, and the garments on it.
struct DressedBody {
    Pose pose = {};  ///< takes the body from the pose of its input into this one
    /// The body's vertices, n x 3; cloth may hold parts of the body back from the pose, and hands may be stretched out.
    /// Empty: exactly the pose.
    Positions body = {};
    std::vector<WornGarment> garments = {};  ///< from the inside out
};

/// Writes the certificate of each garment, judged against the body and the garments under it. O(n log n).
/// @return whether all are clean
GARMENTFIT_API bool certify_all(std::vector<WornGarment>& garments, const TriangleMesh& body);

/// The dressed body as draping left it, at the body scale reached. The last garment is the new one. It is left out
/// where it is too small to be put on over the others. Hands that would stand across a sleeve are stretched out.
struct DrapeResult : DressedBody {
    /// Of the body's thickness, 1 = full size; less where the garment is too small, or where time ran out.
    double scale_reached = 1;
    std::vector<TooTight> too_tight;
    std::vector<HeldBack> held_back;  ///< parts that cloth holds back from their places at full size; worst first
    /// m/s, of the fastest vertex of the cloth in the last settling step. None below full size: then nothing settles.
    std::optional<double> speed;
    bool certified = false;  ///< every garment's certificate is clean and the body has its full size
    /// The deadline of the Progress passed: the body is at the scale it had reached, or the cloth is not settled.
    bool out_of_time = false;
    ClothSeconds seconds;
};

/// Puts one more garment on a body.
/// @param dressed  the body in the pose of the new garment (FitResult::pose), and the garments that it wears already;
///                 these move with the body. A body that wears nothing: `{ fit.pose }`. Another layer: the
///                 DrapeResult of the layer below. A bare body whose bones lie across the cloth in the pose is moved by
///                 up to 3 cm, of a body of human size, if it fits there.
/// @throws InvalidInput when bones and garment cross, naming bone and place, and as require_wearable_size does.
///         Cancelled.
GARMENTFIT_API DrapeResult drape_garment(const Rig& rig, const BodyMesh& body, const DressedBody& dressed,
                                         const GarmentMesh& garment, const DrapeOptions& options = {},
                                         const Progress& progress = {});

}  // namespace garmentfit
