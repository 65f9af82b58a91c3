// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The extras of a node over those of its light.
[[nodiscard]] GltfLightExtras merged_extras(const GltfLightExtras& of_node,
                                            const GltfLightExtras& of_light);

/// Sets what extras say: mode, falloff, indirect multiplier, size and shape. `light` has its type
/// and range already; a shape changes the type.
[[nodiscard]] Status apply_light_extras(const GltfLightExtras& extras, Light& light);

}  // namespace tetralight::detail
