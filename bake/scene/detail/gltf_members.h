// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>

// Reads members of glTF's elements. All have one precondition: the document obeys the rules of
// gltf_schema.h, so that a member that is there has its type. Paths of keys are separated by '/'.

namespace tetralight::detail {

/// Calls `visit` with each element of each section, its section and what messages call it:
/// `node 3 "lamp"`.
void for_each_element(
    const nlohmann::json& document,
    const std::function<void(const GltfSection& section, const nlohmann::json& element,
                             const std::string& place)>& visit);

/// The array of the document at this path; an empty one if there is none.
[[nodiscard]] const nlohmann::json& array_at(const nlohmann::json& value, std::string_view path);

/// An index; kNoIndex if there is none.
[[nodiscard]] uint32_t index_at(const nlohmann::json& value, std::string_view path);

[[nodiscard]] std::vector<uint32_t> indices_at(const nlohmann::json& value, std::string_view path);

/// An object of indices, such as the accessors of attributes.
[[nodiscard]] std::map<std::string, uint32_t> index_map_at(const nlohmann::json& value,
                                                           std::string_view path);

[[nodiscard]] uint64_t size_at(const nlohmann::json& value, std::string_view path,
                               uint64_t otherwise);
[[nodiscard]] double number_at(const nlohmann::json& value, std::string_view path,
                               double otherwise);
[[nodiscard]] std::vector<double> numbers_at(const nlohmann::json& value, std::string_view path);
[[nodiscard]] std::string string_at(const nlohmann::json& value, std::string_view path,
                                    std::string_view otherwise = "");

/// A boolean, or 0 or 1, as exporters write it that have no boolean properties.
[[nodiscard]] std::optional<bool> boolean_at(const nlohmann::json& value, std::string_view path);

[[nodiscard]] glm::dvec3 vec3_at(const nlohmann::json& value, std::string_view path,
                                 const glm::dvec3& otherwise);
[[nodiscard]] glm::dvec4 vec4_at(const nlohmann::json& value, std::string_view path,
                                 const glm::dvec4& otherwise);

/// A use of a texture, with KHR_texture_transform.
[[nodiscard]] TextureUse texture_use_at(const nlohmann::json& material, std::string_view path);

}  // namespace tetralight::detail
