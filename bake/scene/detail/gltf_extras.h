// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include <tetralight/bake/scene/detail/gltf_document.h>

// Reads `extras` of elements. Precondition: they obey the rules of gltf_schema.h.

namespace tetralight::detail {

/// Sets what the extras of a node say of the node, but for those of its light.
void read_node_extras(const nlohmann::json& node, GltfNode& result);

/// The extras of a light, or of its node.
[[nodiscard]] GltfLightExtras light_extras_from(const nlohmann::json& element);

/// `extras.bake_emission` of a material: a string, or a boolean for "baked" and "none".
[[nodiscard]] std::optional<std::string> bake_emission_from(const nlohmann::json& material);

}  // namespace tetralight::detail
