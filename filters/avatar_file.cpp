// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/avatar_file.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

#include "diagonal.h"
#include "garmentfit/error.h"
#include "garmentfit/skinned_gltf.h"

namespace garmentfit {
namespace {

// Shares of the diagonal.
constexpr double k_same_vertex = 1e-3;  // unit: far more than the rounding of a file of floats
constexpr double k_same_spot = 1e-5;  // unit: more than the rounding of a text file of six digits; vertices lie wider

std::array<Frame, 3> frames_to_try(const Frame& body)
{
    return { body, Frame(), Frame { body.metres_per_unit, Frame().up } };
}

/// The nearest of `places` within `close` of each of `points`; -1 for none.
std::vector<int> nearest_rows(const Positions& points, const Positions& places, double close)
{
    std::vector<int> by_x(std::size_t(places.rows()));
    std::iota(by_x.begin(), by_x.end(), 0);
    std::stable_sort(by_x.begin(), by_x.end(), [&](int a, int b) { return places(a, 0) < places(b, 0); });
    std::vector<int> nearest(std::size_t(points.rows()), -1);
    for (Eigen::Index p = 0; p < points.rows(); ++p) {
        auto row = std::lower_bound(by_x.begin(), by_x.end(), points(p, 0) - close,
                                    [&](int place, double x) { return places(place, 0) < x; });
        double least = close;
        for (; row != by_x.end() && places(*row, 0) <= points(p, 0) + close; ++row)
            if (const double distance = (places.row(*row) - points.row(p)).norm(); distance < least) {
                least = distance;
                nearest[std::size_t(p)] = *row;
            }
    }
    return nearest;
}

/// @throws InvalidInput where a vertex of the body lies at none of the file.
AvatarFile match_by_place(const MeshFile& file, const Positions& body, const Frame& body_frame)
{
    const double close = k_same_spot * diagonal_of(body);
    std::ptrdiff_t fewest_astray = body.rows();
    for (const Frame& frame : frames_to_try(body_frame)) {
        const Positions in_file = frame.to_metres(file.positions());
        const std::vector<int> rows = nearest_rows(body, in_file, close);
        const std::ptrdiff_t astray = std::count(rows.begin(), rows.end(), -1);
        if (astray == 0)
            return { file.path(), frame, rows, nearest_rows(in_file, body, close) };
        fewest_astray = std::min(fewest_astray, astray);
    }
    throw InvalidInput(ErrorCode::rig_mismatch,
                       file.path().string() + ": " + std::to_string(fewest_astray) + " of the "
                           + std::to_string(body.rows()) + " vertices of the body do not lie where any of its "
                           + std::to_string(file.positions().rows())
                           + " do; give the file that the body was read from, and the body as it lies there");
}

}  // namespace

std::optional<AvatarFile> avatar_in(const MeshFile& body, const Frame& frame)
{
    const bool is_gltf = body.format() == "glb" || body.format() == "gltf";
    return is_gltf && has_skin(body.path()) ? std::optional(AvatarFile { body.path(), frame }) : std::nullopt;
}

std::optional<AvatarFile> avatar_of_body(const std::filesystem::path& path, const Positions& body,
                                         const Frame& body_frame)
{
    const MeshFile file = MeshFile::read(path);
    const std::optional<Frame> frame = frame_on_body(file.positions(), body, body_frame);
    std::optional<AvatarFile> avatar = avatar_in(file, frame.value_or(Frame()));
    if (avatar && !frame)
        avatar = match_by_place(file, body, body_frame);
    return avatar;
}

std::optional<Frame> frame_on_body(const Positions& in_file, const Positions& body, const Frame& body_frame)
{
    const double close = k_same_vertex * diagonal_of(body);
    if (in_file.rows() == body.rows())
        for (const Frame& frame : frames_to_try(body_frame))
            if ((frame.to_metres(in_file) - body).rowwise().norm().maxCoeff() < close)
                return frame;
    return std::nullopt;
}

}  // namespace garmentfit
