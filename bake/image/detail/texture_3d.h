// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/image/texture_3d.h>

namespace tetralight::detail {

[[nodiscard]] constexpr uint32_t texel_bytes(TexelFormat format) noexcept {
    return format == TexelFormat::Rgba16Float ? 8 : 16;
}

/// Asserts that the number of texels is width · height · depth. Returns invalid_argument if it is
/// 0.
[[nodiscard]] Status check_texture(const std::string& path, const Texture3dView& texture);

}  // namespace tetralight::detail
