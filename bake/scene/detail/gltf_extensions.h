// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <tetralight/bake/scene/detail/gltf_model.h>

// Reads extensions and extras of tinygltf's elements.

namespace tetralight::detail {

/// The index; kNoIndex for tinygltf's −1.
[[nodiscard]] uint32_t index_from(int index);

/// Null if the element does not have the extension.
[[nodiscard]] const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                                    const char* name);

/// The number, or `otherwise` if there is no value. Precondition: the value is a number.
[[nodiscard]] double number_at(const tinygltf::Value& object, const char* key, double otherwise);

/// The string, "(not a string)" for another type, or nothing if the key is absent.
[[nodiscard]] std::optional<std::string> string_extra(const tinygltf::Value& extras,
                                                      const char* key);

/// The boolean, or nothing if the key is absent. Precondition: the value is a boolean.
[[nodiscard]] std::optional<bool> boolean_extra(const tinygltf::Value& extras, const char* key);

/// The number, NaN for another type, or nothing if the key is absent.
[[nodiscard]] std::optional<double> number_extra(const tinygltf::Value& extras, const char* key);

/// Two numbers, or nothing if the key is absent. Precondition: it is an array of two numbers.
[[nodiscard]] std::optional<glm::dvec2> vec2_extra(const tinygltf::Value& extras, const char* key);

/// `extras.bake_emission`: a string, or a boolean for "baked" and "none".
[[nodiscard]] std::optional<std::string> bake_emission_from(const tinygltf::Value& extras);

/// With KHR_texture_transform.
[[nodiscard]] TextureUse texture_use_from(const tinygltf::TextureInfo& info);
[[nodiscard]] TextureUse texture_use_from(const tinygltf::NormalTextureInfo& info);

/// The mask of `extras.rendering_layers`. Precondition: they obey the rules.
[[nodiscard]] std::optional<uint32_t> rendering_layers_extra(const tinygltf::Value& extras);

/// `extras.probe_adjustment`.
[[nodiscard]] std::optional<GltfAdjustment> adjustment_from(const tinygltf::Value& extras);

[[nodiscard]] GltfLightExtras light_extras_from(const tinygltf::Value& extras);

}  // namespace tetralight::detail
