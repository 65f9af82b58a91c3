// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/sample_lightmap.h>

#include <algorithm>
#include <array>
#include <bit>

#include <tetralight/base/compiler.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/half.h>
#include <tetralight/lightmap/directional_light.h>

namespace tetralight {
namespace {

/// The pages whose texels are there.
template <class Texel>
struct TexelPages {
    const Texel* texels = nullptr;
    uint32_t page_count = 0;
    uint32_t page_size = 0;
    float scale = 0.0f;
};

/// `scale`: of the texels' values.
template <class Texel>
TexelPages<Texel> pages_of(const LightmapInfo& info, std::span<const Texel> texels,
                           float scale) noexcept {
    const bool is_sound = info.page_size > 0 && info.page_size <= kLargestPageSize &&
                          scale > 0.0f && scale <= kLargestLightmapScale;
    if (!is_sound) return {};
    const uint64_t count = texels.size() / (uint64_t{info.page_size} * info.page_size);
    return {texels.data(), static_cast<uint32_t>(std::min<uint64_t>(count, info.page_count)),
            info.page_size, scale};
}

template <class Texel>
TexelPages<Texel> pages_of(const LightmapInfo& info, std::span<const Texel> texels) noexcept {
    return pages_of(info, texels, info.scale);
}

/// Along one axis: the first of two texels, whether the second is another one, and its weight.
struct Step {
    uint32_t first = 0;
    uint32_t next = 0;
    float weight = 0.0f;
};

/// Not a number becomes 0.
inline Step step_along(float coordinate, uint32_t page_size) noexcept {
    const auto last = static_cast<float>(page_size - 1);
    const float place = coordinate * static_cast<float>(page_size) - 0.5f;
    const float clamped = place > 0.0f ? std::min(place, last) : 0.0f;
    Step step;
    step.first = static_cast<uint32_t>(clamped);
    step.next = step.first + 1 < page_size ? 1 : 0;
    step.weight = clamped - static_cast<float>(step.first);
    return step;
}

/// Four texels and their weights times the scale, which are 0 if the page is out of range.
struct Corners {
    std::array<size_t, 4> texels;
    std::array<float, 4> weights;
};

/// Precondition: there is a page.
template <class Texel>
inline Corners corners_at(const TexelPages<Texel>& pages, uint32_t page, glm::vec2 uv) noexcept {
    const bool is_there = page < pages.page_count;
    const float scale = is_there ? pages.scale : 0.0f;
    const size_t size = pages.page_size;
    const Step x = step_along(uv.x, pages.page_size), y = step_along(uv.y, pages.page_size);
    const size_t first = (is_there ? page : 0u) * size * size + y.first * size + x.first;
    const size_t below = first + y.next * size;
    const float upper = (1.0f - y.weight) * scale, lower = y.weight * scale;
    return {
        {first, first + x.next, below, below + x.next},
        {upper * (1.0f - x.weight), upper * x.weight, lower * (1.0f - x.weight), lower * x.weight}};
}

/// Samples that are worked on together: their texels fit in the fastest cache.
constexpr size_t kSampleBlock = 32;

using CornerBlock = std::array<Corners, kSampleBlock>;

void fetch_block(const TexelPages<IrradianceTexel>& pages, std::span<const uint32_t> numbers,
                 std::span<const glm::vec2> uvs, CornerBlock& block) noexcept {
    for (size_t i = 0; i < uvs.size(); ++i) {
        block[i] = corners_at(pages, numbers[i], uvs[i]);
        prefetch(pages.texels + block[i].texels[0]);
        prefetch(pages.texels + block[i].texels[2]);
    }
}

/// `float_from_half` of the magnitude: irradiance is not negative. Compilers turn four calls into
/// vector code, since the choice is made by a mask.
inline float magnitude_from_half(uint16_t half) noexcept {
    constexpr uint32_t kBiasDifference = 112u << 23, kSmallestNormal = 1u << 23;
    const uint32_t magnitude = (half & 0x7fffu) << 13;
    const uint32_t normal = magnitude + kBiasDifference;
    const float shifted = std::bit_cast<float>(normal + kSmallestNormal);
    const auto denormal = std::bit_cast<uint32_t>(shifted - 0x1p-14f);
    const uint32_t is_denormal = 0u - static_cast<uint32_t>(magnitude < kSmallestNormal);
    return std::bit_cast<float>((is_denormal & denormal) | (~is_denormal & normal));
}

inline glm::vec3 blended(const IrradianceTexel* texels, const Corners& corners) noexcept {
    // Four channels, so that one vector holds a texel.
    using Texel = std::array<uint16_t, 4>;
    const auto texel = [&](size_t corner) {
        return std::bit_cast<Texel>(texels[corners.texels[corner]]);
    };
    const Texel a = texel(0), b = texel(1), c = texel(2), d = texel(3);
    std::array<float, 4> sum;
    for (size_t i = 0; i < 4; ++i) {
        sum[i] = corners.weights[0] * magnitude_from_half(a[i]) +
                 corners.weights[1] * magnitude_from_half(b[i]) +
                 corners.weights[2] * magnitude_from_half(c[i]) +
                 corners.weights[3] * magnitude_from_half(d[i]);
    }
    return {sum[0], sum[1], sum[2]};
}

/// Flux and v of each channel: the sums of the texels' times the corners' weights.
struct BlendedLight {
    glm::vec3 flux{0.0f};
    std::array<glm::vec3, 3> vectors{glm::vec3(0.0f), glm::vec3(0.0f), glm::vec3(0.0f)};
};

BlendedLight blended_light(const LightmapTexel* texels, const Corners& corners) noexcept {
    BlendedLight light;
    for (size_t corner = 0; corner < 4; ++corner) {
        const LightmapTexel& texel = texels[corners.texels[corner]];
        const float weight = corners.weights[corner];
        for (int channel = 0; channel < 3; ++channel) {
            const auto c = static_cast<size_t>(channel);
            const auto& [x, y, z] = texel.vector[c];
            light.flux[channel] += weight * float_from_half(texel.flux[c]);
            light.vectors[c] +=
                weight * glm::vec3(float_from_half(x), float_from_half(y), float_from_half(z));
        }
    }
    return light;
}

}  // namespace

glm::vec2 page_uv(const LightmapRectangle& rectangle, glm::vec2 uv) noexcept {
    return uv * rectangle.scale + rectangle.offset;
}

glm::vec3 sample_irradiance(const LightmapsView& lightmaps, uint32_t page,
                            glm::vec2 uv_page) noexcept {
    const auto pages = pages_of(lightmaps.info, lightmaps.irradiance);
    if (page >= pages.page_count) return glm::vec3(0.0f);
    const Corners corners = corners_at(pages, page, uv_page);
    return blended(pages.texels, corners);
}

glm::vec3 sample_lightmap(const LightmapsView& lightmaps, uint32_t page, glm::vec2 uv_page,
                          const MappedNormals& normals) noexcept {
    if (lightmaps.light.empty()) return sample_irradiance(lightmaps, page, uv_page);
    const auto pages = pages_of(lightmaps.info, lightmaps.light);
    if (page >= pages.page_count) return glm::vec3(0.0f);
    const BlendedLight light = blended_light(pages.texels, corners_at(pages, page, uv_page));
    glm::vec3 irradiance;
    for (int channel = 0; channel < 3; ++channel) {
        irradiance[channel] =
            directional_irradiance(light.flux[channel], light.vectors[static_cast<size_t>(channel)],
                                   normals.base, normals.mapped);
    }
    return irradiance;
}

glm::vec4 sample_shadow_mask(const LightmapsView& lightmaps, uint32_t page,
                             glm::vec2 uv_page) noexcept {
    const auto pages = pages_of(lightmaps.info, lightmaps.shadow_mask, 1.0f / 255.0f);
    if (page >= pages.page_count) return glm::vec4(1.0f);
    const Corners corners = corners_at(pages, page, uv_page);
    glm::vec4 visible(0.0f);
    for (size_t corner = 0; corner < 4; ++corner) {
        const auto& [x, y, z, w] = pages.texels[corners.texels[corner]];
        visible += corners.weights[corner] * glm::vec4(x, y, z, w);
    }
    return visible;
}

float sample_ambient_occlusion(const LightmapsView& lightmaps, uint32_t page,
                               glm::vec2 uv_page) noexcept {
    const auto pages = pages_of(lightmaps.info, lightmaps.ambient_occlusion, 1.0f / 255.0f);
    if (page >= pages.page_count) return 1.0f;
    const Corners corners = corners_at(pages, page, uv_page);
    float open = 0.0f;
    for (size_t corner = 0; corner < 4; ++corner)
        open += corners.weights[corner] * pages.texels[corners.texels[corner]];
    return open;
}

void sample_irradiance(const LightmapsView& lightmaps, std::span<const uint32_t> pages,
                       std::span<const glm::vec2> uvs_page,
                       std::span<glm::vec3> irradiance) noexcept {
    TETRALIGHT_ASSERT(pages.size() == uvs_page.size() && pages.size() == irradiance.size(),
                      "spans of different sizes");
    const auto texels = pages_of(lightmaps.info, lightmaps.irradiance);
    if (texels.page_count == 0) {
        std::ranges::fill(irradiance, glm::vec3(0.0f));
        return;
    }
    const auto fetch = [&](size_t first, CornerBlock& block) {
        if (first >= pages.size()) return;
        const size_t count = std::min(kSampleBlock, pages.size() - first);
        fetch_block(texels, pages.subspan(first, count), uvs_page.subspan(first, count), block);
    };
    std::array<CornerBlock, 2> blocks;
    fetch(0, blocks[0]);
    size_t block = 0;
    for (size_t first = 0; first < pages.size(); first += kSampleBlock, block ^= 1) {
        fetch(first + kSampleBlock, blocks[block ^ 1]);
        const size_t count = std::min(kSampleBlock, pages.size() - first);
        for (size_t i = 0; i < count; ++i) {
            irradiance[first + i] = blended(texels.texels, blocks[block][i]);
        }
    }
}

}  // namespace tetralight
