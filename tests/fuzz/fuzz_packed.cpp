// SPDX-License-Identifier: GPL-3.0-or-later
// The input's first byte says how the sample glTF is packed: by Draco, or its vertices or indices by meshopt. The rest
// are the packed bytes.
#include "packed_gltf_samples.h"
#include "read_all.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace garmentfit;
    static const fuzz::Folder folder;
    if (size == 0)
        return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    samples::PackedGltf packed;
    if (data[0] % 3 == 0) {
        packed.pack_with_draco(bytes);
    } else {
        packed.pack_with_meshopt();
        const std::size_t view = data[0] % 3 - 1;
        auto& part = packed.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
        part["buffer"] = packed.add_buffer(bytes);
        part["byteLength"] = bytes.size();
    }
    fuzz::read_all(folder.save("given.gltf", packed.json.dump()), folder.path("written.gltf"));
    return 0;
}
