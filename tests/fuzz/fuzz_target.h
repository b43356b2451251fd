// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all fuzz targets share: the function that libFuzzer and replay.cpp call, and how a target says that it failed.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace garmentfit::fuzz {

/// Ends the process, which is what both take for a failure.
inline void require(bool holds, const char* what)
{
    if (holds)
        return;
    std::fprintf(stderr, "fuzz: %s does not hold\n", what);
    std::abort();
}

/// An error is one line for the user.
inline void require_one_line(std::string_view message)
{
    require(!message.empty() && message.find('\n') == std::string_view::npos, "that an error is one line");
}

/// A folder of this process, gone at its end. TMPDIR says where: best in memory.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("garmentfit-fuzz-" + std::to_string(::getpid())))
    {
        std::filesystem::create_directories(path_);
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path save(const std::string& name, std::string_view bytes) const
    {
        std::ofstream(path_ / name, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
        return path_ / name;
    }
    std::filesystem::path path(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace garmentfit::fuzz
