// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/detail/verify_texels.h>

#include <array>
#include <bit>
#include <cmath>

#include <tetralight/base/hex.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/section_error.h>

namespace tetralight::detail {
namespace {

constexpr uint16_t kInfinity = 0x7c00, kMinusZero = 0x8000;
constexpr size_t kBytesOfHalf = 2;

bool is_finite_half(uint16_t half) {
    return (half & kInfinity) != kInfinity;
}

/// Finite, and at least 0.
bool is_light(uint16_t half) {
    return half < kInfinity || half == kMinusZero;
}

/// The first of a texel's halves that is wrong; their number if none is.
size_t first_wrong(const IrradianceTexel& texel) {
    const bool is_covered = texel.coverage <= kCovered;
    for (size_t i = 0; i < 3; ++i) {
        if (!is_light(texel.rgb[i])) return i;
    }
    return is_covered ? 4 : 3;
}

size_t first_wrong(const LayerTexel& texel) {
    size_t i = 0;
    while (i < 3 && is_light(texel.rgb[i])) ++i;
    return i;
}

size_t first_wrong(const LightmapTexel& texel) {
    const auto halves = std::bit_cast<std::array<uint16_t, 12>>(texel);
    size_t i = 0;
    while (i < 12 && (i < 3 ? is_light(halves[i]) : is_finite_half(halves[i]))) ++i;
    return i;
}

size_t first_wrong(uint16_t error) {
    return is_light(error) ? 1 : 0;
}

template <class Texel>
Status check_section(std::string_view section, std::span<const Texel> texels) {
    constexpr size_t kHalves = sizeof(Texel) / kBytesOfHalf;
    for (size_t i = 0; i < texels.size(); ++i) {
        const size_t wrong = first_wrong(texels[i]);
        if (wrong == kHalves) continue;
        const auto halves = std::bit_cast<std::array<uint16_t, kHalves>>(texels[i]);
        return element_error(
            section, i,
            str_cat("half ", wrong, " is out of range (0x", hex(uint64_t{halves[wrong]}, 4), ")"));
    }
    return Ok{};
}

}  // namespace

bool is_lightmap_scale(float scale) noexcept {
    int exponent = 0;
    return scale >= 1.0f / kLargestLightmapScale && scale <= kLargestLightmapScale &&
           std::frexp(scale, &exponent) == 0.5f;
}

Status check_texels(const LightmapsView& v) {
    for (const Status& status :
         {check_section("irradiance", v.irradiance), check_section("light", v.light),
          check_section("error", v.error), check_section("layer_irradiance", v.layer_irradiance),
          check_section("layer_light", v.layer_light)}) {
        if (!status) return status;
    }
    return Ok{};
}

}  // namespace tetralight::detail
