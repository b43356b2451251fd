// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The glTF of mesh_file_samples.h, packed in several ways.

#include <array>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include "data_uri.h"
#include "gltf_unpack.h"
#include "mesh_file_samples.h"

namespace garmentfit::samples {

struct PackedGltf {
    static constexpr std::size_t k_vertices = 4, k_stride = 24, k_indices = 6;

    nlohmann::ordered_json json = nlohmann::ordered_json::parse(gltf_json(""));
    const std::string plain = gltf_buffer();
    std::array<std::string, 2> meshopt_bytes;  ///< of each view, once it is packed

    PackedGltf() { json["buffers"] = nlohmann::ordered_json::array(); }

    int add_buffer(const std::string& bytes)
    {
        json["buffers"].push_back(
            { { "byteLength", bytes.size() }, { "uri", data_uri("application/octet-stream", bytes) } });
        return int(json["buffers"].size()) - 1;
    }

    int add_view(const std::string& bytes)
    {
        json["bufferViews"].push_back({ { "buffer", add_buffer(bytes) }, { "byteLength", bytes.size() } });
        return int(json["bufferViews"].size()) - 1;
    }

    void require(const char* extension)
    {
        json["extensionsUsed"].push_back(extension);
        json["extensionsRequired"].push_back(extension);
    }

    void pack_with_meshopt()
    {
        require("EXT_meshopt_compression");
        std::string vertices(meshopt_encodeVertexBufferBound(k_vertices, k_stride), '\0');
        vertices.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(vertices.data()), vertices.size(),
                                                   plain.data(), k_vertices, k_stride));
        std::vector<unsigned> numbers(k_indices);
        for (std::size_t i = 0; i < k_indices; ++i) {
            std::uint16_t number;
            std::memcpy(&number, plain.data() + k_vertices * k_stride + i * sizeof number, sizeof number);
            numbers[i] = number;
        }
        std::string indices(meshopt_encodeIndexSequenceBound(k_indices, k_vertices), '\0');
        indices.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(indices.data()), indices.size(),
                                                   numbers.data(), numbers.size()));
        json["buffers"].push_back({ { "byteLength", plain.size() },
                                    { "extensions", { { "EXT_meshopt_compression", { { "fallback", true } } } } } });
        meshopt_bytes = { vertices, indices };
        compress(0, vertices, "ATTRIBUTES", k_stride, k_vertices);
        compress(1, indices, "INDICES", 2, k_indices);
    }

    void compress(std::size_t view, const std::string& bytes, const char* mode, std::size_t stride, std::size_t count)
    {
        json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = { { "buffer", add_buffer(bytes) },
                                                                               { "byteLength", bytes.size() },
                                                                               { "byteStride", stride },
                                                                               { "mode", mode },
                                                                               { "count", count } };
    }

    /// A square of two triangles.
    static std::string draco_square()
    {
        draco::TriangleSoupMeshBuilder builder;
        builder.Start(2);
        const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
        const std::array<std::array<float, 3>, 4> p { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } } };
        builder.SetAttributeValuesForFace(positions, draco::FaceIndex(0), p[0].data(), p[1].data(), p[2].data());
        builder.SetAttributeValuesForFace(positions, draco::FaceIndex(1), p[0].data(), p[2].data(), p[3].data());
        const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
        draco::Encoder encoder;
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
        draco::EncoderBuffer buffer;
        if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok())
            throw std::runtime_error("the sample cannot be packed");
        return { buffer.data(), buffer.size() };
    }

    void pack_with_draco(const std::string& bytes)
    {
        require("KHR_draco_mesh_compression");
        json["bufferViews"] = nlohmann::ordered_json::array();
        json["accessors"] = { { { "componentType", 5126 }, { "count", 4 }, { "type", "VEC3" } },
                              { { "componentType", 5123 }, { "count", 6 }, { "type", "SCALAR" } } };
        json["meshes"][0]["primitives"] = nlohmann::ordered_json::array(
            { { { "attributes", { { "POSITION", 0 } } },
                { "indices", 1 },
                { "extensions",
                  { { "KHR_draco_mesh_compression",
                      { { "bufferView", add_view(bytes) }, { "attributes", { { "POSITION", 0 } } } } } } } } });
    }
};

}  // namespace garmentfit::samples
