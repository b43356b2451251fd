// SPDX-License-Identifier: GPL-3.0-or-later
#include "glb_model.h"

#include <sstream>

namespace garmentfit {

GlbModel::GlbModel()
{
    model.asset.version = "2.0";
    model.asset.generator = "garmentfit";
    model.defaultScene = 0;
    model.buffers.emplace_back();
    model.scenes.emplace_back();
}

int GlbModel::add_view(const void* bytes, std::size_t size, int target)
{
    std::vector<unsigned char>& data = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    const auto* first = static_cast<const unsigned char*>(bytes);
    data.insert(data.end(), first, first + size);
    data.resize((data.size() + 3) / 4 * 4);  // the format wants accessors to begin at a multiple of their component
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size()) - 1;
}

int GlbModel::add_bytes(const void* bytes, std::size_t size, int component, std::size_t count, int type, int target)
{
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(bytes, size, target);
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    model.accessors.push_back(accessor);
    return int(model.accessors.size()) - 1;
}

std::string GlbModel::file() const
{
    std::ostringstream bytes;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true);
    return std::move(bytes).str();
}

}  // namespace garmentfit
