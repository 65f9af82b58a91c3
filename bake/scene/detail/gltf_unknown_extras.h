// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds extras that read_gltf() does not read: those that are nearly spelt as one that it reads, or
/// that belong to another kind of element, as parts that change the light, and the rest as data of
/// other programs. Precondition: the document passed parse_gltf_json().
void add_unknown_extras(const nlohmann::json& source, PartList& parts);

/// True for the name of extras that read_gltf() reads of the elements of a section. False for words
/// that other programs use too.
[[nodiscard]] bool is_extras_name(std::string_view section, std::string_view name);

}  // namespace tetralight::detail
