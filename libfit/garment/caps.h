// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Caps: flat discs of a garment's own surface that close its ends.

#include <vector>

#include "garmentfit/mesh.h"
#include "topology.h"
#include "weld.h"

namespace garmentfit {

/// Finds caps in a garment whose seams of UV charts are closed: they are no borders.
class Caps {
public:
    explicit Caps(const GarmentMesh& garment);

    /// The faces of each cap.
    std::vector<std::vector<int>> find();

    bool is_closed() const { return topology_.border_edges().empty(); }

    const MeshTopology& topology() const { return topology_; }
    TriangleMesh mesh() const { return { positions_, faces_ }; }
    const std::vector<std::vector<int>>& patches() const { return patches_; }

private:
    Caps(const GarmentMesh& garment, const Weld& weld);

    /// Faces that are joined by flat edges, and the edges around them.
    struct Region {
        std::vector<int> faces = {};
        Vec3 area = Vec3::Zero();  // m^2, sum of area vectors: of a flat region its area times its normal
        double girth = 0;  // m, of its outline
        double steep = 0;  // m, of the outline where the next face is steep
        double open = 0;  // m, of the outline where there is no next face
        double side = 0;  // m, of the outline, signed by the side on which the next face is
        std::vector<int> next_to = {};  // regions
        bool is_taken = false;  // in part, by a fan
    };

    /// Holes that were filled with a fan around a vertex. No garment has such a vertex elsewhere, so the cloth around
    /// may be as flat as at a neck.
    std::vector<std::vector<int>> find_fans();

    /// A fan that is sunk into the tube which it closes: cloth that goes in is a fold, and has cloth on both sides.
    bool is_funnel(const Region& fan, int apex) const;

    /// Holes that were filled with triangles from rim to rim: discs of long edges in which no vertex lies. Large flat
    /// parts of open cloth may look the same, but are neither as round nor of as many triangles.
    std::vector<std::vector<int>> find_filled(const std::vector<std::vector<int>>& caps);

    /// Median of the sides of its patch, by face: a button may have most of a garment's faces.
    /// @param lengths  m, of all sides
    std::vector<double> usual_lengths(const std::vector<double>& lengths) const;

    double length_of(int side) const;

    /// The angle opposite to the side is obtuse, as in a polygon every triangle's is that does not hold the middle.
    bool is_ear(int side) const;

    bool is_filled(const Region& region) const;

    /// Some faces as one region with its outline.
    Region region_with(const std::vector<int>& faces);

    std::vector<std::vector<int>> find_steep() const;

    void collect_areas();

    /// The faces of a garment without open edges, and of a patch that is most of the cloth and has no openings but
    /// buttonholes: buttons, belt loops and labels beside it may be open.
    void mark_closed_faces();

    double cosine(int f, int g) const { return areas_[f].stableNormalized().dot(areas_[g].stableNormalized()); }

    /// 1 if both faces run along their common edge in opposite directions, as oriented faces do; -1 if not.
    double orientation(int side, int other) const;

    void collect_regions();

    void add_areas(Region& region) const;

    void add_to_outline(int side, Region& region) const;

    /// All cloth around on one side of it.
    bool is_flat_disc(const Region& region, double depth) const;

    bool is_hole(const Region& region, double depth) const;

    /// Its area as a share of a disc of the same girth. @pre its girth is above 0
    static double roundness_of(const Region& region);

    /// Euler characteristic 1: one outline, no handle.
    bool is_disc(const Region& region) const;

    bool is_flat(const Region& region, double depth) const;

    Positions positions_;
    Triangles faces_;
    MeshTopology topology_;
    std::vector<std::vector<int>> patches_;
    double smallest_girth_;  // m
    std::vector<Vec3> areas_;
    std::vector<char> is_closed_;  // by face
    std::vector<Region> regions_;
    std::vector<int> region_of_;
};

}  // namespace garmentfit
