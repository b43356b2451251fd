// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Several meshes as one, for what treats them alike, and one as several again.

#include <vector>

#include "fit/drape_garment.h"

namespace fit {

/// Appends `more` to `mesh`, its triangles renumbered.
void append(TriangleMesh& mesh, const TriangleMesh& more);

/// Appends the rows of `more`.
void append(SkinWeights& weights, const SkinWeights& more);

/// Puts the rows of `positions`, garment after garment, back into the garments.
void put_positions(std::vector<WornGarment>& garments, const Positions& positions);

/// Adds how far each garment sank from where it would be, its vertices garment after garment, had it gone along with the body.
void add_slips(std::vector<WornGarment>& garments, const Positions& along);

/// The skin weights of the nearest body vertex for each point (n x 3, same pose as the body). O((n + m) log m).
SkinWeights weights_of_nearest(const Positions& points, const Positions& body, const SkinWeights& weights);

/// The four largest of each row of a dense table of weights, n x bone_count, made to sum to 1.
SkinWeights strongest_four(Eigen::MatrixXd dense);

}  // namespace fit
