// SPDX-License-Identifier: GPL-3.0-or-later
#include "words.h"

#include <array>
#include <charconv>

namespace garmentfit {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

template <class Number>
bool parses(std::string_view word, Number& value)
{
    if (word.size() > 1 && word[0] == '+' && word[1] != '-')  // from_chars knows no plus sign
        word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

/// For from_chars 1e-400 is out of range; for a mesh it is 0.
bool is_tiny(std::string_view word)
{
    const std::size_t e = word.find_first_of("eE");
    return e != std::string_view::npos && word.substr(e + 1, 1) == "-"
        && word.find_first_not_of("0123456789.+-eE") == std::string_view::npos;
}

std::string quoted(std::string_view word)
{
    std::string text = "'";
    for (const char c : word.substr(0, 40))
        text += c >= ' ' && c <= '~' ? c : '?';
    return text + "'";
}

}  // namespace

std::optional<double> parsed_number(std::string_view word)
{
    double value = 0;
    return parses(word, value) || is_tiny(word) ? std::optional(value) : std::nullopt;
}

std::optional<long long> parsed_integer(std::string_view word)
{
    long long value = 0;
    return parses(word, value) ? std::optional(value) : std::nullopt;
}

void fail_not_finite(const FileBytes& file, Span triple)
{
    file.fail_at_line_of(triple.begin, quoted(file.text(triple)) + " is not finite; repair the file",
                         ErrorCode::not_finite);
}

double number_in(const FileBytes& file, Span word)
{
    const std::optional<double> value = parsed_number(file.text(word));
    if (!value)
        file.fail_at_line_of(word.begin, quoted(file.text(word)) + " is not a number; export the file again");
    return *value;
}

long long integer_in(const FileBytes& file, Span word)
{
    const std::optional<long long> value = parsed_integer(file.text(word));
    if (!value)
        file.fail_at_line_of(word.begin, quoted(file.text(word)) + " is not an integer; export the file again");
    return *value;
}

bool Words::done()
{
    const std::string& bytes = file_->bytes;
    while (at_ < end_ && (is_blank(bytes[at_]) || (bytes[at_] == '\\' && at_ + 1 < end_ && is_blank(bytes[at_ + 1]))))
        ++at_;
    return at_ >= end_;
}

Span Words::next()
{
    if (done())
        file_->fail_at_line_of(end_ ? end_ - 1 : 0,
                               "ends too soon; the file is truncated or mangled, export or copy it again");
    const std::size_t begin = at_;
    while (at_ < end_ && !is_blank(file_->bytes[at_]))
        ++at_;
    return { begin, at_ };
}

long long Words::next_integer() { return integer_in(*file_, next()); }

bool Lines::advance(bool joined)
{
    const std::string& bytes = file_.bytes;
    if (next_ >= bytes.size())
        return false;
    const auto is_joined = [&](std::size_t at) {
        const std::size_t last = at > line_.begin && bytes[at - 1] == '\r' ? at - 1 : at;
        return joined && last > line_.begin && bytes[last - 1] == '\\';
    };
    line_ = { next_, bytes.find('\n', next_) };
    while (line_.end != std::string::npos && is_joined(line_.end))
        line_.end = bytes.find('\n', line_.end + 1);
    if (line_.end == std::string::npos)
        line_.end = bytes.size();
    next_ = line_.end + 1;
    return true;
}

Triple next_triple(Words& words, const FileBytes& file)
{
    const std::array<Span, 3> places { words.next(), words.next(), words.next() };
    Triple triple;
    for (int k = 0; k < 3; ++k)
        triple.values[k] = number_in(file, places[k]);
    triple.span = { places.front().begin, places.back().end };
    return triple;
}

Triple next_finite_triple(Words& words, const FileBytes& file)
{
    const Triple triple = next_triple(words, file);
    if (!triple.values.allFinite())
        fail_not_finite(file, triple.span);
    return triple;
}

}  // namespace garmentfit
