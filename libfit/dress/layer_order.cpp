// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/layer_order.h"

#include <algorithm>
#include <numeric>

#include "body_parts.h"
#include "tightness.h"

namespace garmentfit {
namespace {

// Of the girth of the body. What is wider by less may as well lie inside: folds, a body that is not quite in the middle.
constexpr double k_wider = 0.05;

/// What is worn over what, by habit: coats over jackets, those over hoodies. Within a row, anything goes.
int habit(GarmentType type)
{
    switch (type) {
    case GarmentType::dress:
    case GarmentType::vest:
    case GarmentType::jumpsuit: return 1;
    case GarmentType::hoodie: return 2;
    case GarmentType::jacket:
    case GarmentType::suit: return 3;
    case GarmentType::coat: return 4;
    default: return 0;
    }
}

struct Layer {
    int habit;
    PerPart widths;
};

/// How much wider than the body a garment is, part by part; 0 where it has no cloth.
PerPart widths(const Rig& rig, const Positions& body, const GarmentMesh& garment, const FitResult& fit)
{
    const Positions posed_body = skin(body, rig.weights, bone_transforms(rig.skeleton, fit.pose));
    return slack(garment.positions, posed_body, rig.weights, pose_skeleton(rig.skeleton, fit.pose));
}

/// Whether a goes over b, by habit or else for it is the wider one, on the mean of the parts that both go round.
bool is_over(const Layer& a, const Layer& b)
{
    double wider = 0;
    int shared = 0;
    for (int p = 0; p < k_body_parts; ++p)
        if (a.widths[p] != 0 && b.widths[p] != 0) {
            wider += a.widths[p] - b.widths[p];
            ++shared;
        }
    return shared > 0 && (a.habit != b.habit ? a.habit > b.habit : wider > k_wider * shared);
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
    std::vector<Layer> all;
    for (std::size_t i = 0; i < garments.size(); ++i)
        all.push_back({ habit(fits[i].type), widths(rig, body, garments[i], fits[i]) });
    std::vector<int> left(garments.size()), layers(garments.size());
    std::iota(left.begin(), left.end(), 0);
    for (int layer = 0; !left.empty(); ++layer) {
        const auto over_none = std::find_if(left.begin(), left.end(), [&](int i) {
            return std::none_of(left.begin(), left.end(), [&](int j) { return is_over(all[i], all[j]); });
        });
        const auto next = over_none != left.end() ? over_none : left.begin();  // each goes over another
        layers[*next] = layer;
        left.erase(next);
    }
    return layers;
}

}  // namespace garmentfit
