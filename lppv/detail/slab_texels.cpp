// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/detail/slab_texels.h>

#include <cstring>

#include <tetralight/base/half.h>

namespace tetralight::detail {
namespace {

/// Adds `fraction` · 3 s6, which SHB has in `z`, to `w` of SHA.
glm::vec4 with_s6(const glm::vec4& sha, const glm::vec4& shb, float fraction) {
    return {sha.x, sha.y, sha.z, sha.w + fraction * shb.z};
}

constexpr float kThird = 1.0f / 3.0f;

}  // namespace

SlabTexels slab_texels(LppvLayout layout, const PackedSh& light,
                       const glm::vec4& occlusion) noexcept {
    if (layout == LppvLayout::SevenSlabs) {
        return {light.sha_r, light.sha_g, light.sha_b, light.shb_r,
                light.shb_g, light.shb_b, light.shc};
    }
    return {with_s6(light.sha_r, light.shb_r, kThird), with_s6(light.sha_g, light.shb_g, kThird),
            with_s6(light.sha_b, light.shb_b, kThird), occlusion};
}

void write_texel(std::byte* to, LppvTexelFormat format, const glm::vec4& value) noexcept {
    if (format == LppvTexelFormat::Float) {
        std::memcpy(to, &value, sizeof value);
        return;
    }
    const std::array<uint16_t, 4> halves{
        half_from_float_saturated(value.x), half_from_float_saturated(value.y),
        half_from_float_saturated(value.z), half_from_float_saturated(value.w)};
    std::memcpy(to, halves.data(), sizeof halves);
}

PackedSh without_band_2(PackedSh light) noexcept {
    light.sha_r = with_s6(light.sha_r, light.shb_r, kThird);
    light.sha_g = with_s6(light.sha_g, light.shb_g, kThird);
    light.sha_b = with_s6(light.sha_b, light.shb_b, kThird);
    light.shb_r = light.shb_g = light.shb_b = glm::vec4(0.0f);
    light.shc = {0.0f, 0.0f, 0.0f, 1.0f};
    return light;
}

PackedSh with_band_2(PackedSh light, const PackedSh& band_2) noexcept {
    light.sha_r = with_s6(light.sha_r, band_2.shb_r, -kThird);
    light.sha_g = with_s6(light.sha_g, band_2.shb_g, -kThird);
    light.sha_b = with_s6(light.sha_b, band_2.shb_b, -kThird);
    light.shb_r = band_2.shb_r;
    light.shb_g = band_2.shb_g;
    light.shb_b = band_2.shb_b;
    light.shc = band_2.shc;
    return light;
}

PackedSh sample_slabs(const LppvTexture& texture, glm::vec3 uvw, const PackedSh& band_2) noexcept {
    const auto slabs = static_cast<float>(slab_count(texture.layout));
    const auto slab = [&](int i) {
        return filter_texture(texture, uvw + glm::vec3(static_cast<float>(i) / slabs, 0.0f, 0.0f));
    };
    PackedSh light{};
    light.sha_r = slab(0);
    light.sha_g = slab(1);
    light.sha_b = slab(2);
    if (texture.layout == LppvLayout::FourSlabs) return with_band_2(light, band_2);
    light.shb_r = slab(3);
    light.shb_g = slab(4);
    light.shb_b = slab(5);
    light.shc = slab(6);
    return light;
}

}  // namespace tetralight::detail
