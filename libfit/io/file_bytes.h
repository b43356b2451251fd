// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A file in memory: messages with the place of an error, and copies with some bytes replaced.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "garmentfit/error.h"

namespace garmentfit {

/// Bytes [begin, end) of a file.
struct Span {
    std::size_t begin = 0, end = 0;
};

struct FileBytes {
    std::string name;  ///< the path as the user gave it, for messages
    std::string bytes;

    std::string_view text(Span span) const { return std::string_view(bytes).substr(span.begin, span.end - span.begin); }

    [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::unreadable_file) const;
    [[noreturn]] void fail_at_line_of(std::size_t offset, const std::string& what,
                                      ErrorCode code = ErrorCode::unreadable_file) const;
    [[noreturn]] void fail_at_byte(std::size_t offset, const std::string& what,
                                   ErrorCode code = ErrorCode::unreadable_file) const;
};

/// @throws InvalidInput when there is no such regular, readable, non-empty file.
FileBytes read_file(const std::filesystem::path& path);

/// Copies a file and replaces some of its bytes. Replacements come in the order of the file.
class Rewriter {
public:
    explicit Rewriter(const std::string& original);
    void replace(Span span, std::string_view bytes);
    std::string finish();

private:
    const std::string& original_;
    std::string result_;
    std::size_t copied_ = 0;
};

}  // namespace garmentfit
