// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Small files of each format, with as many of its oddities as fit: read by the tests of files and mangled by the fuzz
// test.

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace garmentfit::samples {

template <class Number>
std::string raw(Number value, bool big_endian = false)
{
    const auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : std::string(bytes.begin(), bytes.end());
}

/// A roof: a quad and a triangle, counted from both ends, with all that OBJ may carry.
inline std::string obj()
{
    return "# roof, by hand\r\nmtllib roof.mtl\no Roof\nv 0 0 0\nv  1.0  0.0 0 1.0 0.5 0.25\nv 1 1 1e-1\nv 0 +1 .1\n"
           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 -0.1 1\nvn 0 0 1.000\n\ng front\nusemtl slate\ns 1\n"
           "f 1/1/1 2/2/1 3/3/1 \\\n  4/4/1\nv 0.5 2 0.3\ng back\ns off\nf -3//2 -1//2 -2//2 # gable\nl 1 2\n# end";
}

/// The header is told in full; vertices carry a list and bytes before x, faces an extra number.
inline std::string ascii_ply()
{
    return "ply\nformat ascii 1.0\ncomment by hand\nobj_info old\nelement material 1\nproperty list uchar int ids\n"
           "property float shine\nelement vertex 4\nproperty uchar red\nproperty double x\nproperty double y\n"
           "property list uchar short tags\nproperty float z\nelement face 1\nproperty list uchar int vertex_index\n"
           "property int flag\nend_header\n2 5 6 0.50\n255 0 0.10 0 1e-3\n9 1 0.1 2 3 4 0\n7 1.0 1 0 0.25\n8 0 1 1 -5 "
           "0\n"
           "4 0 1 2 3 42\n";
}

/// The same kinds of things in binary, with normals.
inline std::string binary_ply(bool big_endian)
{
    std::string ply = std::string("ply\nformat binary_") + (big_endian ? "big" : "little")
        + "_endian 1.0\ncomment scanned\nelement vertex 4\nproperty float32 x\nproperty float32 y\nproperty double z\n"
          "property float nx\nproperty float ny\nproperty float nz\nproperty list uint8 int16 tags\nelement edge 1\n"
          "property int vertex1\nproperty int vertex2\nelement face 2\nproperty list uchar float texcoord\n"
          "property list uchar uint vertex_indices\nend_header\n";
    const float corners[4][3] = { { 0, 0, 0.1f }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    for (const auto& corner : corners) {
        ply += raw(corner[0], big_endian) + raw(corner[1], big_endian) + raw(double(corner[2]), big_endian);
        ply += raw(0.0f, big_endian) + raw(0.0f, big_endian) + raw(1.0f, big_endian);
        ply += raw<std::uint8_t>(1) + raw<std::int16_t>(-7, big_endian);
    }
    ply += raw<std::int32_t>(0, big_endian) + raw<std::int32_t>(1, big_endian);
    for (const std::uint32_t middle : { 1u, 2u }) {
        ply += raw<std::uint8_t>(1) + raw(0.5f, big_endian) + raw<std::uint8_t>(3) + raw(0u, big_endian);
        ply += raw(middle, big_endian) + raw(middle + 1, big_endian);
    }
    return ply;
}

inline std::string off()
{
    return "OFF # a square\n\n# counts\n4 2 0\n0 0 0\n1 0 0  # corner\n1 1 .5\n0 1 0 255 0 0\n3 0 1 2\n3 0 2 3 0.5 0.5 "
           "0.5\n";
}

inline std::string off_with_normals()
{
    return "CNOFF\n4 1 4\n0 0 0 0 0 1 255 255 0 255\n1 0 0 0 0 1 0 0 0 255\n1 1 0 0 0 1 9 9 9 255\n0 1 0 0 0 1 8 8 8 "
           "255\n4 0 1 2 3\n";
}

inline std::string ascii_stl()
{
    return "solid square of two\n  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1.0e0 0 0\n    "
           "  vertex 1 1 0\n"
           "    endloop\n  endfacet\n  FACET NORMAL 0 0 1\n    outer loop\n      vertex 0.0 -0 0\n      vertex 1 1 0\n "
           "     vertex 0 1 0\n"
           "    endloop\n  endfacet\nendsolid square of two\n";
}

/// Its header begins with "solid", as many do.
inline std::string binary_stl()
{
    std::string stl = "solid by a scanner";
    stl.resize(80, ' ');
    stl += raw<std::uint32_t>(2);
    for (const auto& corners :
         std::vector<std::vector<float>> { { 0, 0, 0, 1, 0, 0, 1, 1, 0 }, { 0, 0, 0, 1, 1, 0, 0, 1, 0 } }) {
        stl += raw(0.0f) + raw(0.0f) + raw(1.0f);
        for (const float x : corners)
            stl += raw(x);
        stl += raw<std::uint16_t>(31);
    }
    return stl;
}

/// A square: positions and normals interleaved, then two primitives' worth of indices.
inline std::string gltf_buffer()
{
    std::string buffer;
    for (const auto& corner : std::vector<std::vector<float>> { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } })
        buffer += raw(corner[0]) + raw(corner[1]) + raw(corner[2]) + raw(0.0f) + raw(0.0f) + raw(1.0f);
    for (const std::uint16_t index : { 0, 1, 2, 0, 2, 3 })
        buffer += raw(index);
    return buffer;
}

/// A node of scale 2, one to the right of its parent; two primitives share their vertices. `buffer` is the member(s)
/// that say where the 108 bytes are.
inline std::string gltf_json(const std::string& buffer)
{
    return "{\"asset\":{\"version\":\"2.0\",\"generator\":\"by hand\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
           "\"nodes\":[{\"translation\":[1,0,0],\"children\":[1]},{\"mesh\":0,\"scale\":[2,2,2],\"extras\":{\"kept\":["
           "1,2.5,\"\"]}}],"
           "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":2,\"material\":0},"
           "{\"attributes\":{\"POSITION\":0,\"NORMAL\":1},\"indices\":3}]}],\"materials\":[{\"name\":\"linen\"}],"
           "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"min\":[0,0,0],"
           "\"max\":[1,1,0]},"
           "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
           "{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"},"
           "{\"bufferView\":1,\"byteOffset\":6,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"
           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":96,\"byteStride\":24},{\"buffer\":0,\"byteOffset\":96,"
           "\"byteLength\":12}],"
           "\"buffers\":[{"
        + buffer + "\"byteLength\":108}]}";
}

inline std::string glb(std::string json = gltf_json(""), std::string buffer = gltf_buffer())
{
    json.resize((json.size() + 3) / 4 * 4, ' ');
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    return "glTF" + raw<std::uint32_t>(2) + raw(std::uint32_t(12 + 8 + json.size() + 8 + buffer.size()))
        + raw(std::uint32_t(json.size())) + "JSON" + json + raw(std::uint32_t(buffer.size())) + std::string("BIN\0", 4)
        + buffer;
}

struct File {
    std::string name, bytes;
};

/// One of each, whole in itself.
inline std::vector<File> all()
{
    return { { "a.obj", obj() },
             { "text.ply", ascii_ply() },
             { "little.ply", binary_ply(false) },
             { "big.ply", binary_ply(true) },
             { "a.off", off() },
             { "n.off", off_with_normals() },
             { "text.stl", ascii_stl() },
             { "binary.stl", binary_stl() },
             { "a.glb", glb() } };
}

}  // namespace garmentfit::samples
