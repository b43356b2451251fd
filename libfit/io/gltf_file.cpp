// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <utility>

#include "data_uri.h"
#include "garmentfit/error.h"
#include "gltf_container.h"
#include "gltf_materials.h"
#include "gltf_model.h"
#include "gltf_scene.h"
#include "gltf_stale.h"
#include "gltf_unpack.h"
#include "mesh_content.h"
#include "turned_normals.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

/// In diagonals of all that is written: from a mesh's origin to the furthest of its vertices.
/// unit: of the 24 binary digits of a number, three say where a garment is, and the others what it looks like.
constexpr double k_far = 8;

// ---- the scene -----------------------------------------------------------------------------------------------------

/// A run of vertices in the file: rows [first_row, first_row + positions.count) of the whole.
struct Block {
    int node = 0;
    Eigen::Affine3d world_from_local;
    Column positions;
    std::optional<Column> normals;
    Eigen::Index first_row = 0;
};

class SceneReader {
public:
    SceneReader(const FileBytes& file, const tinygltf::Model& model) : file_(file), model_(model), scene_(file, model)
    {
    }

    void read()
    {
        for (const GltfSurface& surface : scene_.surfaces()) {
            const Block& block = block_of(surface);
            const Eigen::Index before = fans_.rows();
            add_faces(*surface.primitive, block);
            parts.push_back({ surface.primitive, block.first_row, fans_.rows() - before });
            named_parts.push_back(named(surface, before));
        }
    }

    std::vector<Block> blocks;
    std::vector<GltfPart> parts;
    std::vector<MeshPart> named_parts;  // the same, without names of materials
    Triangles triangles() const { return fans_.triangles(); }
    Eigen::Index rows() const { return rows_; }

private:
    MeshPart named(const GltfSurface& surface, Eigen::Index first_triangle) const
    {
        const tinygltf::Node& node = model_.nodes[std::size_t(surface.node)];
        return { {},
                 model_.meshes[std::size_t(node.mesh)].name,
                 node.name,
                 first_triangle,
                 fans_.rows() - first_triangle,
                 node.skin >= 0 };
    }

    /// Primitives may share vertices: each run of them is read once.
    const Block& block_of(const GltfSurface& surface)
    {
        const auto& [node, shown, positions, adds_vertices] = surface;
        const tinygltf::Primitive& primitive = *shown;
        std::optional<Column> normals;
        if (const auto attribute = primitive.attributes.find("NORMAL"); attribute != primitive.attributes.end())
            normals = vector_column(file_, model_, attribute->second, "NORMAL");
        std::size_t& at = block_at_[{ positions.buffer, positions.begin }];
        if (adds_vertices) {
            at = blocks.size();
            add_block({ node, scene_.world_from_mesh(node), positions, normals, rows_ });
        }
        Block& block = blocks[at];
        if (block.node != node)
            file_.fail("nodes " + std::to_string(block.node) + " and " + std::to_string(node)
                       + " show the same mesh; give each its own copy");
        if (!block.normals) {
            block.normals = normals;
            require_as_many_normals(block);
        }
        const bool same_normals = !normals || normals->place() == block.normals->place();
        if (block.positions.place() != positions.place() || !same_normals)
            file_.fail("two primitives share POSITION (accessor " + std::to_string(positions.accessor)
                       + ") in part only; export them with their own vertices");
        return block;
    }

    void require_as_many_normals(const Block& block) const
    {
        if (block.normals && block.normals->count != block.positions.count)
            file_.fail("POSITION (accessor " + std::to_string(block.positions.accessor)
                       + ") and NORMAL have different counts; export the file again");
    }

    void add_block(const Block& block)
    {
        const double volume = std::abs(block.world_from_local.linear().determinant());
        if (!block.world_from_local.matrix().allFinite() || !std::isnormal(volume))
            file_.fail("node " + std::to_string(block.node) + " flattens its mesh; give it a scale other than 0");
        require_as_many_normals(block);
        if (block.positions.count > static_cast<std::size_t>(INT_MAX - rows_))
            file_.fail("has more vertices than this program can count; decimate the mesh");
        blocks.push_back(block);
        rows_ += static_cast<Eigen::Index>(block.positions.count);
    }

    void add_faces(const tinygltf::Primitive& primitive, const Block& block)
    {
        const bool is_mirrored = block.world_from_local.linear().determinant() < 0;
        const int first = static_cast<int>(block.first_row);
        for (auto [a, b, c] : triangles_of(file_, model_, primitive, block.positions.count)) {
            if (is_mirrored)
                std::swap(b, c);
            fans_.add({ first + a, first + b, first + c });
        }
    }

    const FileBytes& file_;
    const tinygltf::Model& model_;
    const GltfScene scene_;
    std::map<std::pair<int, std::size_t>, std::size_t> block_at_;  // (buffer, first byte) -> block
    FanBuilder fans_;
    Eigen::Index rows_ = 0;
};

/// Writing must not change one vertex by another's number.
void require_apart(const FileBytes& file, const std::vector<Block>& blocks)
{
    std::vector<std::pair<int, std::size_t>> places;
    for (const Block& block : blocks)
        for (const Column* column : { &block.positions, block.normals ? &*block.normals : nullptr })
            for (std::size_t row = 0; column && row < column->count; ++row)
                places.emplace_back(column->buffer, column->offset(row));
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); ++i)
        if (places[i].first == places[i - 1].first && places[i].second - places[i - 1].second < sizeof(Eigen::Vector3f))
            file.fail("vertices overlap in buffer " + std::to_string(places[i].first) + " at byte "
                      + std::to_string(places[i].second) + "; export them with their own data");
}

// ---- values --------------------------------------------------------------------------------------------------------

using Buffers = std::vector<tinygltf::Buffer>;

Vec3 value_at(const Buffers& buffers, const Column& column, Eigen::Index row)
{
    Eigen::Vector3f value;
    std::memcpy(value.data(), buffers[column.buffer].data.data() + column.offset(row), sizeof value);
    return value.cast<double>();
}

void set_value(Buffers& buffers, const Column& column, Eigen::Index row, const Vec3& value)
{
    const Eigen::Vector3f single = value.cast<float>();
    std::memcpy(buffers[column.buffer].data.data() + column.offset(row), single.data(), sizeof single);
}

struct GltfContent : MeshFile::Content {
    GltfContainer container;
    Buffers buffers;
    std::vector<Block> blocks;
    Positions normals;  ///< of the world; zero where the file has none
    Appearance look;
    std::vector<MeshPart> named_parts;

    Appearance appearance() const override { return look; }
    CornerUvs corner_uvs() const override { return garmentfit::corner_uvs(look.uvs, look.uv_corners); }
    std::vector<MeshPart> parts() const override { return named_parts; }
    double against_faces() const override { return share_against_faces(normals, triangles, triangles, positions); }

    std::string bytes_with(const Positions& moved) const override
    {
        const Positions turned = turn_normals(normals, triangles, triangles, positions, moved);
        Buffers written = buffers;
        GltfContainer result = container;
        std::vector<WrittenNode> nodes;
        for (const Block& block : blocks) {
            if (nodes.empty() || nodes.back().node != block.node)  // primitives of a node follow it
                nodes.push_back(written_node(block.node, moved));
            if (nodes.back().has_moved)
                write_block(block, nodes.back(), moved, turned, written, result.json);
        }
        if (std::any_of(nodes.begin(), nodes.end(), [](const WrittenNode& node) { return node.has_moved; }))
            remove_stale(result.json, nodes);
        store(written, result);
        return bytes_of(result);
    }

private:
    /// A mesh that moves far away from where its node stands, as when it is written in another unit, is placed in the
    /// middle of all: single precision has too few digits for both.
    WrittenNode written_node(int node, const Positions& moved) const
    {
        WrittenNode result { node, Eigen::Affine3d::Identity() };
        double distance = 0;
        for (const Block& block : blocks) {
            if (block.node != node)
                continue;
            result.world_from_mesh = block.world_from_local;
            const Positions now = rows_of(block, moved);
            if (now == rows_of(block, positions))
                continue;
            result.has_moved = true;
            distance = std::max(
                distance, (now.rowwise() - block.world_from_local.translation().transpose()).cwiseAbs().maxCoeff());
        }
        if (!result.has_moved)
            return result;
        const Vec3 low = moved.colwise().minCoeff(), high = moved.colwise().maxCoeff();
        result.is_placed_anew = distance > k_far * (high - low).norm();
        if (result.is_placed_anew)  // by a place that single precision knows
            result.world_from_mesh.translation() = ((low + high) / 2).cast<float>().cast<double>();
        return result;
    }

    static Positions rows_of(const Block& block, const Positions& all)
    {
        return all.middleRows(block.first_row, Eigen::Index(block.positions.count));
    }

    void write_block(const Block& block, const WrittenNode& node, const Positions& moved, const Positions& turned,
                     Buffers& written, ordered_json& json) const
    {
        const Eigen::Affine3d local_from_world = node.world_from_mesh.inverse();
        const Eigen::Matrix3d local_from_world_normal = block.world_from_local.linear().transpose();
        for (std::size_t i = 0; i < block.positions.count; ++i) {
            const Eigen::Index row = block.first_row + static_cast<Eigen::Index>(i);
            if (node.is_placed_anew || moved.row(row) != positions.row(row))
                set_value(written, block.positions, i, local_from_world * Vec3(moved.row(row)));
            if (block.normals && turned.row(row) != normals.row(row) && turned.row(row).allFinite())
                set_value(written, *block.normals, i, (local_from_world_normal * Vec3(turned.row(row))).normalized());
        }
        write_bounds(block.positions, written, json["accessors"][block.positions.accessor]);
    }

    static void write_bounds(const Column& column, const Buffers& written, ordered_json& accessor)
    {
        Eigen::AlignedBox3d box;
        for (std::size_t i = 0; i < column.count; ++i)
            box.extend(value_at(written, column, i));
        accessor["min"] = { box.min().x(), box.min().y(), box.min().z() };
        accessor["max"] = { box.max().x(), box.max().y(), box.max().z() };
    }

    static void store(const Buffers& written, GltfContainer& result)
    {
        for (std::size_t i = 0; i < written.size(); ++i) {
            const std::vector<unsigned char>& data = written[i].data;
            ordered_json& buffer = result.json["buffers"][i];
            const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size());
            if (std::string* own = result.own_buffer(); own && i == 0 && !buffer.contains("uri"))
                own->replace(0, bytes.size(), bytes);
            else
                buffer["uri"] = data_uri("application/octet-stream", bytes);
        }
    }
};

void read_values(const FileBytes& file, GltfContent& content, Eigen::Index rows)
{
    content.positions.resize(rows, 3);
    content.normals = Positions::Zero(rows, 3);
    for (const Block& block : content.blocks) {
        const Eigen::Matrix3d world_from_local_normal = block.world_from_local.linear().inverse().transpose();
        for (std::size_t i = 0; i < block.positions.count; ++i) {
            const Eigen::Index row = block.first_row + static_cast<Eigen::Index>(i);
            content.positions.row(row) = block.world_from_local * value_at(content.buffers, block.positions, i);
            if (!content.positions.row(row).allFinite())
                file.fail("POSITION (accessor " + std::to_string(block.positions.accessor) + "), vertex "
                              + std::to_string(i) + ", is not finite; repair the file",
                          ErrorCode::not_finite);
            if (block.normals)
                content.normals.row(row) = world_from_local_normal * value_at(content.buffers, *block.normals, i);
        }
    }
}

std::vector<int> nodes_of(const std::vector<Block>& blocks)
{
    std::vector<int> nodes;
    for (const Block& block : blocks)
        nodes.push_back(block.node);
    return nodes;
}

/// The model has only geometry.
void name_materials(const std::vector<GltfPart>& parts, const ordered_json& json, std::vector<MeshPart>& named)
{
    const ordered_json materials = json.value("materials", ordered_json::array());
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (const int material = parts[i].primitive->material; material >= 0 && materials.is_array()
            && std::size_t(material) < materials.size() && materials[std::size_t(material)].is_object())
            named[i].material = materials[std::size_t(material)].value("name", "");
}

}  // namespace

ContentPtr read_gltf(FileBytes file, const std::filesystem::path& folder)
{
    auto content = std::make_shared<GltfContent>();
    content->container = read_plain_gltf(file, folder);
    content->format = content->container.is_binary ? "glb" : "gltf";
    try {
        tinygltf::Model model = load_model(file, content->container, folder);
        SceneReader scene(file, model);
        scene.read();
        require_apart(file, scene.blocks);
        content->triangles = scene.triangles();
        content->blocks = std::move(scene.blocks);
        content->named_parts = std::move(scene.named_parts);
        embed_pictures(content->container.json, folder);
        content->left_behind = list_stale(content->container.json, nodes_of(content->blocks));
        name_materials(scene.parts, content->container.json, content->named_parts);
        content->look
            = gltf_appearance(file, model, content->container.json, scene.parts, content->triangles, content->warnings);
        fill_missing_pictures(content->container.json);
        content->buffers = std::move(model.buffers);
        read_values(file, *content, scene.rows());
    } catch (const InvalidInput&) {
        throw;
    } catch (const std::exception& error) {  // of the JSON library: a member of an unexpected type
        file.fail("is not valid glTF: " + first_line(error.what()) + "; export the file again");
    }
    return content;
}

}  // namespace garmentfit
