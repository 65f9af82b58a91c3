// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv_texture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include <tetralight/base/contract.h>
#include <tetralight/lppv/detail/mean_band_2.h>
#include <tetralight/lppv/detail/slab_texels.h>

namespace tetralight {
namespace {

/// Coordinates in the volume: 0 to 1 from edge to edge of the outer texels.
glm::vec3 volume_coordinates(const LppvConstants& constants, const glm::vec3& position) {
    const glm::vec3 local = constants.params.y == 1.0f
                                ? glm::vec3(constants.local_from_world * glm::vec4(position, 1.0f))
                                : position;
    return (local - glm::vec3(constants.low)) * glm::vec3(constants.size_inverse);
}

uint32_t texel_index(float coordinate, uint32_t size) {
    if (!(coordinate > 0.0f)) return 0;
    return static_cast<uint32_t>(std::min(coordinate, static_cast<float>(size - 1)));
}

/// The texels of one grid point.
detail::SlabTexels point_texels(const Lppv& lppv, LppvLayout layout, size_t point) {
    const glm::vec4 lit(1.0f);
    return detail::slab_texels(layout, pack_sh(lppv.irradiance[point]),
                               lppv.occlusion.empty() ? lit : lppv.occlusion[point]);
}

}  // namespace

LppvTexture make_lppv_texture(const Lppv& lppv, LppvLayout layout, LppvTexelFormat format) {
    const glm::uvec3 grid = lppv.grid.resolution;
    const uint32_t slabs = slab_count(layout);
    LppvTexture texture{layout, format, {slabs * grid.x, grid.y, grid.z}, {}};
    const size_t bytes = texel_size(format);
    texture.texels.resize(slabs * lppv.grid.point_count() * bytes);
    for (size_t i = 0; i < lppv.irradiance.size(); ++i) {
        const auto texels = point_texels(lppv, layout, i);
        const size_t row = i / grid.x, column = i % grid.x;
        for (uint32_t slab = 0; slab < slabs; ++slab) {
            const size_t texel = (row * slabs + slab) * grid.x + column;
            detail::write_texel(&texture.texels[texel * bytes], format, texels[slab]);
        }
    }
    return texture;
}

float largest_texel_value(const Lppv& lppv, LppvLayout layout) {
    float largest = 0.0f;
    for (size_t i = 0; i < lppv.irradiance.size(); ++i) {
        const auto texels = point_texels(lppv, layout, i);
        for (uint32_t slab = 0; slab < slab_count(layout); ++slab) {
            for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(texels[slab][c]));
        }
    }
    return largest;
}

LppvConstants make_lppv_constants(const Lppv& lppv, LppvLayout layout) {
    const LppvGrid& grid = lppv.grid;
    LppvConstants constants;
    constants.local_from_world = glm::mat4(grid.local_from_world);
    const bool is_local = grid.local_from_world != glm::dmat4(1.0);
    const auto width = static_cast<float>(slab_count(layout) * grid.resolution.x);
    constants.params = {1.0f, is_local ? 1.0f : 0.0f, 1.0f / width, 0.0f};
    constants.low = glm::vec4(glm::vec3(grid.first - 0.5 * grid.step), 0.0f);
    for (int i = 0; i < 3; ++i) {
        if (grid.step[i] > 0.0) {
            constants.size_inverse[i] =
                static_cast<float>(1.0 / (grid.resolution[i] * grid.step[i]));
        }
    }
    if (layout == LppvLayout::FourSlabs) {
        const PackedSh band_2 = pack_sh(detail::mean_band_2(lppv.irradiance));
        constants.shb_r = band_2.shb_r;
        constants.shb_g = band_2.shb_g;
        constants.shb_b = band_2.shb_b;
        constants.shc = band_2.shc;
    }
    return constants;
}

glm::vec4 fetch_texel(const LppvTexture& texture, glm::uvec3 texel) noexcept {
    const size_t index = (size_t{texel.z} * texture.size.y + texel.y) * texture.size.x + texel.x;
    const std::byte* from = &texture.texels[index * texel_size(texture.format)];
    glm::vec4 value;
    if (texture.format == LppvTexelFormat::Float) {
        std::memcpy(&value, from, sizeof value);
        return value;
    }
    std::array<uint16_t, 4> halves;
    std::memcpy(halves.data(), from, sizeof halves);
    for (int i = 0; i < 4; ++i) value[i] = glm::unpackHalf1x16(halves[static_cast<size_t>(i)]);
    return value;
}

glm::vec4 filter_texture(const LppvTexture& texture, glm::vec3 uvw) noexcept {
    const glm::vec3 at = uvw * glm::vec3(texture.size) - 0.5f;
    const glm::vec3 lower = glm::floor(at);
    const glm::vec3 fraction = at - lower;
    glm::vec4 sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        float weight = 1.0f;
        glm::uvec3 texel;
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_upper = (corner >> axis & 1) != 0;
            weight *= is_upper ? fraction[axis] : 1.0f - fraction[axis];
            texel[axis] = texel_index(lower[axis] + (is_upper ? 1.0f : 0.0f), texture.size[axis]);
        }
        if (weight != 0.0f) sum += weight * fetch_texel(texture, texel);
    }
    return sum;
}

PackedSh sample_lppv_texture(const LppvTexture& texture, const LppvConstants& constants,
                             glm::vec3 position) noexcept {
    const auto slabs = static_cast<float>(slab_count(texture.layout));
    const float half_texel = 0.5f * constants.params.z;
    glm::vec3 uvw = volume_coordinates(constants, position);
    uvw.x = glm::clamp(uvw.x / slabs, half_texel, 1.0f / slabs - half_texel);
    PackedSh band_2{};
    band_2.shb_r = constants.shb_r;
    band_2.shb_g = constants.shb_g;
    band_2.shb_b = constants.shb_b;
    band_2.shc = constants.shc;
    return detail::sample_slabs(texture, uvw, band_2);
}

glm::vec4 sample_lppv_occlusion(const LppvTexture& texture, const LppvConstants& constants,
                                glm::vec3 position) noexcept {
    if (texture.layout == LppvLayout::SevenSlabs) return glm::vec4(1.0f);
    glm::vec3 uvw = volume_coordinates(constants, position);
    // At the upper end the sampler clamps, because the slab ends at the edge of the texture.
    uvw.x = std::max(0.25f * uvw.x + 0.75f, 0.75f + 0.5f * constants.params.z);
    return filter_texture(texture, uvw);
}

}  // namespace tetralight
