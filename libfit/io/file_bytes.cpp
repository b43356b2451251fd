// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include <algorithm>
#include <fstream>

namespace garmentfit {

void FileBytes::fail(const std::string& what, ErrorCode code) const { throw InvalidInput(code, name + ": " + what); }

void FileBytes::fail_at_line_of(std::size_t offset, const std::string& what, ErrorCode code) const
{
    const auto end = bytes.begin() + std::min(offset, bytes.size());
    fail("line " + std::to_string(1 + std::count(bytes.begin(), end, '\n')) + ": " + what, code);
}

void FileBytes::fail_at_byte(std::size_t offset, const std::string& what, ErrorCode code) const
{
    fail("byte " + std::to_string(offset) + ": " + what, code);
}

FileBytes read_file(const std::filesystem::path& path)
{
    FileBytes file { path.string(), {} };
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        file.fail("there is no such file; check the path");
    if (!std::filesystem::is_regular_file(status))
        file.fail(std::filesystem::is_directory(status) ? "is a directory; give a mesh file"
                                                        : "is not a regular file; give a mesh file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        file.fail("cannot be opened; check its permissions");
    file.bytes.resize(std::filesystem::file_size(path, error));
    if (error || !stream.read(file.bytes.data(), static_cast<std::streamsize>(file.bytes.size())))
        file.fail("cannot be read to its end; check the disk or copy the file again");
    if (file.bytes.empty())
        file.fail("is empty; give a mesh file");
    return file;
}

Rewriter::Rewriter(const std::string& original) : original_(original)
{
    result_.reserve(original.size() + original.size() / 2);
}

void Rewriter::replace(Span span, std::string_view bytes)
{
    result_.append(original_, copied_, span.begin - copied_);
    result_ += bytes;
    copied_ = span.end;
}

std::string Rewriter::finish()
{
    result_.append(original_, copied_);
    return std::move(result_);
}

}  // namespace garmentfit
