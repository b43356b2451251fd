// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What hosts know about a parameter, and the visitors that all of them share.
//
// A visitor is called once for each parameter: visit(value, about). The value is a double, an int, a bool, an enum
// whose names are about.choices, in order, or an optional of one of these. Its default is what the options struct holds
// before anybody changes it; an optional is empty then, and about.otherwise says what holds instead.

#include <limits>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "garmentfit/error.h"
#include "garmentfit/number_text.h"

namespace garmentfit {

/// Who needs a parameter. Hosts show research after the everyday ones, or hide it.
enum class Group {
    everyday,
    research  ///< to compare published methods; none of them makes a garment fit better
};

struct About {
    std::string_view name;  ///< "contact_distance": unique among all filters; a host's spelling is made from it
    std::string_view label;  ///< "Contact distance"
    std::string_view unit;  ///< "m", "kg/m^2", ...; empty for a plain number
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    std::string_view help;  ///< one sentence, no full stop
    const std::vector<std::string_view>* choices = nullptr;  ///< names of an enum's values
    Group group = Group::everyday;
    std::string_view otherwise = {};  ///< of an optional value: "of the fabric"; the text of an empty one, too
};

template <class Value>
struct IsOptional : std::false_type {
};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {
};
/// Whether a parameter may be left empty.
template <class Value>
constexpr bool is_optional = IsOptional<std::decay_t<Value>>::value;

constexpr int k_shown_digits = 6;  // unit: more than anybody chooses a parameter by

/// The value as a host would write it: "0.0025", "on", "tshirt", "of the fabric".
template <class Value>
std::string text_of(const Value& value, const About& about)
{
    if constexpr (is_optional<Value>) {
        return value ? text_of(*value, about) : std::string(about.otherwise);
    } else if constexpr (std::is_enum_v<Value>) {
        return std::string(about.choices->at(static_cast<std::size_t>(value)));
    } else if constexpr (std::is_same_v<Value, bool>) {
        return value ? "on" : "off";
    } else if constexpr (std::is_integral_v<Value>) {
        return std::to_string(value);
    } else {
        return rounded_text(value, k_shown_digits);
    }
}

/// "0.0001..0.05 m", "on or off", or the choices.
template <class Value>
std::string range_of(const About& about)
{
    if constexpr (is_optional<Value>) {
        return range_of<typename Value::value_type>(about);
    } else if constexpr (std::is_enum_v<Value>) {
        std::string text;
        for (const std::string_view choice : *about.choices)
            text += (text.empty() ? "" : ", ") + std::string(choice);
        return text;
    } else if constexpr (std::is_same_v<Value, bool>) {
        return "on or off";
    } else {
        return rounded_text(about.min, k_shown_digits) + ".." + rounded_text(about.max, k_shown_digits)
            + (about.unit.empty() ? "" : " ") + std::string(about.unit);
    }
}

/// Reads a value from text. @throws InvalidInput naming the parameter, the text and the range.
template <class Value>
void set_from_text(Value& value, const About& about, const std::string& text)
{
    const auto refuse = [&](ErrorCode code) {
        throw InvalidInput(code,
                           std::string(about.name) + ": \"" + text + "\" is not possible; give "
                               + (std::is_enum_v<Value> ? "one of " : "") + range_of<Value>(about));
    };
    if constexpr (is_optional<Value>) {
        if (text == about.otherwise)
            value.reset();
        else
            set_from_text(value.emplace(), about, text);
    } else if constexpr (std::is_enum_v<Value>) {
        for (std::size_t i = 0; i < about.choices->size(); ++i)
            if ((*about.choices)[i] == text) {
                value = static_cast<Value>(i);
                return;
            }
        refuse(ErrorCode::unknown_name);
    } else if constexpr (std::is_same_v<Value, bool>) {
        if (text != "on" && text != "off")
            refuse(ErrorCode::unknown_name);
        value = text == "on";
    } else {
        std::istringstream in(text);
        Value read {};
        if (!(in >> read) || in.peek() != std::istringstream::traits_type::eof())
            refuse(ErrorCode::out_of_range);
        value = read;
    }
}

/// Throws InvalidInput at the first value out of its range.
struct CheckRanges {
    template <class Value>
    void operator()(const Value& value, const About& about) const
    {
        if constexpr (is_optional<Value>) {
            if (value)
                operator()(*value, about);
        } else if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) {
            if (!(value >= about.min && value <= about.max))  // also refuses NaN
                throw InvalidInput(ErrorCode::out_of_range,
                                   std::string(about.name) + ": " + text_of(value, about) + " is out of range; give "
                                       + range_of<Value>(about));
        }
    }
};

/// Sets the one parameter of that name from text; `found` tells whether there was one.
struct SetByName {
    std::string_view name;
    std::string text;
    bool found = false;

    template <class Value>
    void operator()(Value& value, const About& about)
    {
        if (about.name != name)
            return;
        set_from_text(value, about, text);
        CheckRanges()(value, about);
        found = true;
    }
};

/// One row of a Markdown table for each parameter.
class MarkdownTable {
public:
    explicit MarkdownTable(std::ostream& out) : out_(out)
    {
        out_ << "| parameter | default | range | what it does |\n| --- | --- | --- | --- |\n";
    }

    template <class Value>
    void operator()(const Value& value, const About& about)
    {
        out_ << "| `" << about.name << "` | " << text_of(value, about) << " | " << range_of<Value>(about) << " | "
             << about.help << " |\n";
    }

private:
    std::ostream& out_;
};

}  // namespace garmentfit
