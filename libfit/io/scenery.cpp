// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenery.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"
#include "garmentfit/units.h"
#include "gltf_skin.h"
#include "gltf_unpack.h"
#include "nearest.h"
#include "part_of_mesh.h"
#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// Of each vertex of a skinned glTF whether a joint moves it. @throws InvalidInput: no skin, mangled
std::vector<char> find_moved(const std::filesystem::path& avatar)
{
    const FileBytes file = read_file(avatar);
    const tinygltf::Model model = load_model(file, read_plain_gltf(file, avatar.parent_path()), avatar.parent_path());
    const FileSkin skin = read_skin(file, model);
    std::vector<char> is_moved(skin.hangs.size(), 1);
    for (const int v : skin.loose)
        is_moved[std::size_t(v)] = 0;
    return is_moved;
}

bool is_skinned(const MeshPart& part) { return part.is_skinned; }

std::vector<int> corners_of(const Triangles& triangles, const MeshPart& part)
{
    std::vector<int> corners;
    for (Eigen::Index f = part.first_triangle; f < part.first_triangle + part.triangles; ++f)
        for (int k = 0; k < 3; ++k)
            corners.push_back(triangles(f, k));
    return corners;
}

/// Where parts lie beside what joints move.
class Surroundings {
public:
    Surroundings(const MeshFile& avatar, const std::vector<char>& is_moved) :
        positions_(avatar.positions()), triangles_(avatar.triangles()), is_moved_(is_moved),
        moved_(positions_(rows_of_moved(), Eigen::all)), nearest_(moved_), far_(k_far_from_skin * diagonal(moved_))
    {
    }

    /// Whether a part is away from what joints move.
    bool hold(const MeshPart& part) const
    {
        const std::vector<int> corners = corners_of(triangles_, part);
        const auto moves = [&](int v) { return is_moved_[std::size_t(v)] != 0; };
        const auto is_far = [&](int v) { return nearest_.distance(positions_.row(v)) > far_; };
        return !corners.empty() && std::none_of(corners.begin(), corners.end(), moves)
            && 2 * std::count_if(corners.begin(), corners.end(), is_far) > std::ptrdiff_t(corners.size());
    }

    /// Takes back what rests on the body, and what rests on that: a head that no joint moves, its eyes and its hat.
    void take_back_resting(const std::vector<MeshPart>& parts, std::vector<char>& is_scenery) const
    {
        for (bool is_any_new = std::count(is_scenery.begin(), is_scenery.end(), 1) > 0; is_any_new;) {
            is_any_new = false;
            const std::vector<int> kept = corners_of_kept(parts, is_scenery);
            const NearestPoint nearest(positions_(kept, Eigen::all));
            const Vec3 up = guess_body_frame(positions_, triangles_about(kept)).frame.up;
            for (std::size_t i = 0; i < parts.size(); ++i)
                if (is_scenery[i] && rests_on(nearest, up, positions_(corners_of(triangles_, parts[i]), Eigen::all))) {
                    is_scenery[i] = 0;
                    is_any_new = true;
                }
        }
    }

private:
    /// Three by three those of the triangles that are not scenery.
    std::vector<int> corners_of_kept(const std::vector<MeshPart>& parts, const std::vector<char>& is_scenery) const
    {
        std::vector<int> corners;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (!is_scenery[i]) {
                const std::vector<int> more = corners_of(triangles_, parts[i]);
                corners.insert(corners.end(), more.begin(), more.end());
            }
        return corners;
    }

    static Triangles triangles_about(const std::vector<int>& corners)
    {
        return Eigen::Map<const Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>>(
            corners.data(), Eigen::Index(corners.size() / 3), 3);
    }

    /// Whether a part is no wider than what joints move, lies in the upper half of it or above, and touches what is kept.
    bool rests_on(const NearestPoint& kept, const Vec3& up, const Positions& part) const
    {
        const Vec3 sideways = (up.array() == 0).select(Vec3::Constant(far_), Vec3::Constant(INFINITY));
        const Box body = box_of(moved_);
        if (!Box(body.min() - sideways, body.max() + sideways).contains(box_of(part))
            || (part * up).minCoeff() < up.dot(body.center()))
            return false;
        for (Eigen::Index v = 0; v < part.rows(); ++v)
            if (kept.distance(part.row(v)) < far_)
                return true;
        return false;
    }

    std::vector<int> rows_of_moved() const
    {
        std::vector<int> rows;
        for (std::size_t v = 0; v < is_moved_.size(); ++v)
            if (is_moved_[v])
                rows.push_back(int(v));
        return rows;
    }

    const Positions positions_;
    const Triangles triangles_;
    const std::vector<char>& is_moved_;
    const Positions moved_;
    const NearestPoint nearest_;
    const double far_;  ///< units of the file
};

/// Panels beside a body that no joint moves: backdrops, floors and lamps.
std::vector<char> find_panels(const MeshFile& file, const std::vector<MeshPart>& parts)
{
    const Positions positions = file.positions();
    const Triangles triangles = file.triangles();
    std::vector<double> widths(parts.size(), 0);  // of flat parts
    std::vector<int> others;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::vector<int> corners = corners_of(triangles, parts[i]);
        const Positions places = positions(corners, Eigen::all);
        if (!corners.empty() && is_flat(places, k_flat))
            widths[i] = diagonal(places);
        else
            others.insert(others.end(), corners.begin(), corners.end());
    }
    std::vector<char> is_panel(parts.size(), 0);
    if (others.empty())
        return is_panel;
    const double least = k_panel_size * diagonal(positions(others, Eigen::all));
    std::transform(widths.begin(), widths.end(), is_panel.begin(), [&](double width) { return char(width > least); });
    return is_panel;
}

}  // namespace

std::vector<char> find_scenery(const MeshFile& avatar, const std::vector<MeshPart>& parts)
{
    std::vector<char> is_scenery(parts.size(), 0);
    if (std::none_of(parts.begin(), parts.end(), is_skinned))
        return find_panels(avatar, parts);
    if (std::all_of(parts.begin(), parts.end(), is_skinned))
        return is_scenery;
    try {
        const std::vector<char> is_moved = find_moved(avatar.path());
        const Surroundings surroundings(avatar, is_moved);
        std::transform(parts.begin(), parts.end(), is_scenery.begin(),
                       [&](const MeshPart& part) { return char(surroundings.hold(part)); });
        surroundings.take_back_resting(parts, is_scenery);
    } catch (const InvalidInput&) {
        // see the header
    }
    return is_scenery;
}

}  // namespace garmentfit
