// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <tetralight/bake/scene/detail/part_list.h>

namespace tetralight::detail {

/// Adds members of objects that glTF 2.0 does not define there: those that are nearly spelt as one
/// that it defines, or that belong to another object, or extensions outside of `extensions`, as
/// parts that change the light, and the rest as data of other programs. Precondition: the document
/// passed parse_gltf_json().
void add_unknown_members(const nlohmann::json& source, PartList& parts);

}  // namespace tetralight::detail
