// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/texture_3d.h>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

Status check_texture(const std::string& path, const Texture3dView& texture) {
    const uint64_t texels = uint64_t{texture.width} * texture.height * texture.depth;
    TETRALIGHT_ASSERT(texture.texels.size() == texels * texel_bytes(texture.format),
                      "a texture has width * height * depth texels");
    if (texels > 0) return Ok{};
    return Error{ErrorCode::InvalidArgument,
                 str_cat(path, ": cannot write a texture of ", texture.width, " x ", texture.height,
                         " x ", texture.depth, " texels")};
}

}  // namespace tetralight::detail
