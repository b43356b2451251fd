// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_content.h"

namespace garmentfit {

Eigen::Index first_not_finite(const MeshFile::Content& content)
{
    const bool has_faces = content.triangles.rows() > 0;
    const Eigen::Index count = has_faces ? content.triangles.size() : content.positions.rows();
    for (Eigen::Index i = 0; i < count; ++i)
        if (const Eigen::Index v = has_faces ? content.triangles.data()[i] : i; !content.positions.row(v).allFinite())
            return v;
    return -1;
}

void FanBuilder::add(const std::vector<int>& corners)
{
    const std::size_t count = corners.size() / columns_;
    for (std::size_t k = 1; k + 1 < count; ++k)
        for (const std::size_t corner : { std::size_t(0), k, k + 1 })
            for (int column = 0; column < columns_; ++column)
                fans_[column].push_back(corners[corner * columns_ + column]);
}

Triangles FanBuilder::triangles(int column) const
{
    return Eigen::Map<const Triangles>(fans_[column].data(), static_cast<Eigen::Index>(fans_[column].size() / 3), 3);
}

}  // namespace garmentfit
