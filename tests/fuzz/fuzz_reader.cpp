// SPDX-License-Identifier: GPL-3.0-or-later
// The input is a file whose name ends in GARMENTFIT_FUZZ_FORMAT.
#include "read_all.h"
#include "scene_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace garmentfit::fuzz;
    static const Folder folder;
    static const std::string ending = "." GARMENTFIT_FUZZ_FORMAT;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (garmentfit::is_scene_file({ ending, std::string(bytes) }))
        return 0;  // Assimp reads it in a process of its own, which sanitizers do not allow
    read_all(folder.save("given" + ending, bytes), folder.path("written" + ending));
    return 0;
}
