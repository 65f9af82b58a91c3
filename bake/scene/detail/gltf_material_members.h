// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <tetralight/bake/scene/detail/gltf_textures.h>
#include <tetralight/base/result.h>

// Members of glTF materials. `path` is that of a member in the material, such as
// ".pbrMetallicRoughness.metallicFactor"; its last part names the member in messages.

namespace tetralight::detail {

/// A factor, from 0 to 1.
[[nodiscard]] Result<float> read_factor(double value, const char* path);

[[nodiscard]] Result<glm::vec3> read_factors(const glm::dvec3& values, const char* path);
[[nodiscard]] Result<glm::vec4> read_factors(const glm::dvec4& values, const char* path);

/// The same use with an index of the reader's textures.
[[nodiscard]] Result<TextureUse> read_texture_use(TextureUse use, const char* path,
                                                  GltfTextureReader& reader);

}  // namespace tetralight::detail
