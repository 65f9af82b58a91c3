// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The extras of a light, replaced by those of its node where the node has some.
[[nodiscard]] GltfLightExtras merged_extras(const GltfLightExtras& of_node,
                                            const GltfLightExtras& of_light);

/// Sets mode, falloff, indirect multiplier, size and shape from extras. Precondition: `light` has
/// its type and range; a shape changes the type. Returns invalid_argument, with the field
/// `.extras.NAME`, for unknown words, numbers out of range and extras that do not fit the type.
[[nodiscard]] Status apply_light_extras(const GltfLightExtras& extras, Light& light);

/// Sets mode and indirect multiplier of a light of EXT_lights_area from extras. Returns
/// invalid_argument, with the field `.extras.NAME`, for unknown words, numbers out of range, and
/// extras of the size, shape and falloff, which the extension defines.
[[nodiscard]] Status apply_area_light_extras(const GltfLightExtras& extras, Light& light);

}  // namespace tetralight::detail
