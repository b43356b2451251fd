// SPDX-License-Identifier: GPL-3.0-or-later
#include "stand_ins.h"

#include <algorithm>

#include "garmentfit/closed_ends.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/pieces.h"
#include "tuning.h"

namespace garmentfit {
namespace {

bool has_stand_in(const GarmentInput& garment) { return garment.stand_in && garment.stand_in->has_value(); }

GarmentMesh enlarged(GarmentMesh garment, double size)
{
    garment.positions *= size;
    return garment;
}

/// Where a stand-in is that goes with a garment as it is worn. None where it would cross the body there.
std::optional<WornStandIn> stand_in_under(const GarmentInput& garment, const WornGarment& worn,
                                          const TriangleMesh& body)
{
    if (worn.stand_in)
        return worn.stand_in;
    GarmentMesh rest = enlarged((*garment.stand_in)->mesh, worn.size);
    Positions positions = follow(worn.rest, worn.positions, rest, { body });
    if (crossing_count({ positions, rest.triangles }, body) > 0)
        return {};
    return WornStandIn { std::move(rest), std::move(positions) };
}

/// What the garments of a dressing have to keep clear of: the body and each other.
class Company {
public:
    Company(const Positions& body, const Triangles& triangles, const std::vector<WornGarment>& garments) :
        body_ { body, triangles }
    {
        for (const WornGarment& garment : garments)
            clothes_.push_back({ garment.positions, garment.rest.triangles });
    }

    Surroundings around(std::size_t garment) const
    {
        Surroundings result { body_ };
        for (std::size_t i = 0; i < clothes_.size(); ++i)
            if (i != garment && clothes_[i].positions.rows() > 0)
                result.clothes.push_back(clothes_[i]);
        return result;
    }

    void replace(std::size_t garment, const WornGarment& worn)
    {
        clothes_[garment] = { worn.positions, worn.rest.triangles };
    }

private:
    TriangleMesh body_;
    std::vector<TriangleMesh> clothes_;
};

/// The garment in the place of its stand-in.
/// @param following  where it goes with that, from its rest shape
template <class Following>
WornGarment garment_after(const GarmentInput& garment, const WornGarment& led, const Following& following)
{
    OpenedGarment opened = open_ends(garment.mesh);
    WornGarment worn = led;
    worn.stand_in = WornStandIn { led.rest, led.positions, led.certificate.clean() };
    worn.rest = enlarged(std::move(opened.garment), led.size);
    worn.positions = following(worn.rest);
    worn.closed_ends = opened.closed_ends;
    worn.left_out = opened.left_out;
    worn.pieces = count_pieces_held(worn.rest);
    worn.pieces.held += std::exchange(worn.pieces.free, 0);  // the stand-in takes all of them along
    worn.piece_shift = longest_piece_shift(worn.rest, worn.positions);
    return worn;
}

/// Certifies what is worn. @param order  from the inside out. @return whether all are clean
bool certify_worn(std::vector<WornGarment>& garments, const std::vector<std::size_t>& order, const TriangleMesh& body)
{
    std::vector<WornGarment> worn;
    for (const std::size_t i : order)
        worn.push_back(garments[i]);
    const bool clean = certify_all(worn, body);
    for (std::size_t k = 0; k < order.size(); ++k)
        garments[order[k]] = std::move(worn[k]);
    return clean;
}

/// All garments that have stand-ins after these. @return whether all are clean
bool follow_all(const Leading& leading, std::vector<WornGarment>& garments, const Positions& body,
                const Progress& progress)
{
    const auto& [scene, led, order, is_on_the_way] = leading;
    const bool roughly = is_on_the_way;  // Clang 14 cannot capture it as it is
    const Triangles& triangles = scene.body->surface.triangles;
    Company company(body, triangles, garments);
    for (const std::size_t i : order)
        if (has_stand_in(led.garments[i])) {
            const WornGarment& leader = garments[i];
            garments[i] = garment_after(scene.garments[i], leader, [&](const GarmentMesh& rest) {
                return roughly ? follow_roughly(leader.rest, leader.positions, rest)
                               : follow(leader.rest, leader.positions, rest, company.around(i), progress);
            });
            company.replace(i, garments[i]);
        }
    return certify_worn(garments, order, { body, triangles });
}

/// @param led  the garments of the dressing as they were led
void follow_in_frames(const Leading& leading, Dressing& dressing, const std::vector<WornGarment>& led,
                      const Progress& progress)
{
    std::vector<RecoverFrame> clean;
    for (RecoverFrame& frame : dressing.frames) {
        std::vector<WornGarment> garments = led;
        for (const std::size_t i : leading.order)
            garments[i].positions = frame.garments[i];
        if (!follow_all(leading, garments, frame.body, progress))
            continue;
        for (const std::size_t i : leading.order)
            frame.garments[i] = garments[i].positions;
        clean.push_back(std::move(frame));
    }
    dressing.frames = std::move(clean);
}

/// Whether it is so in a file of single precision, too: sheets that follow may end closer than its digits.
bool is_surely_clean(WornGarment worn, const Dressing& end, const Triangles& body)
{
    worn.positions = worn.positions.cast<float>().cast<double>();
    std::vector<WornGarment> alone { std::move(worn) };
    return certify_all(alone, { end.body, body });
}

/// Whether the body did not reach its size in cloth that passes through itself there: folds in each other may hold what
/// is wide enough.
bool may_be_caught(const Dressing& end)
{
    return end.scale_reached < 1 && std::any_of(end.garments.begin(), end.garments.end(), [](const WornGarment& worn) {
               return worn.certificate.self_crossings > 0 || !worn.certificate.kept_self_crossings.empty();
           });
}

/// Whether what follows its stand-in is not clean, or far more strained than that, or found no rest of its own where it
/// should.
bool follows_badly(const Dressing& end, std::size_t garment, bool is_rough, const Triangles& body)
{
    if (!end.is_worn(garment))
        return true;
    const WornGarment& worn = end.garments[garment];
    if (is_rough)
        return worn.stand_in.has_value();
    if (!end.certified)
        return true;
    if (!worn.stand_in)
        return false;
    const double led = strain_of(worn.stand_in->rest, worn.stand_in->positions).p95;
    return worn.certificate.strain.p95 > led + k_follower_strain || !is_surely_clean(worn, end, body);
}

}  // namespace

bool give_up_stand_ins(Scene& scene)
{
    const Dressing* end = final_dressing(scene);
    if (!end)
        return false;
    const bool is_too_small = outcome_of(*end) == Outcome::too_small;
    bool any = false;
    for (std::size_t i = 0; i < scene.garments.size(); ++i) {
        if (!has_stand_in(scene.garments[i]))
            continue;
        const StandIn& stand_in = **scene.garments[i].stand_in;
        if (stand_in.is_needed || (is_too_small && !stand_in.is_rough)
            || !follows_badly(*end, i, stand_in.is_rough, scene.body->surface.triangles))
            continue;
        scene.garments[i].stand_in = std::optional<StandIn>();
        any = true;
    }
    return any;
}

bool find_linings(Scene& scene)
{
    const Dressing* end = final_dressing(scene);
    if (!end || outcome_of(*end) == Outcome::done || (outcome_of(*end) == Outcome::too_small && !may_be_caught(*end)))
        return false;
    bool any = false;
    for (GarmentInput& garment : scene.garments)
        if (garment.stand_in && !has_stand_in(garment)) {
            garment.stand_in = make_lining(garment.mesh);
            any |= has_stand_in(garment);
        }
    return any;
}

bool is_led_roughly(const Scene& scene)
{
    return std::none_of(scene.garments.begin(), scene.garments.end(), [](const GarmentInput& garment) {
        return has_stand_in(garment) && !(*garment.stand_in)->is_rough;
    });
}

bool find_stand_ins(Scene& scene)
{
    for (GarmentInput& garment : scene.garments)
        if (!garment.stand_in)
            garment.stand_in = make_stand_in(garment.mesh);
    if (!is_led_roughly(scene))
        for (GarmentInput& garment : scene.garments)
            if (has_stand_in(garment) && (*garment.stand_in)->is_rough)
                garment.stand_in = std::optional<StandIn>();
    return std::any_of(scene.garments.begin(), scene.garments.end(), has_stand_in);
}

Scene with_stand_ins_to_be_found(Scene led)
{
    for (GarmentInput& garment : led.garments)
        if (has_stand_in(garment))
            garment.stand_in.reset();
    return led;
}

Scene lead(Scene scene)
{
    for (std::size_t i = 0; i < scene.garments.size(); ++i) {
        GarmentInput& garment = scene.garments[i];
        if (!has_stand_in(garment))
            continue;
        if (scene.draped && scene.draped->is_worn(i)) {
            WornGarment& worn = scene.draped->garments[i];
            auto stand_in = stand_in_under(garment, worn, { scene.draped->body, scene.body->surface.triangles });
            if (!stand_in) {  // the garment itself moves on
                garment.stand_in = std::optional<StandIn>();
                continue;
            }
            worn.rest = std::move(stand_in->rest);
            worn.positions = std::move(stand_in->positions);
            worn.stand_in.reset();
            if (stand_in->is_clean)
                worn.certificate = Certificate();
        }
        garment.mesh = (*garment.stand_in)->mesh;
    }
    return scene;
}

Dressing follow_stand_ins(const Leading& leading, Dressing dressing, const ClothOptions& cloth,
                          const Progress& progress)
{
    const auto& [scene, led, order, is_on_the_way] = leading;
    const std::vector<WornGarment> led_garments = dressing.garments;
    dressing.certified &= follow_all(leading, dressing.garments, dressing.body, progress);
    follow_in_frames(leading, dressing, led_garments, progress);
    const TriangleMesh body { dressing.body, scene.body->surface.triangles };
    for (const std::size_t i : order)
        if (has_stand_in(led.garments[i]))
            dressing.maps[i] = fit_map(body, dressing.garments[i], cloth);
    return dressing;
}

}  // namespace garmentfit
