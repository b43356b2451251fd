// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a mesh file from anywhere with all readers that may see it: what comes out holds together, or the file is
// refused in one line.

#include "fuzz_target.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "garmentfit/worn_clothes.h"

namespace garmentfit::fuzz {

inline void require_surface(const MeshFile& mesh)
{
    require(mesh.positions().allFinite(), "that positions are finite");
    require(mesh.triangles().minCoeff() >= 0, "that no corner is negative");
    require(mesh.triangles().maxCoeff() < mesh.positions().rows(), "that corners are vertices");
}

inline void require_look(const MeshFile& mesh)
{
    const Appearance look = mesh.appearance();
    require(look.uvs.allFinite(), "that UVs are finite");
    if (look.uv_corners.rows() > 0) {
        require(look.uv_corners.rows() == mesh.triangles().rows(), "that each face has UVs");
        require(look.uv_corners.maxCoeff() < look.uvs.rows(), "that corners have UVs");
    }
    for (const int material : look.material_of)
        require(material < int(look.materials.size()), "that faces have materials");
}

/// UVs say how the warp runs, or nothing.
inline void require_warps(const MeshFile& mesh)
{
    const CornerUvs uvs = mesh.corner_uvs();
    require(uvs.rows() == 0 || uvs.rows() == mesh.triangles().rows(), "that all corners have UVs, or none");
    try {
        const GarmentMesh garment = make_garment(mesh.positions(), mesh.triangles(), uvs);
        require(garment.warps.allFinite(), "that warps are finite");
        require(garment.warps.rows() == 0 || garment.warps.rows() == garment.triangles.rows(),
                "that all triangles have a warp, or none");
    } catch (const InvalidInput& error) {
        require_one_line(error.what());
    }
}

/// What is written can be read again.
inline void require_round_trip(const MeshFile& mesh, const std::filesystem::path& copy)
{
    std::filesystem::remove(copy);
    mesh.write(copy, mesh.positions());
    require(MeshFile::read(copy).triangles() == mesh.triangles(), "that a written file has the same faces");
}

inline void read_skin(const MeshFile& mesh)
{
    is_vrm(mesh.path());
    if (!has_skeleton(mesh.path()))
        return;
    if (has_skin(mesh.path()))
        require(read_joint_weights(mesh.path()).rows() == mesh.positions().rows(), "that each vertex has weights");
    const ForeignRig rig = read_skinned_gltf(mesh.path());
    require(rig.weights.weights.rows() == mesh.positions().rows(), "that each vertex has weights of bones");
    require(rig.weights.weights.allFinite(), "that weights are finite");
}

/// @param copy  a place for what is written, of the same format
inline void read_all(const std::filesystem::path& path, const std::filesystem::path& copy)
{
    try {
        const MeshFile mesh = MeshFile::read(path);
        require_surface(mesh);
        require_look(mesh);
        require_warps(mesh);
        mesh.companions();
        find_body(mesh, Wears::strip);
        require_round_trip(mesh, copy);
        if (mesh.format() == "glb" || mesh.format() == "gltf")
            read_skin(mesh);
    } catch (const InvalidInput& error) {
        require_one_line(error.what());
    }
}

}  // namespace garmentfit::fuzz
