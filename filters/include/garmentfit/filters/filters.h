// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table of filters that every host shows.
//
// A filter reads parts of a Scene and fills others. A host puts its meshes into the scene and the values of its widgets
// into Parameters, calls run, and takes out what `outputs` names. Metres, +y up, as everywhere in libfit. Bodies
// outside of human size are scaled to it while a filter works (body_scale.h).

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/schema.h"
#include "garmentfit/fit_map.h"
#include "garmentfit/layer_order.h"
#include "garmentfit/stand_in.h"
#include "garmentfit/units.h"
#include "garmentfit/widen_garment.h"

namespace garmentfit {

enum class Stage { rig, fit, drape, recover };
constexpr int k_stage_count = 4;  // derived: values of Stage
/// "rig", "fit", "drape", "recover".
std::string_view name_of(Stage stage);

/// The options of all stages; a filter shows those of the stages it runs.
struct Parameters {
    RigOptions rig;
    FitOptions fit;  ///< its type is used for garments whose own is automatic
    LayerOrder layer_order = LayerOrder::given;
    DrapeOptions drape;
    RecoverOptions recover;  ///< its cloth is used only where draping is not part of the filter
    BodySizes body_sizes;  ///< hosts apply it where they read a body, and filters ignore it
    GarmentSizes garment_sizes;  ///< the same for garments
    /// s; a guess of what users wait for. From the start of the filter; a host that runs several sets it once for all
    /// (Progress::until). 0: none.
    double time_limit = 120;
};

struct GarmentInput {
    GarmentMesh mesh;
    GarmentType type = GarmentType::automatic;
    std::string name = {};  ///< for messages; may be empty
    std::optional<Vec3> front = {};  ///< as FitOptions::front, where the user gave it
    std::optional<bool> as_placed = {};  ///< empty: as in Parameters
    int skipped = 0;  ///< FitOptions::skipped
    std::optional<Fabric> fabric = {};  ///< empty: as in Parameters
    bool fabric_is_guessed = false;  ///< by its type, as nothing was said of it and cotton gives too little
    /// Moves in its place (stand_in.h). Draping looks for one where there is none; without a mesh: it needs none.
    std::optional<std::optional<StandIn>> stand_in = {};
    double size = 1;  ///< DrapeOptions::size
    Widening widening = {};  ///< of the mesh, while it is tried with wider girths
    double share = 1;  ///< of its size as given that the mesh has, while it is tried in another one
    std::optional<GarmentMesh> as_given = {};  ///< the mesh before
    bool has_unit = true;  ///< Frame::has_unit; a garment without one may be made larger where it is too small
    double size_in_unit = 1;  ///< Frame::size_in_unit; it is tried so where it is far too small
};

/// Garments on the body, in one pose: one for each of the scene's; without positions where it is not worn.
struct Dressing : DressedBody {
    std::size_t outermost = 0;  ///< which garment was put on last, or was to be
    /// Of the body; less than 1 where the outermost garment is too small, or where time ran out.
    double scale_reached = 1;
    double pose_reached = 1;  ///< share of the last pose path that was covered
    std::vector<TooTight> too_tight;
    std::vector<HeldBack> held_back;  ///< where cloth keeps the body from its place, in the last pose that was tried
    std::vector<Overlap> overlaps;  ///< where the body crosses itself in that pose, so that no cloth fits between
    /// m/s, of the fastest vertex of the cloth in the last settling step; none where it was not let settle
    std::optional<double> speed;
    /// How far forces on the cloth are from balance at the end; none before the pose was recovered, and where time ran
    /// out before they were looked at.
    std::optional<ForceResidual> residual;
    ClothSeconds seconds;  ///< of all motions that led here
    bool certified = false;  ///< all garments are on, full size, pose reached, nothing crosses
    std::optional<Stage> out_of_time;  ///< the stage in which the time limit was reached
    std::vector<RecoverFrame> frames;  ///< states on the last pose path, where asked for
    int frames_asked = 0;  ///< how many those would be if all were certified and the whole path was covered
    std::vector<FitMap> maps;  ///< one for each garment that is worn, like the next three
    std::vector<std::vector<Girth>> girths;  ///< of garment and body under it
    std::vector<Overstretch> overstretches;
    std::vector<std::vector<PartLoad>> loads;  ///< round each part of the body that the garment goes round
    /// Of each of the scene's garments, the shoulders (lclavicle, rclavicle) that it lay over in its fit and slipped
    /// off.
    std::vector<std::vector<Bone>> off_shoulders;
    /// The same, of the hips (lhipjoint, rhipjoint) that it covers in its fit and does not reach.
    std::vector<std::vector<Bone>> below_hips;
    std::vector<Fabric> fabrics;  ///< of each of the scene's garments
    std::vector<bool> guessed_fabrics;  ///< GarmentInput::fabric_is_guessed
    std::vector<double> fabric_stretches;  ///< what each of them gives: Material::largest_stretch
    Overstretch spikes;  ///< of the body: edges that cloth draws out far beyond their length
    double spiked_share = 0;  ///< of all edges of the body
    /// What lengths of this body are multiplied by to be those at human size (body_scale.h). Speeds and pressures are
    /// those at human size.
    double to_human_size = 1;
    LengthUnit unit = {};  ///< Scene::unit

    bool is_worn(std::size_t garment) const
    {
        return garment < garments.size() && garments[garment].positions.rows() > 0;
    }
    /// Indices of the garments that are.
    std::vector<std::size_t> worn() const;
};

struct Scene {
    std::optional<BodyMesh> body;
    std::vector<GarmentInput> garments;
    std::optional<Rig> rig;
    std::vector<FitResult> fits;  ///< one for each garment
    std::vector<int> automatic_layers;  ///< of several garments: the layer of each by type and width
    std::optional<bool> one_pose;  ///< of several garments: whether all fits turn the bones alike; by the fast method
    std::vector<FitConflict> conflicts;  ///< why they do not
    std::optional<Dressing> draped;  ///< in the pose of the outermost garment's fit
    std::optional<Dressing> recovered;  ///< in the input pose
    LengthUnit unit = {};  ///< that of the body's file, for messages
    std::array<double, k_stage_count> seconds {};  ///< wall clock spent in each stage
};

/// Gives a scene the body of a file, in metres, and the file's unit for messages.
/// @param in_file  n x 3, in the file's unit and axes
/// @throws InvalidInput as make_body
void put_body(Scene& scene, const Frame& frame, const Positions& in_file, const Triangles& triangles);

/// Which garment goes over all others.
std::size_t outermost(const std::vector<FitResult>& fits);

/// What a filter reads and makes: the ports of a host.
enum class Data { body, garments, rig, fits, draped, recovered };

struct Filter {
    std::string_view name;  ///< "dress": a command, a method
    std::string_view label;  ///< "Dress Body": a menu entry
    std::string_view help;
    std::vector<Data> inputs;
    std::vector<Data> outputs;
    std::vector<Stage> stages;  ///< run one after another

    bool has(Stage stage) const;
    bool reads(Data data) const;
    bool makes(Data data) const;
    /// The options of the cloth: one set for putting on and for moving, where the filter does both.
    const ClothOptions& cloth(const Parameters& parameters) const;
    /// The same for a body whose rig is known: it is read, and the other stages run as they do after rigging.
    Filter on_known_rig() const;

    /// Checks inputs and ranges, then fills the outputs of each stage. Ends after draping where a garment could not be
    /// put on. At the time limit, draping and the return to the input pose end with their last certified state.
    /// @throws InvalidInput, SolverFailure, Cancelled, TimeLimitReached (of rigging and fitting); outputs of the stages
    ///         before it stay in the scene.
    void run(Scene& scene, const Parameters& parameters, const Progress& progress = {}) const;
};

/// Rig Body, Fit Skeleton, Drape Garment, Recover Pose, Dress Body.
const std::vector<Filter>& filters();
/// @throws InvalidInput listing the names.
const Filter& filter_of(std::string_view name);

/// The parameters of one filter, each once.
template <class AnyParameters, class Visitor, IfOptionsOf<AnyParameters, Parameters>* = nullptr>
void describe(const Filter& filter, AnyParameters& p, Visitor&& visit)
{
    if (filter.has(Stage::rig)) {
        describe(p.rig, visit);
        describe(p.body_sizes, visit);
    }
    if (filter.has(Stage::fit)) {
        describe(p.fit, visit);
        describe(p.garment_sizes, visit);
        describe_layers(p.layer_order, visit);
    }
    if (filter.has(Stage::drape)) {
        describe(p.drape, visit);
        describe_pose_path(p.recover, visit);  // worn garments move to the pose of the next one
        if (filter.has(Stage::recover))
            describe_end(p.recover, visit);
    } else if (filter.has(Stage::recover)) {
        describe(p.recover, visit);
    }
    describe_time_limit(p.time_limit, visit);
}

}  // namespace garmentfit
