// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The fields of dialogs and scripts. Their names are keys of scripts and never change; choices are numbered in this
// order.

#include <string_view>
#include <vector>

#include "garmentfit/filters/outfit.h"
#include "garmentfit/filters/schema.h"
#include "host_api.h"
#include "menu.h"

namespace garmentfit::meshlab {

inline const QString k_body = "body", k_worn = "worn", k_file = "file", k_unit = "unit", k_up = "up", k_front = "front",
                     k_garment_unit = "garment_unit", k_garment_up = "garment_up", k_bone = "shown_bone",
                     k_map = "shown_map", k_outfit_bones = "bones", k_body_file = "body_file",
                     k_hide_covered_skin = "hide_covered_skin", k_influences = "influences";
inline const QString k_garment_fronts[] = { "garment_front", "second_garment_front", "third_garment_front" };
inline const QString k_garments[] = { "garment", "second_garment", "third_garment" };
inline const QString k_types[] = { "type", "second_type", "third_type" };
/// The first is a parameter of the schema.
inline const QString k_fabrics[] = { "fabric", "second_fabric", "third_fabric" };

/// Of the second and third garment.
inline std::vector<std::string_view> further_fabrics()
{
    std::vector<std::string_view> names { "as the first" };
    names.insert(names.end(), fabric_names().begin(), fabric_names().end());
    return names;
}

/// The last one is shown first.
inline std::vector<std::string_view> outfit_bones()
{
    std::vector<std::string_view> names;
    for (const auto& [name, set] : bone_name_sets())
        names.push_back(name);
    names.push_back(k_own_bones);
    return names;
}

inline std::vector<std::string_view> influences()
{
    std::vector<std::string_view> names;
    for (const auto& [name, count] : influence_choices())
        names.push_back(name);
    return names;
}

inline const std::vector<std::string_view> k_maps { "ease", "strain", "pressure", "none" };

inline QString text(std::string_view words) { return QString::fromUtf8(words.data(), int(words.size())); }

/// Lengths are shown in the body's unit.
inline bool is_length(const About& about) { return about.unit == "m"; }

/// Calls the visitor for each parameter of the schema that an entry shows.
template <class AnyParameters, class Visitor>
void describe_entry(const MenuEntry& entry, AnyParameters& parameters, const Visitor& visit)
{
    if (entry.filter)
        describe(*entry.filter, parameters, visit);
    else if (entry.task == Task::measure)
        describe_cloth(parameters.drape.cloth, visit);
}

}  // namespace garmentfit::meshlab
