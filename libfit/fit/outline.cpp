// SPDX-License-Identifier: GPL-3.0-or-later
#include "outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "front_shape.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// Of points, seen from above, m.
class Widths {
public:
    void add(const Vec3& point)
    {
        for (int i = 0; i < directions; ++i) {
            const double angle = double(EIGEN_PI) * i / directions;
            const double along = point.x() * std::cos(angle) + point.z() * std::sin(angle);
            low_[i] = std::min(low_[i], along);
            high_[i] = std::max(high_[i], along);
        }
    }

    // 0 without points.
    double greatest() const
    {
        double greatest = 0;
        for (int i = 0; i < directions; ++i)
            greatest = std::max(greatest, high_[i] - low_[i]);
        return greatest;
    }

    // Of the convex hull: pi times the mean of its widths (Cauchy). @pre a point
    double girth() const
    {
        double sum = 0;
        for (int i = 0; i < directions; ++i)
            sum += high_[i] - low_[i];
        return std::max(double(EIGEN_PI) * sum / directions, 1e-9);
    }

private:
    static constexpr int directions = 16;  // unit: girths are exact to 1 % for ellipses
    static constexpr std::array<double, directions> all(double value)
    {
        std::array<double, directions> result {};
        result.fill(value);
        return result;
    }

    std::array<double, directions> low_ = all(std::numeric_limits<double>::infinity()),
                                   high_ = all(-std::numeric_limits<double>::infinity());
};

struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;
};

Span heights_of(const std::vector<ClothPatch>& cloth)
{
    Span heights;
    for (const ClothPatch& patch : cloth) {
        heights.low = std::min(heights.low, double(patch.centre.y()));
        heights.high = std::max(heights.high, double(patch.centre.y()));
    }
    return heights;
}

// Without what runs up a slit. @param height  m, of the garment
double width_of_end(const Opening& end, double height)
{
    const double level = end.facing.y() < 0 ? end.low.y() : end.high.y();
    Widths widths;
    for (int i = 0; i < end.rim.rows(); ++i)
        if (std::abs(end.rim(i, 1) - level) < k_end_slice * height)
            widths.add(end.rim.row(i).transpose());
    return widths.greatest();
}

double greatest_width(const std::vector<ClothPatch>& cloth, const Span& heights)
{
    constexpr int slices = 24;  // unit: a short sleeve has three of them
    std::array<Widths, slices> widths;
    for (const ClothPatch& patch : cloth) {
        const double share = (patch.centre.y() - heights.low) / (heights.high - heights.low);
        widths[std::clamp(int(share * slices), 0, slices - 1)].add(patch.centre.cast<double>());
    }
    double greatest = 0;
    for (const Widths& one : widths)
        greatest = std::max(greatest, one.greatest());
    return greatest;
}

}  // namespace

double taper_of(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings, const GarmentCues& cues,
                double leg)
{
    if (!cues.is_strapless)
        return 0;
    double widest = 0;
    for (const Opening& opening : openings)
        widest = std::max(widest, opening.girth);
    const Opening* top = highest_opening(openings, k_wide_top * widest);
    if (!top)
        return 0;
    Widths rim, below;
    for (int i = 0; i < top->rim.rows(); ++i)
        rim.add(top->rim.row(i).transpose());
    const double height = top->rim.col(1).mean() - k_taper_depth * leg;
    std::size_t patches = 0;
    for (const ClothPatch& patch : cloth)
        if (std::abs(patch.centre.y() - height) < k_taper_slice * leg) {
            below.add(patch.centre.cast<double>());
            ++patches;
        }
    if (patches < k_min_slice)
        return 0;
    return std::clamp(std::log(rim.girth() / below.girth()) / k_tenth, -k_max_taper, k_max_widening);
}

double reach_of(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings)
{
    const Span heights = heights_of(cloth);
    const double height = heights.high - heights.low;
    double widest_end = 0;
    for (const Opening& opening : openings)
        if (std::abs(opening.facing.y()) > k_end_facing)
            widest_end = std::max(widest_end, width_of_end(opening, height));
    if (!(widest_end > 0 && height > 0))
        return 0;
    return std::clamp(std::log(greatest_width(cloth, heights) / widest_end) / k_tenth, 0.0, k_max_reach);
}

}  // namespace garmentfit
