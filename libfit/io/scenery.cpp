// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenery.h"

#include <algorithm>

#include "garmentfit/error.h"
#include "gltf_skin.h"
#include "gltf_unpack.h"
#include "nearest.h"
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

/// How far parts are from what joints move.
class Surroundings {
public:
    Surroundings(const MeshFile& avatar, const std::vector<char>& is_moved) :
        positions_(avatar.positions()), triangles_(avatar.triangles()), is_moved_(is_moved),
        moved_(positions_(rows_of_moved(), Eigen::all)), nearest_(moved_), far_(k_far_from_skin * diagonal(moved_))
    {
    }

    bool hold(const MeshPart& part) const
    {
        const std::vector<int> corners = corners_of(triangles_, part);
        const auto moves = [&](int v) { return is_moved_[std::size_t(v)] != 0; };
        const auto is_far = [&](int v) { return nearest_.distance(positions_.row(v)) > far_; };
        return !corners.empty() && std::none_of(corners.begin(), corners.end(), moves)
            && 2 * std::count_if(corners.begin(), corners.end(), is_far) > std::ptrdiff_t(corners.size());
    }

private:
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
    } catch (const InvalidInput&) {
        // see the header
    }
    return is_scenery;
}

}  // namespace garmentfit
