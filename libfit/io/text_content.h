// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesh_content.h"
#include "words.h"

namespace garmentfit {

/// A mesh in a text file. Each vertex and normal is three numbers in a row; all other text is kept verbatim.
struct TextContent : MeshFile::Content {
    struct Place {
        Span span;
        Eigen::Index row;  ///< of positions or normals
        bool is_normal;
    };

    FileBytes file;
    std::vector<Place> places;  ///< in the order of the text
    Positions normals;
    Triangles normal_corners;  ///< rows of normals for each corner of the triangles, -1 = none

    std::string bytes_with(const Positions& moved) const override;
    double against_faces() const override;

    /// After the faces. @throws InvalidInput: a vertex of a face is not finite
    void require_finite() const;
};

/// Rows of three that grow while a file is read.
class RowBuilder {
public:
    void add(const Vec3& row) { values_.insert(values_.end(), row.begin(), row.end()); }
    Eigen::Index rows() const { return static_cast<Eigen::Index>(values_.size() / 3); }
    Positions matrix() const { return Eigen::Map<const Positions>(values_.data(), rows(), 3); }

private:
    std::vector<double> values_;
};

}  // namespace garmentfit
