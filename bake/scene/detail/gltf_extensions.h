// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <tetralight/bake/scene/detail/gltf_model.h>

// What extensions and extras of tinygltf's elements say.

namespace tetralight::detail {

/// kNoIndex for tinygltf's −1.
[[nodiscard]] uint32_t index_from(int index);

/// Null where the element has no such extension.
[[nodiscard]] const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                                    const char* name);

/// Precondition: the value is a number where there is one.
[[nodiscard]] double number_at(const tinygltf::Value& object, const char* key, double otherwise);

/// What is no string reads "(not a string)".
[[nodiscard]] std::optional<std::string> string_extra(const tinygltf::Value& extras,
                                                      const char* key);

/// Precondition: the value is a boolean where there is one.
[[nodiscard]] std::optional<bool> boolean_extra(const tinygltf::Value& extras, const char* key);

/// `extras.bake_emission`: a string, or a boolean for "baked" and "none".
[[nodiscard]] std::optional<std::string> bake_emission_from(const tinygltf::Value& extras);

/// With KHR_texture_transform.
[[nodiscard]] TextureUse texture_use_from(const tinygltf::TextureInfo& info);

/// `extras.probe_adjustment`.
[[nodiscard]] std::optional<GltfAdjustment> adjustment_from(const tinygltf::Value& extras);

[[nodiscard]] GltfLightExtras light_extras_from(const tinygltf::Value& extras);

}  // namespace tetralight::detail
