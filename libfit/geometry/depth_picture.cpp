// SPDX-License-Identifier: GPL-3.0-or-later
#include "depth_picture.h"

namespace garmentfit {
namespace {

constexpr double k_most_pixels = 4096;  // unit: along a side; bounds memory where something lies far away

}  // namespace

PictureFrame::PictureFrame(const Vec3& direction, double size, const Positions& surface)
{
    axes_.col(2) = direction.normalized();
    axes_.col(0) = Vec3(axes_.col(2)).unitOrthogonal();
    axes_.col(1) = Vec3(axes_.col(0)).cross(Vec3(axes_.col(2)));
    const Eigen::MatrixX2d places = surface * axes_.leftCols<2>();
    corner_ << places.colwise().minCoeff(), 0;
    const Eigen::RowVector2d extent = places.colwise().maxCoeff() - corner_.head<2>();
    size_ = std::max(size, extent.maxCoeff() / k_most_pixels);
    width_ = 1 + int(extent.x() / size_);
    height_ = 1 + int(extent.y() / size_);
}

Positions PictureFrame::project(const Positions& points) const
{
    Positions projected = (points * axes_).rowwise() - corner_;
    projected.leftCols<2>() /= size_;
    return projected;
}

}  // namespace garmentfit
