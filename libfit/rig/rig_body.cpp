// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/rig_body.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "body_graph.h"
#include "closed_surface.h"
#include "curve_skeleton.h"
#include "figure_graph.h"
#include "figure_joints.h"
#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "given_joints.h"
#include "heat_weights.h"
#include "joint_labels.h"
#include "proxy_surface.h"
#include "rig_validation.h"
#include "shell_figure.h"
#include "side_classification.h"
#include "skin_transfer.h"
#include "skin_weights.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

struct LimbBones {
    int root, upper, lower;
    Extremity tip;
};

constexpr LimbBones k_left_arm { lclavicle, lhumerus, lradius, lhand_tip },
    k_right_arm { rclavicle, rhumerus, rradius, rhand_tip }, k_left_leg { lhipjoint, lfemur, ltibia, lfoot_tip },
    k_right_leg { rhipjoint, rfemur, rtibia, rfoot_tip };

void place(const LimbJoints& joints, const LimbBones& bones, Skeleton& skeleton)
{
    skeleton.tails[bones.root] = joints.root;
    skeleton.tails[bones.upper] = joints.middle;
    skeleton.tails[bones.lower] = joints.end;
    skeleton.tips[bones.tip] = joints.tip;
}

Skeleton build_skeleton(const BodyJoints& joints, const Sides& sides)
{
    Skeleton skeleton;
    skeleton.root = joints.pelvis;
    skeleton.tails[lowerback] = joints.lower_spine;
    skeleton.tails[upperback] = joints.upper_spine;
    skeleton.tails[thorax] = joints.neck_base;
    skeleton.tails[lowerneck] = joints.mid_neck;
    skeleton.tails[upperneck] = joints.skull_base;
    skeleton.tips[head_top] = joints.crown;
    place(joints.arms[sides.left_arm], k_left_arm, skeleton);
    place(joints.arms[1 - sides.left_arm], k_right_arm, skeleton);
    place(joints.legs[sides.left_leg], k_left_leg, skeleton);
    place(joints.legs[1 - sides.left_leg], k_right_leg, skeleton);
    return skeleton;
}

/// The bones inside a part of the surface and their neighbours.
std::array<bool, bone_count> bones_of_curve(int curve, const Sides& sides)
{
    std::array<bool, bone_count> visible {};
    const auto see = [&](std::initializer_list<int> bones) {
        for (const int b : bones)
            visible[b] = true;
    };
    const auto see_limb = [&](const LimbBones& limb) { see({ limb.root, limb.upper, limb.lower }); };
    if (curve < 2) {
        see_limb(curve == sides.left_arm ? k_left_arm : k_right_arm);
        see({ thorax });  // an arm's curve begins at the flank
    } else if (curve < k_head_curve)
        see_limb(curve - 2 == sides.left_leg ? k_left_leg : k_right_leg);
    else if (curve == k_head_curve)
        see({ thorax, lowerneck, upperneck, lclavicle, rclavicle });
    else
        see({ lhipjoint, rhipjoint, lowerback, upperback, thorax, lclavicle, rclavicle });
    return visible;
}

VisibleBones visible_bones(const CurveSkeleton& curves, const BodyGraph& graph, const Sides& sides)
{
    VisibleBones visible;
    for (const int node : curves.node_of_vertex) {
        const int curve = node < 0 ? -1 : graph.place_of_node[node].curve;
        visible.push_back(bones_of_curve(curve, sides));
        if (graph.has_covered_legs && (curve < 0 || curve == k_trunk_curve))
            for (const int bone : { lfemur, ltibia, rfemur, rtibia })
                visible.back()[bone] = true;
    }
    return visible;
}

/// A body far from the origin loses digits in differences of squares.
BodyMesh centre_at_origin(BodyMesh body, const Vec3& centre)
{
    body.surface.positions.rowwise() -= centre.transpose();
    body.closed.positions.rowwise() -= centre.transpose();
    return body;
}

Skeleton translate(Skeleton skeleton, const Vec3& by)
{
    skeleton.root += by;
    for (Vec3& tail : skeleton.tails)
        tail += by;
    for (Vec3& tip : skeleton.tips)
        tip += by;
    return skeleton;
}

/// A skeleton, and the bones that each vertex of the proxy may belong to.
struct VisibleRig {
    Rig rig;  ///< without weights
    VisibleBones visible;
};

/// A decimated copy of the body and its curves, which the human and the figure are both looked for in.
struct Contracted {
    TriangleMesh proxy;
    CurveSkeleton curves;
};

Sides sides_of(const BodyJoints& joints, const RigOptions& options)
{
    Sides sides = classify_sides(joints, options.front);
    if (options.swap_sides) {
        sides.left_arm = 1 - sides.left_arm;
        sides.left_leg = 1 - sides.left_leg;
        sides.front = -sides.front;
    }
    return sides;
}

VisibleRig name_bones(const BodyJoints& joints, const Sides& sides, VisibleBones visible, const RigOptions& options)
{
    VisibleRig found { {}, std::move(visible) };
    found.rig.skeleton = correct(build_skeleton(joints, sides), options.joints);
    found.rig.up = sides.up;
    found.rig.front = sides.front;
    found.rig.side_confidence = sides.confidence;
    return found;
}

VisibleRig name_sides(const CurveSkeleton& curves, const BodyGraph& graph, const BodyJoints& joints,
                      const RigOptions& options)
{
    const Sides sides = sides_of(joints, options);
    return name_bones(joints, sides, visible_bones(curves, graph, sides), options);
}

/// Refuses what may be a figure of other proportions; the figures are then looked at.
class Doubtful : public InvalidInput {
    using InvalidInput::InvalidInput;
};

/// @throws InvalidInput when it is no human; Doubtful, unless `strict`, when lengths are not a human's though no hand
/// or foot is missing.
VisibleRig find_bones(const Contracted& body, const RigOptions& options)
{
    const BodyGraph graph = body_graph(body.curves);
    const BodyJoints joints = label_joints(body.proxy, body.curves, graph);
    if (options.humanlike == Humanlike::any && graph.spread > k_doubtful_spread && are_whole(joints.arms)
        && are_whole(joints.legs))
        throw Doubtful(ErrorCode::not_human,
                       "body: the lengths between head, hands and feet differ from a human's by a spread of "
                           + fixed_text(graph.spread, 2) + " (usually at most " + fixed_text(k_doubtful_spread, 2)
                           + ")");
    return name_sides(body.curves, graph, joints, options);
}

/// For joints that are all given: nothing is searched, and every vertex may belong to every bone.
VisibleRig take_given_bones(const TriangleMesh& proxy, const GivenJoints& joints)
{
    std::array<bool, bone_count> all;
    all.fill(true);
    VisibleRig given { {}, VisibleBones(proxy.positions.rows(), all) };
    const Skeleton& s = given.rig.skeleton = skeleton_of(joints);
    given.rig.up = (s.tail(thorax) - s.root).normalized();
    given.rig.front = (s.tail(lhipjoint) - s.tail(rhipjoint)).cross(given.rig.up).normalized();
    given.rig.side_confidence = 1;
    return given;
}

/// Adds weights and radii.
Rig weigh(VisibleRig found, const TriangleMesh& proxy, const BodyMesh& body, const Progress& progress)
{
    Rig& rig = found.rig;
    const Eigen::MatrixXd weights = heat_weights(proxy, rig.skeleton, found.visible);
    progress.at(0.5);
    rig.weights = transfer_skin_weights(proxy, weights, body);
    rig.radii = bone_radii(rig.skeleton, rig.weights, body.surface.positions);
    progress.at(1);
    return rig;
}

GivenJoints translate(GivenJoints joints, const Vec3& by)
{
    const auto move = [&](std::optional<Vec3>& joint) {
        if (joint)
            *joint += by;
    };
    move(joints.root);
    std::for_each(joints.tails.begin(), joints.tails.end(), move);
    std::for_each(joints.tips.begin(), joints.tips.end(), move);
    return joints;
}

struct Attempt {
    double proxy;  ///< share of RigOptions::proxy_vertices
    double from, to;  ///< part of the progress
};

constexpr double k_human_search = 0.97;  // unit: share of the progress bar; the rest is the search for a figure

// unit: shares of the progress bar; those of the proxy are fitted, see tuning.h.
// At touching hands or deep bends the flow may fail with one triangulation and succeed with another.
constexpr Attempt k_attempts[]
    = { { 1, 0, 0.9 }, { k_coarser_proxy, 0.9, 0.95 }, { k_finer_proxy, 0.95, k_human_search } };

Contracted contract(TriangleMesh proxy, const Progress& progress)
{
    CurveSkeleton curves = curve_skeleton(proxy, progress.part(0.15, 1));
    return { std::move(proxy), std::move(curves) };
}

/// The copies of a closed body, decimated and contracted one by one. Those of a body with few vertices may be the body
/// itself each time, or quarter its triangles into far more than asked: after the first, these are left out.
class Copies {
public:
    Copies(const TriangleMesh& closed, const RigOptions& options) : closed_(closed), vertices_(options.proxy_vertices)
    {
    }

    const std::vector<Contracted>& all() const { return contracted_; }
    bool has_more() const { return next_ < int(std::size(k_attempts)); }

    /// The copy of the next attempt, or nullptr where it is left out. Valid until the next call. @pre has_more()
    /// @throws InvalidInput when it does not contract to curves.
    const Contracted* add_next(const Progress& progress)
    {
        const int vertices = int(k_attempts[next_++].proxy * vertices_);
        TriangleMesh proxy = proxy_surface(closed_, vertices);
        progress.at(0.15);
        if (next_ > 1 && double(proxy.positions.rows()) > k_most_quartered * vertices)
            return nullptr;
        for (const Contracted& other : contracted_)
            if (other.proxy.positions.rows() == proxy.positions.rows() && other.proxy.positions == proxy.positions
                && other.proxy.triangles.rows() == proxy.triangles.rows() && other.proxy.triangles == proxy.triangles)
                return nullptr;
        contracted_.push_back(contract(std::move(proxy), progress));
        return &contracted_.back();
    }

private:
    const TriangleMesh& closed_;
    int vertices_;
    int next_ = 0;
    std::vector<Contracted> contracted_;
};

/// What `make` returns for the first attempt that it accepts; it may return nothing, where nothing is new.
/// @throws InvalidInput of the first attempt, when it refuses all, or at the first doubt.
template <class Make>
Rig first_valid_rig(const Make& make)
{
    std::optional<InvalidInput> refusal;
    for (const Attempt& attempt : k_attempts)
        try {
            if (std::optional<Rig> rig = make(attempt))
                return *std::move(rig);
        } catch (const Doubtful&) {
            throw;
        } catch (const InvalidInput& reason) {
            if (!refusal)
                refusal = reason;
        }
    throw *refusal;
}

/// @param copies  gets what was contracted on the way
Rig rig_as_human(const BodyMesh& body, const RigOptions& options, Copies& copies, const Progress& progress)
{
    return first_valid_rig([&](const Attempt& attempt) -> std::optional<Rig> {
        const Progress part = progress.part(attempt.from, attempt.to);
        const Contracted* const copy = copies.add_next(part.part(0, 0.8));
        if (!copy)
            return {};
        VisibleRig found = find_bones(*copy, options);
        part.at(0.8);
        check_rig(copy->proxy, found.rig.skeleton);
        if (!options.front && !options.swap_sides)  // else the user decides what is forwards
            check_feet(found.rig.skeleton);
        Rig rig = weigh(std::move(found), copy->proxy, body, part.part(0.8, 1));
        progress.at(1);
        return rig;
    });
}

/// Weights of a figure of shells on its own vertices. A limb's shells have too few vertices for an equilibrium of heat:
/// upper and lower bone share them by their place along it.
SkinWeights weigh_shells(const VisibleRig& found, const TriangleMesh& surface)
{
    const Skeleton& s = found.rig.skeleton;
    Eigen::MatrixXd weights = heat_weights(surface, s, found.visible);
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v)
        for (const LimbBones& limb : { k_left_arm, k_right_arm, k_left_leg, k_right_leg })
            if (const auto& visible = found.visible[std::size_t(v)]; visible[limb.lower]) {
                const Vec3 along = s.tail(limb.lower) - s.tail(limb.root);
                const double beyond
                    = (Vec3(surface.positions.row(v)) - s.tail(limb.upper)).dot(along) / along.squaredNorm();
                const double lower = std::clamp(0.5 + 0.5 * beyond / k_shell_bend, 0.0, 1.0);
                weights.row(v).setZero();
                weights(v, limb.upper) = 1 - lower;
                weights(v, limb.lower) = lower;
            }
    return strongest_four(std::move(weights));
}

constexpr const char* k_covered_legs = "its legs do not show, as in a gown, and are placed by a human's proportions";
constexpr const char* k_other_lengths = "the lengths between head, hands and feet are not a human's";

/// @param cost  of the names of the limbs, half a sum of squares
void say_how_human(const HumanLikeness& human, double cost, Rig& rig)
{
    rig.human_probability = std::exp(-0.5 * human.squares - cost);
    if (rig.human_probability < 1)
        rig.not_human = human.furthest.empty() ? k_other_lengths : human.furthest;
}

Rig rig_by_given_joints(const BodyMesh& body, const RigOptions& options, const Progress& progress)
{
    return first_valid_rig([&](const Attempt& attempt) {
        const TriangleMesh proxy = proxy_surface(body.closed, int(attempt.proxy * options.proxy_vertices));
        VisibleRig given = take_given_bones(proxy, options.joints);
        progress.at(attempt.to * 0.8);
        if (options.humanlike == Humanlike::strict)
            check_rig(proxy, given.rig.skeleton);
        else
            say_how_human(human_likeness(proxy, given.rig.skeleton), 0, given.rig);
        return weigh(std::move(given), proxy, body, progress.part(attempt.to * 0.8, 1));
    });
}

/// Limbs whose joints were not seen but placed as a human's.
int count_divided(const BodyJoints& joints)
{
    int count = 0;
    for (const LimbJoints& limb : { joints.arms[0], joints.arms[1], joints.legs[0], joints.legs[1] })
        count += !limb.whole && !limb.widens;
    return count;
}

/// Finds the likeliest figure among several contracted surfaces.
class FigureSearch {
public:
    explicit FigureSearch(const RigOptions& options) : options_(options) { }

    /// @param doubt  costs of the surface
    void look_at(const Contracted& body, double doubt = 0)
    {
        try {
            const Figure figure = figure_graph(body.curves, body.proxy);
            const BodyJoints joints = label_figure(body.proxy, body.curves, figure);
            VisibleRig found = name_sides(body.curves, figure.graph, joints, options_);
            const HumanLikeness human = human_likeness(body.proxy, found.rig.skeleton);
            if (take(std::move(found), human, figure.cost, k_divided_cost * count_divided(joints) + doubt, body.proxy,
                     false)
                && figure.graph.has_covered_legs && human.furthest.empty())
                best_->rig.not_human = k_covered_legs;
        } catch (const InvalidInput&) {
            // another triangulation may do
        }
    }

    /// At the shells of the surface as given. Its own vertices get the weights, as a closed one joins limbs that touch.
    void look_at_shells(const BodyMesh& body)
    {
        if (!body.repaired)
            return;  // one shell
        const std::optional<ShellFigure> figure = shell_figure(body.surface);
        if (!figure)
            return;
        try {
            const Sides sides = sides_of(figure->joints, options_);
            VisibleBones visible;
            for (const int curve : figure->curve_of_vertex)
                visible.push_back(bones_of_curve(curve, sides));
            VisibleRig found = name_bones(figure->joints, sides, std::move(visible), options_);
            const HumanLikeness human = human_likeness(body.closed, found.rig.skeleton);
            take(std::move(found), human, figure->cost, 0, body.surface, true);
        } catch (const InvalidInput&) {
            // its curves may show another figure
        }
    }

    bool is_sure() const { return best_ && score_ > k_sure_figure; }
    bool has_found() const { return best_.has_value(); }

    /// @pre has_found()
    Rig weigh_best(const BodyMesh& body, const Progress& progress)
    {
        if (!is_of_shells_)
            return weigh(*std::move(best_), proxy_, body, progress);
        Rig rig = best_->rig;
        rig.weights = weigh_shells(*best_, proxy_);
        rig.radii = bone_radii(rig.skeleton, rig.weights, body.surface.positions);
        progress.at(1);
        return rig;
    }

private:
    /// @param cost  of the names. @param doubt  further costs
    /// @return whether this is the likeliest figure so far
    bool take(VisibleRig found, const HumanLikeness& human, double cost, double doubt, const TriangleMesh& proxy,
              bool is_of_shells)
    {
        const double score = -0.5 * human.squares - cost - doubt;
        if (best_ && score <= score_)
            return false;
        say_how_human(human, cost, found.rig);
        score_ = score;
        best_ = std::move(found);
        proxy_ = proxy;
        is_of_shells_ = is_of_shells;
        return true;
    }

    const RigOptions& options_;
    std::optional<VisibleRig> best_;
    TriangleMesh proxy_;  ///< whose vertices the visible bones are of
    bool is_of_shells_ = false;  ///< the proxy is the surface as given
    double score_ = 0;
};

/// Looks at a wrap of a body in parts. @return the vertices of the wrap, 0 where there is none
Eigen::Index look_at_wrap(FigureSearch& search, const BodyMesh& body, Gaps gaps, const RigOptions& options,
                          const Progress& progress)
{
    Eigen::Index vertices = 0;
    try {
        const std::optional<TriangleMesh> joined = join_parts(body.surface, gaps, progress.part(0, 0.5));
        if (!joined)
            return 0;
        vertices = joined->positions.rows();
        TriangleMesh proxy = proxy_surface(*joined, options.proxy_vertices);
        search.look_at(contract(std::move(proxy), progress.part(0.5, 1)), gaps == Gaps::wide ? k_wide_wrap_cost : 0);
    } catch (const InvalidInput&) {
        // this wrap does not contract to curves
    }
    return vertices;
}

/// Looks at what was contracted for a human, at finer and coarser copies, and, of a body in parts, at other ways to join
/// them.
void look_for_figures(FigureSearch& search, const BodyMesh& body, const RigOptions& options, Copies& copies,
                      const Progress& progress)
{
    for (const Contracted& copy : copies.all())
        search.look_at(copy);
    search.look_at_shells(body);
    for (; copies.has_more() && !search.is_sure(); progress.at(0.2))
        try {
            if (const Contracted* const copy = copies.add_next(progress.part(0, 0.2)))
                search.look_at(*copy);
        } catch (const InvalidInput&) {
            // this copy does not contract to curves
        }
    if (!body.repaired || search.is_sure())
        return;
    const Eigen::Index vertices = look_at_wrap(search, body, Gaps::wide, options, progress.part(0.2, 0.5));
    if (vertices <= k_most_in_wide_wrap && !search.is_sure())
        look_at_wrap(search, body, Gaps::narrow, options, progress.part(0.5, 0.8));
}

/// @throws `refusal` when there is none, also where the time ends before all is looked at: why it is no human says more.
Rig find_figure(const BodyMesh& body, const RigOptions& options, Copies& copies, const InvalidInput& refusal,
                const Progress& progress)
{
    FigureSearch search(options);
    try {
        look_for_figures(search, body, options, copies, progress);
    } catch (const TimeLimitReached&) {
        if (search.has_found())
            throw;
        throw InvalidInput(refusal.code(),
                           std::string(refusal.what()) + " (nor was another figure found within the time limit)");
    }
    if (!search.has_found())
        throw refusal;
    return search.weigh_best(body, progress.part(0.8, 1));
}

Rig rig_at_origin(const BodyMesh& body, const RigOptions& options, const Progress& progress)
{
    if (options.joints.is_complete())
        return rig_by_given_joints(body, options, progress);
    Copies copies(body.closed, options);
    try {
        return rig_as_human(body, options, copies, progress);
    } catch (const InvalidInput& refusal) {
        if (options.humanlike == Humanlike::strict)
            throw;
        return find_figure(body, options, copies, refusal, progress.part(k_human_search, 1));
    }
}

}  // namespace

const std::vector<std::string_view>& humanlike_names()
{
    static const std::vector<std::string_view> names { "any", "strict" };
    return names;
}

Rig rig_body(const BodyMesh& body, const RigOptions& options, const Progress& progress)
{
    const Vec3 centre = 0.5 * (body.closed.positions.colwise().minCoeff() + body.closed.positions.colwise().maxCoeff());
    const BodyMesh at_origin = centre_at_origin(body, centre);
    RigOptions centred = options;
    centred.joints = translate(options.joints, -centre);
    const bool is_searched = !options.joints.is_complete();
    if (is_searched)
        check_shape(at_origin.closed, options.humanlike);
    Rig rig = rig_at_origin(at_origin, centred, progress);
    if (is_searched)
        check_figure(at_origin.closed, rig);
    rig.skeleton = translate(rig.skeleton, centre);
    return rig;
}

}  // namespace garmentfit
