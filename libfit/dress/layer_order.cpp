// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/layer_order.h"

#include <algorithm>
#include <numeric>

#include "body_parts.h"
#include "tightness.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// The usual layer of a type: coats over jackets, jackets over hoodies. Types of the same layer may go either way.
int usual_layer(GarmentType type)
{
    switch (type) {
    case GarmentType::dress:
    case GarmentType::vest:
    case GarmentType::overalls:
    case GarmentType::jumpsuit: return 1;
    case GarmentType::hoodie: return 2;
    case GarmentType::jacket:
    case GarmentType::suit: return 3;
    case GarmentType::coat:
    case GarmentType::robe:
    case GarmentType::poncho:
    case GarmentType::cape: return 4;
    default: return 0;
    }
}

struct Candidate {
    int usual_layer;
    PerPart slacks;
};

/// How much wider than the body a garment is, part by part; 0 where it has no cloth.
PerPart measure_slack(const Rig& rig, const Positions& body, const GarmentMesh& garment, const FitResult& fit)
{
    const Positions posed_body = skin(body, rig.weights, bone_transforms(rig.skeleton, fit.pose));
    return slack(garment.positions, posed_body, rig.weights, pose_skeleton(rig.skeleton, fit.pose));
}

/// Whether a goes over b: by its usual layer, or where that is the same, because it is wider in the mean of the parts
/// that both go round.
bool is_over(const Candidate& a, const Candidate& b)
{
    double wider = 0;
    int shared = 0;
    for (int p = 0; p < k_body_parts; ++p)
        if (a.slacks[p] != 0 && b.slacks[p] != 0) {
            wider += a.slacks[p] - b.slacks[p];
            ++shared;
        }
    return shared > 0
        && (a.usual_layer != b.usual_layer ? a.usual_layer > b.usual_layer : wider > k_clearly_wider * shared);
}

}  // namespace

const std::vector<std::string_view>& layer_order_names()
{
    static const std::vector<std::string_view> names { "given", "auto" };
    return names;
}

std::vector<int> order_layers(const Rig& rig, const Positions& body, const std::vector<GarmentMesh>& garments,
                              const std::vector<FitResult>& fits)
{
    std::vector<Candidate> all;
    for (std::size_t i = 0; i < garments.size(); ++i)
        all.push_back({ usual_layer(fits[i].type), measure_slack(rig, body, garments[i], fits[i]) });
    std::vector<int> left(garments.size()), layers(garments.size());
    std::iota(left.begin(), left.end(), 0);
    for (int layer = 0; !left.empty(); ++layer) {
        const auto over_none = std::find_if(left.begin(), left.end(), [&](int i) {
            return std::none_of(left.begin(), left.end(), [&](int j) { return is_over(all[i], all[j]); });
        });
        const auto next = over_none != left.end() ? over_none : left.begin();  // in a cycle each goes over another
        layers[*next] = layer;
        left.erase(next);
    }
    return layers;
}

}  // namespace garmentfit
