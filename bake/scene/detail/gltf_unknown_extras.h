// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds extras that read_gltf() does not read: those that are nearly spelt as one that it reads, or
/// that belong to another kind of element, as parts that change the light, and the rest as data of
/// other programs. Precondition: the document passed parse_gltf_json().
void add_unknown_extras(const nlohmann::json& source, PartList& parts);

}  // namespace tetralight::detail
