// SPDX-License-Identifier: GPL-3.0-or-later
// The input is the JSON of a glTF, up to the first zero byte, and its buffer: a GLB is made of them, whose lengths are
// right, so that more inputs get past the container.
#include <algorithm>

#include "mesh_file_samples.h"
#include "read_all.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace garmentfit;
    static const fuzz::Folder folder;
    const std::string input(reinterpret_cast<const char*>(data), size);
    const std::size_t end = std::min(input.find('\0'), size);
    const std::string buffer = end < size ? input.substr(end + 1) : samples::gltf_buffer();
    fuzz::read_all(folder.save("given.glb", samples::glb(input.substr(0, end), buffer)), folder.path("written.glb"));
    return 0;
}
