// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_unpack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include "data_uri.h"
#include "garmentfit/error.h"
#include "gltf_model.h"
#include "scene_file.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

constexpr const char* k_meshopt = "EXT_meshopt_compression";
constexpr const char* k_draco = "KHR_draco_mesh_compression";
constexpr const char* k_quantization = "KHR_mesh_quantization";
constexpr std::size_t k_most_bytes = std::size_t(1) << 31;  // unit: a guard against mangled counts, not a wish

bool names(const ordered_json& json, const char* list, const char* extension)
{
    const ordered_json& found = json.value(list, ordered_json::array());
    return std::find(found.begin(), found.end(), extension) != found.end();
}

bool is_packed(const ordered_json& json)
{
    for (const char* list : { "extensionsUsed", "extensionsRequired" })
        for (const char* extension : { k_meshopt, k_draco, k_quantization })
            if (names(json, list, extension))
                return true;
    const ordered_json accessors = json.value("accessors", ordered_json::array());
    return std::any_of(accessors.begin(), accessors.end(),
                       [](const ordered_json& accessor) { return accessor.contains("sparse"); });
}

constexpr std::array<const char*, 2> k_of_vertices { "POSITION", "NORMAL" };

/// Accessors of the vertices that a node shows; none of a node that is mangled, which is found later.
std::set<std::size_t> shown_by(const ordered_json& json, const ordered_json& node)
{
    std::set<std::size_t> shown;
    if (!node.contains("mesh") || !json.contains("meshes") || node["mesh"].get<std::size_t>() >= json["meshes"].size())
        return shown;
    for (const ordered_json& primitive : json["meshes"][node["mesh"].get<std::size_t>()].at("primitives"))
        for (const char* name : k_of_vertices)
            if (primitive.contains("attributes") && primitive["attributes"].contains(name))
                shown.insert(primitive["attributes"][name].get<std::size_t>());
    return shown;
}

/// Nodes that show vertices which one before them shows, too.
std::vector<std::size_t> instances_in(const ordered_json& json)
{
    std::set<std::size_t> shown;
    std::vector<std::size_t> instances;
    const ordered_json nodes = json.value("nodes", ordered_json::array());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::set<std::size_t> own = shown_by(json, nodes[i]);
        if (std::any_of(own.begin(), own.end(), [&](std::size_t accessor) { return shown.contains(accessor); }))
            instances.push_back(i);
        shown.insert(own.begin(), own.end());
    }
    return instances;
}

class Unpacker {
public:
    Unpacker(const FileBytes& file, GltfContainer container, const std::filesystem::path& folder) :
        file_(file), container_(std::move(container)), json_(container_.json)
    {
        load_buffers(folder);
    }

    GltfContainer run()
    {
        if (json_.contains("bufferViews"))
            for (ordered_json& view : json_["bufferViews"])
                decode_view(view);
        decode_draco();
        if (json_.contains("accessors"))
            for (ordered_json& accessor : json_["accessors"])
                make_dense(accessor);
        make_floats();
        separate_instances();
        for (const char* list : { "extensionsUsed", "extensionsRequired" })
            forget_extensions(list);
        return in_one_buffer();
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        file_.fail(what + "; it is truncated or mangled, export or copy it again");
    }

    // tinygltf reads the buffers: in the file, beside it, or as data URIs. Those of meshopt that stand for what is
    // decoded have no bytes.
    void load_buffers(const std::filesystem::path& folder)
    {
        GltfContainer only = container_;
        only.json
            = { { "asset", { { "version", "2.0" } } }, { "buffers", json_.value("buffers", ordered_json::array()) } };
        for (std::size_t i = 0; i < only.json["buffers"].size(); ++i)
            if (ordered_json& buffer = only.json["buffers"][i];
                !buffer.contains("uri") && (i > 0 || !container_.own_buffer()))
                buffer = { { "byteLength", 1 }, { "uri", data_uri("application/octet-stream", std::string(1, '\0')) } };
        const tinygltf::Model model = load_model(file_, only, folder);
        for (const tinygltf::Buffer& buffer : model.buffers)
            buffers_.emplace_back(buffer.data.begin(), buffer.data.end());
    }

    std::string_view bytes_at(std::size_t buffer, std::size_t offset, std::size_t size) const
    {
        if (buffer >= buffers_.size() || offset > buffers_[buffer].size() || size > buffers_[buffer].size() - offset)
            fail("packed data reach beyond buffer " + std::to_string(buffer));
        return std::string_view(buffers_[buffer]).substr(offset, size);
    }

    std::string_view bytes_of_view(std::size_t index) const
    {
        const ordered_json& view = json_.at("bufferViews").at(index);
        return bytes_at(view.at("buffer"), view.value("byteOffset", std::size_t(0)), view.at("byteLength"));
    }

    void require_size(std::size_t count, std::size_t stride) const
    {
        if (count > 0 && stride > k_most_bytes / count)
            fail("it would have more than 2 GB once unpacked");
    }

    /// @return the index of a new view of these bytes
    std::size_t add_view(std::string bytes, std::size_t stride = 0)
    {
        json_["bufferViews"].push_back({ { "buffer", buffers_.size() }, { "byteLength", bytes.size() } });
        if (stride > 0)
            json_["bufferViews"].back()["byteStride"] = stride;
        buffers_.push_back(std::move(bytes));
        return json_["bufferViews"].size() - 1;
    }

    // ---- EXT_meshopt_compression

    void decode_view(ordered_json& view)
    {
        if (!view.contains("extensions") || !view["extensions"].contains(k_meshopt))
            return;
        const ordered_json packed = view["extensions"][k_meshopt];
        const std::size_t count = packed.at("count"), stride = packed.at("byteStride");
        require_size(count, stride);
        const std::string_view source
            = bytes_at(packed.at("buffer"), packed.value("byteOffset", std::size_t(0)), packed.at("byteLength"));
        std::string bytes(count * stride, '\0');
        decode(packed.at("mode"), bytes, count, stride, source);
        filter(packed.value("filter", "NONE"), bytes, count, stride);
        view.erase("extensions");
        view.erase("byteOffset");
        view["buffer"] = buffers_.size();
        view["byteLength"] = bytes.size();
        buffers_.push_back(std::move(bytes));
    }

    void decode(const std::string& mode, std::string& bytes, std::size_t count, std::size_t stride,
                std::string_view source) const
    {
        const auto* from = reinterpret_cast<const unsigned char*>(source.data());
        const bool is_index = stride == 2 || stride == 4;
        int error = 1;
        if (mode == "ATTRIBUTES" && stride > 0 && stride % 4 == 0 && stride <= 256)
            error = meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, source.size());
        else if (mode == "TRIANGLES" && is_index && count % 3 == 0)
            error = meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, source.size());
        else if (mode == "INDICES" && is_index)
            error = meshopt_decodeIndexSequence(bytes.data(), count, stride, from, source.size());
        if (error != 0)
            fail(std::string("its data of ") + k_meshopt + " cannot be decoded");
    }

    void filter(const std::string& filter, std::string& bytes, std::size_t count, std::size_t stride) const
    {
        if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
            meshopt_decodeFilterOct(bytes.data(), count, stride);
        else if (filter == "QUATERNION" && stride == 8)
            meshopt_decodeFilterQuat(bytes.data(), count, stride);
        else if (filter == "EXPONENTIAL" && stride % 4 == 0)
            meshopt_decodeFilterExp(bytes.data(), count, stride);
        else if (filter != "NONE")
            fail(std::string("its data of ") + k_meshopt + " have a filter that does not fit them");
    }

    // ---- KHR_draco_mesh_compression

    void decode_draco()
    {
        if (!json_.contains("meshes"))
            return;
        for (ordered_json& mesh : json_["meshes"])
            for (ordered_json& primitive : mesh.at("primitives"))
                if (primitive.contains("extensions") && primitive["extensions"].contains(k_draco)) {
                    decode_draco(primitive, primitive["extensions"][k_draco]);
                    primitive["extensions"].erase(k_draco);
                    if (primitive["extensions"].empty())
                        primitive.erase("extensions");
                }
    }

    void decode_draco(ordered_json& primitive, const ordered_json& packed)
    {
        const std::string_view source = bytes_of_view(packed.at("bufferView"));
        draco::DecoderBuffer buffer;
        buffer.Init(source.data(), source.size());
        auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok())
            fail(std::string("its data of ") + k_draco + " cannot be decoded");
        const draco::Mesh& mesh = *decoded.value();
        if (primitive.contains("indices"))
            write_indices(json_.at("accessors").at(primitive["indices"].get<std::size_t>()), mesh);
        for (const auto& [name, id] : packed.at("attributes").items()) {
            const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id.get<std::uint32_t>());
            if (!attribute || !primitive.at("attributes").contains(name))
                fail(std::string(k_draco) + " has no attribute " + first_line(name));
            write_attribute(json_.at("accessors").at(primitive["attributes"][name].get<std::size_t>()), mesh,
                            *attribute);
        }
    }

    void write_indices(ordered_json& accessor, const draco::Mesh& mesh)
    {
        std::string bytes;
        for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
            for (const draco::PointIndex& point : mesh.face(f)) {
                const std::uint32_t index = point.value();
                bytes.append(reinterpret_cast<const char*>(&index), sizeof index);
            }
        accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        accessor["count"] = 3 * std::size_t(mesh.num_faces());
        place(accessor, std::move(bytes));
    }

    void write_attribute(ordered_json& accessor, const draco::Mesh& mesh, const draco::PointAttribute& attribute)
    {
        accessor["count"] = mesh.num_points();
        switch (accessor.at("componentType").get<int>()) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: return write_values<std::int8_t>(accessor, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return write_values<std::uint8_t>(accessor, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_SHORT: return write_values<std::int16_t>(accessor, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return write_values<std::uint16_t>(accessor, mesh, attribute);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return write_values<std::uint32_t>(accessor, mesh, attribute);
        default: return write_values<float>(accessor, mesh, attribute);
        }
    }

    template <class Number>
    void write_values(ordered_json& accessor, const draco::Mesh& mesh, const draco::PointAttribute& attribute)
    {
        constexpr std::size_t k_most_components = 4;
        const std::size_t components = components_of(accessor);
        std::array<Number, k_most_components> value {};
        if (components > k_most_components)
            fail(std::string(k_draco) + " has a matrix as an attribute");
        std::string bytes;
        for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
            if (!attribute.ConvertValue<Number>(attribute.mapped_index(point), std::int8_t(components), value.data()))
                fail(std::string("a value of ") + k_draco + " does not fit its type");
            bytes.append(reinterpret_cast<const char*>(value.data()), components * sizeof(Number));
        }
        if (std::is_same_v<Number, float> && (accessor.contains("min") || accessor.contains("max")))
            write_bounds(accessor, bytes, components);  // those of the file are from before values were rounded
        place(accessor, std::move(bytes));
    }

    // ---- accessors

    std::size_t components_of(const ordered_json& accessor) const
    {
        const std::string type = accessor.at("type");
        constexpr std::array<std::pair<std::string_view, std::size_t>, 7> types { { { "SCALAR", 1 },
                                                                                    { "VEC2", 2 },
                                                                                    { "VEC3", 3 },
                                                                                    { "VEC4", 4 },
                                                                                    { "MAT2", 4 },
                                                                                    { "MAT3", 9 },
                                                                                    { "MAT4", 16 } } };
        for (const auto& [name, components] : types)
            if (type == name)
                return components;
        fail("an accessor has the type " + first_line(type));
    }

    std::size_t component_size(const ordered_json& accessor) const
    {
        const int size = tinygltf::GetComponentSizeInBytes(accessor.at("componentType").get<std::uint32_t>());
        if (size <= 0 || size > 4)
            fail("an accessor has an unknown component type");
        return std::size_t(size);
    }

    void place(ordered_json& accessor, std::string bytes)
    {
        accessor["bufferView"] = add_view(std::move(bytes));
        accessor.erase("byteOffset");
    }

    /// The elements without gaps between them; zeros where the accessor has no bytes.
    std::string dense_bytes(const ordered_json& accessor) const
    {
        const std::size_t count = accessor.at("count"), size = components_of(accessor) * component_size(accessor);
        require_size(count, size);
        std::string bytes(count * size, '\0');
        if (!accessor.contains("bufferView"))
            return bytes;
        const std::size_t index = accessor["bufferView"];
        const std::string_view source = bytes_of_view(index);
        const std::size_t stride = json_["bufferViews"][index].value("byteStride", size),
                          first = accessor.value("byteOffset", std::size_t(0));
        if (count > 0
            && (first > source.size() || size > source.size() - first
                || (count > 1 && stride > (source.size() - first - size) / (count - 1))))
            fail("an accessor reaches beyond its bufferView");
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(bytes.data() + i * size, source.data() + first + i * stride, size);
        return bytes;
    }

    void make_dense(ordered_json& accessor)
    {
        if (!accessor.contains("sparse"))
            return;
        const ordered_json sparse = accessor["sparse"];
        const std::size_t size = components_of(accessor) * component_size(accessor), count = sparse.at("count");
        std::string bytes = dense_bytes(accessor);
        const auto part = [&](const char* name, const ordered_json& type, int component_type) {
            ordered_json made = sparse.at(name);
            made["count"] = count;
            made["type"] = type;
            made["componentType"] = component_type;
            return dense_bytes(made);
        };
        const int index_type = sparse.at("indices").at("componentType");
        const std::string indices = part("indices", "SCALAR", index_type),
                          values = part("values", accessor["type"], accessor["componentType"]);
        const std::size_t index_size = indices.size() / std::max<std::size_t>(count, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const auto row = std::size_t(number_of_type(indices.data() + i * index_size, index_type, false));
            if (row >= bytes.size() / size)
                fail("a sparse accessor changes element " + std::to_string(row) + ", which there is not");
            std::memcpy(bytes.data() + row * size, values.data() + i * size, size);
        }
        accessor.erase("sparse");
        place(accessor, std::move(bytes));
    }

    // ---- KHR_mesh_quantization

    void make_floats()
    {
        if (!json_.contains("meshes"))
            return;
        std::set<std::size_t> done;
        const auto convert = [&](const ordered_json& attributes) {
            for (const auto& [name, index] : attributes.items())
                if ((name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name.starts_with("TEXCOORD_"))
                    && done.insert(index.get<std::size_t>()).second)
                    make_float(json_.at("accessors").at(index.get<std::size_t>()));
        };
        for (const ordered_json& mesh : json_["meshes"])
            for (const ordered_json& primitive : mesh.at("primitives")) {
                convert(primitive.value("attributes", ordered_json::object()));
                for (const ordered_json& target : primitive.value("targets", ordered_json::array()))
                    convert(target);
            }
    }

    void make_float(ordered_json& accessor)
    {
        const int type = accessor.at("componentType");
        if (type == TINYGLTF_COMPONENT_TYPE_FLOAT)
            return;
        const bool is_normalized = accessor.value("normalized", false);
        const std::string packed = dense_bytes(accessor);
        const std::size_t size = component_size(accessor), components = components_of(accessor);
        require_size(packed.size() / size, sizeof(float));
        std::string bytes(packed.size() / size * sizeof(float), '\0');
        for (std::size_t i = 0; i < packed.size() / size; ++i) {
            const auto value = float(number_of_type(packed.data() + i * size, type, is_normalized));
            std::memcpy(bytes.data() + i * sizeof value, &value, sizeof value);
        }
        accessor["componentType"] = TINYGLTF_COMPONENT_TYPE_FLOAT;
        accessor.erase("normalized");
        if (accessor.contains("min") || accessor.contains("max"))
            write_bounds(accessor, bytes, components);
        place(accessor, std::move(bytes));
    }

    static void write_bounds(ordered_json& accessor, const std::string& bytes, std::size_t components)
    {
        std::vector<float> low(components, std::numeric_limits<float>::infinity()), high(components, -low[0]);
        for (std::size_t i = 0; i * sizeof(float) < bytes.size(); ++i) {
            float value;
            std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
            low[i % components] = std::min(low[i % components], value);
            high[i % components] = std::max(high[i % components], value);
        }
        accessor["min"] = low;
        accessor["max"] = high;
    }

    // ---- instances

    /// Each node gets its own vertices, so that each can be dressed and moved by itself.
    void separate_instances()
    {
        for (const std::size_t node : instances_in(json_))
            json_["nodes"][node]["mesh"] = add_copy_of_mesh(json_["nodes"][node]["mesh"]);
    }

    std::size_t add_copy_of_mesh(std::size_t index)
    {
        ordered_json mesh = json_.at("meshes").at(index);
        std::map<std::size_t, std::size_t> copies;  // accessors: primitives that share vertices go on to
        for (ordered_json& primitive : mesh.at("primitives"))
            for (const char* name : k_of_vertices)
                if (primitive.contains("attributes") && primitive["attributes"].contains(name)) {
                    ordered_json& accessor = primitive["attributes"][name];
                    const auto [copy, is_new] = copies.try_emplace(accessor.get<std::size_t>());
                    if (is_new)
                        copy->second = add_copy_of_accessor(copy->first);
                    accessor = copy->second;
                }
        json_["meshes"].push_back(std::move(mesh));
        return json_["meshes"].size() - 1;
    }

    std::size_t add_copy_of_accessor(std::size_t index)
    {
        ordered_json accessor = json_.at("accessors").at(index);
        std::string bytes = dense_bytes(accessor);
        copied_bytes_ += bytes.size();
        if (copied_bytes_ > k_most_bytes)
            file_.fail("meshes that several nodes show would take more than 2 GB; export fewer copies");
        place(accessor, std::move(bytes));
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    // ---- the result

    void forget_extensions(const char* list)
    {
        if (!json_.contains(list))
            return;
        ordered_json left = ordered_json::array();
        for (const ordered_json& name : json_[list])
            if (name != k_meshopt && name != k_draco && name != k_quantization)
                left.push_back(name);
        if (left.empty())
            json_.erase(list);
        else
            json_[list] = left;
    }

    GltfContainer in_one_buffer()
    {
        GltfContainer result;
        result.is_binary = container_.is_binary;
        result.is_indented = container_.is_indented;
        std::string all = merge_buffers(file_, json_, buffers_);
        if (!result.is_binary)
            json_["buffers"][0]["uri"] = data_uri("application/octet-stream", all);
        result.json = std::move(json_);
        if (result.is_binary)
            result.chunks.push_back({ k_binary_type, std::move(all) });
        return result;
    }

    const FileBytes& file_;
    GltfContainer container_;
    ordered_json& json_;
    std::vector<std::string> buffers_;
    std::size_t copied_bytes_ = 0;
};

}  // namespace

GltfContainer read_plain_gltf(const FileBytes& file, const std::filesystem::path& folder)
{
    GltfContainer container = read_gltf_container(is_scene_file(file) ? glb_of_scene(file) : file);
    try {
        if (!is_packed(container.json) && instances_in(container.json).empty())
            return container;
        return Unpacker(file, std::move(container), folder).run();
    } catch (const ordered_json::exception&) {
        file.fail("the description of its packed data is mangled; export or copy the file again");
    }
}

}  // namespace garmentfit
