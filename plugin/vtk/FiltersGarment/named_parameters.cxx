// SPDX-License-Identifier: GPL-3.0-or-later
#include "named_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace garmentfit {
namespace {

/// Calls `use(value, about)` for the one parameter of that name.
template <class AnyParameters, class Use>
void with_parameter(const Filter& filter, AnyParameters& parameters, const char* name, const Use& use)
{
    describe(filter, parameters, [&](auto& value, const About& about) {
        if (name && about.name == name)
            use(value, about);
    });
}

template <class Value>
double smallest(const About& about)
{
    return std::is_enum_v<Value> || std::is_same_v<Value, bool> ? 0 : about.min;
}

template <class Value>
double largest(const About& about)
{
    if constexpr (std::is_enum_v<Value>)
        return double(about.choices->size()) - 1;
    return std::is_same_v<Value, bool> ? 1 : about.max;
}

template <class Value>
bool assign(Value& value, const Value& wanted)
{
    const bool changed = value != wanted;
    value = wanted;
    return changed;
}

}  // namespace

std::vector<std::string> parameter_names(const Filter& filter)
{
    std::vector<std::string> names;
    const Parameters defaults;
    describe(filter, defaults, [&](const auto&, const About& about) { names.emplace_back(about.name); });
    return names;
}

bool has_parameter(const Filter& filter, const char* name)
{
    const std::vector<std::string> names = parameter_names(filter);
    return name && std::find(names.begin(), names.end(), name) != names.end();
}

double number_of(const Filter& filter, const Parameters& parameters, const char* name)
{
    double number = 0;
    with_parameter(filter, parameters, name, [&](const auto& value, const About&) {
        if constexpr (is_optional<decltype(value)>)
            number = value.value_or(std::numeric_limits<double>::quiet_NaN());
        else
            number = static_cast<double>(value);
    });
    return number;
}

std::pair<double, double> range_of_number(const Filter& filter, const char* name)
{
    std::pair<double, double> range;
    const Parameters defaults;
    with_parameter(filter, defaults, name, [&](const auto& value, const About& about) {
        using Value = std::decay_t<decltype(value)>;
        range = { smallest<Value>(about), largest<Value>(about) };
    });
    return range;
}

bool set_number(const Filter& filter, Parameters& parameters, const char* name, double number)
{
    bool changed = false;
    with_parameter(filter, parameters, name, [&](auto& value, const About& about) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (is_optional<Value>)
            if (std::isnan(number)) {
                changed = assign(value, Value());
                return;
            }
        const double clamped = std::min(std::max(number, smallest<Value>(about)), largest<Value>(about));
        changed = assign(value, static_cast<Value>(clamped));
    });
    return changed;
}

std::string text_of(const Filter& filter, const Parameters& parameters, const char* name)
{
    std::string text;
    with_parameter(filter, parameters, name,
                   [&](const auto& value, const About& about) { text = text_of(value, about); });
    return text;
}

bool set_text(const Filter& filter, Parameters& parameters, const char* name, const char* text)
{
    bool changed = false;
    with_parameter(filter, parameters, name, [&](auto& value, const About& about) {
        auto wanted = value;
        SetByName { about.name, text ? text : "" }(wanted, about);
        changed = assign(value, wanted);
    });
    return changed;
}

std::string help_on(const Filter& filter, const char* name)
{
    std::string help;
    const Parameters defaults;
    with_parameter(filter, defaults, name, [&](const auto& value, const About& about) {
        help = std::string(about.help) + " (" + range_of<std::decay_t<decltype(value)>>(about) + ")";
    });
    return help;
}

}  // namespace garmentfit
