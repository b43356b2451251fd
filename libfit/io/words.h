// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lines, words and numbers of text files, fast and with their places.

#include <optional>
#include <string>
#include <string_view>

#include "file_bytes.h"
#include "garmentfit/number_text.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// The words of a range of text, one after the other. A backslash before the end of a line is a blank, as in OBJ.
class Words {
public:
    Words(const FileBytes& file, Span range) : file_(&file), at_(range.begin), end_(range.end) { }

    bool done();  ///< no word is left
    Span next();  ///< @throws InvalidInput when done
    std::string_view next_text() { return file_->text(next()); }
    long long next_integer();  ///< @throws InvalidInput: none left, not an integer
    std::size_t at() const { return at_; }  ///< where the next word begins, or the blanks before it

private:
    const FileBytes* file_;
    std::size_t at_, end_;
};

/// The lines of a file, one after the other. With `joined`, a backslash at the end of a line joins the next one to it.
class Lines {
public:
    explicit Lines(const FileBytes& file, std::size_t from = 0) : file_(file), next_(from) { }

    bool advance(bool joined = false);  ///< to the next line; false at the end
    Span line() const { return line_; }  ///< without its line break

private:
    const FileBytes& file_;
    std::size_t next_;
    Span line_;
};

/// Without a message: empty where the word is no number, or no integer.
std::optional<double> parsed_number(std::string_view word);
std::optional<long long> parsed_integer(std::string_view word);

[[noreturn]] void fail_not_finite(const FileBytes& file, Span triple);

/// Not-a-number and infinity count as numbers. @throws InvalidInput with the line.
double number_in(const FileBytes& file, Span word);
long long integer_in(const FileBytes& file, Span word);

/// Three numbers in a row, with their place.
struct Triple {
    Vec3 values;
    Span span;
};
Triple next_triple(Words& words, const FileBytes& file);
Triple next_finite_triple(Words& words, const FileBytes& file);

}  // namespace garmentfit
