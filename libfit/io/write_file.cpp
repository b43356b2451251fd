// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <unistd.h>

#include "garmentfit/error.h"
#include "garmentfit/io.h"

namespace garmentfit {
namespace {

bool write_all(const std::filesystem::path& path, std::string_view bytes)
{
    std::ofstream stream(path, std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    return !stream.fail();
}

}  // namespace

void write_file(const std::filesystem::path& path, std::string_view bytes)
{
    std::filesystem::path part = path;
    part += ".part";
    part += std::to_string(getpid());
    std::error_code error;
    const bool written = write_all(part, bytes);
    if (written)
        std::filesystem::rename(part, path, error);
    if (!written || error) {
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw InvalidInput(
            ErrorCode::unwritable_file,
            path.string() + ": cannot be written; check that the folder exists, its permissions and the space left");
    }
}

}  // namespace garmentfit
