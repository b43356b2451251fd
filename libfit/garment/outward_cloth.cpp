// SPDX-License-Identifier: GPL-3.0-or-later
#include "outward_cloth.h"

#include <utility>

#include "garment_wrap.h"
#include "garmentfit/closed_ends.h"
#include "kept_results.h"
#include "plain_reading.h"
#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {

namespace {

TriangleMesh read_outward_cloth(const GarmentMesh& garment)
{
    OpenedGarment opened = open_ends(garment);
    if (opened.outside.triangles.rows() > 0)
        return std::move(opened.outside);
    PlainReading plain = read_plainly(std::move(opened.garment));
    if (plain.serves)
        return std::move(plain.outer);
    std::optional<WrapSheets> sheets = sheets_of(wrap_parts(plain));
    if (!sheets)
        return std::move(plain.outer);
    const bool reads_inner = sheets->inner_goes_round() && !sheets->inner_is_ragged();
    return reads_inner ? std::move(sheets->inner) : std::move(sheets->outer);
}

}  // namespace

TriangleMesh outward_cloth(const GarmentMesh& garment)
{
    constexpr Eigen::Index k_large = 20000;  // unit: vertices; what has fewer is read in tenths of a second
    if (garment.positions.rows() < k_large)
        return read_outward_cloth(garment);
    static KeptResults<TriangleMesh> kept;
    return kept.of(garment, [&] { return read_outward_cloth(garment); });
}

std::optional<Lining> lining_of(const GarmentMesh& garment, Lined lined)
{
    OpenedGarment opened = open_ends(garment);
    if (opened.outside.triangles.rows() > 0)
        return Lining { { std::move(opened.outside.positions), std::move(opened.outside.triangles) }, 0 };
    const PlainReading plain = read_plainly(std::move(opened.garment));
    if (plain.serves && lined == Lined::clothes_in_parts)
        return {};
    std::optional<WrapSheets> sheets = sheets_of(wrap_parts(plain));
    if (!sheets || !sheets->inner_goes_round())
        return {};
    return Lining { { std::move(sheets->inner.positions), std::move(sheets->inner.triangles) },
                    garment_tuning::k_garment_wrap_offset * diagonal(plain.cloth.positions) };
}

TriangleMesh rotate(TriangleMesh cloth, const Eigen::Quaterniond& turn)
{
    cloth.positions = (cloth.positions * turn.toRotationMatrix().transpose()).eval();
    return cloth;
}

}  // namespace garmentfit
