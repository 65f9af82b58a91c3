// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/srgb.h>

#include <array>
#include <cmath>

namespace tetralight {
namespace {

std::array<float, 256> make_decode_table() {
    std::array<float, 256> table{};
    for (size_t code = 0; code < table.size(); ++code) {
        table[code] = linear_from_srgb(static_cast<float>(code) / 255.0f);
    }
    return table;
}

}  // namespace

float linear_from_srgb(float encoded) noexcept {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

const std::array<float, 256>& linear_from_srgb8_codes() noexcept {
    static const std::array<float, 256> table = make_decode_table();
    return table;
}

float linear_from_srgb8(uint8_t code) noexcept {
    return linear_from_srgb8_codes()[code];
}

float srgb_from_linear(float linear) noexcept {
    if (!(linear > 0.0f)) return 0.0f;  // NaN too
    if (linear >= 1.0f) return 1.0f;
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

uint8_t srgb8_from_linear(float linear) noexcept {
    return static_cast<uint8_t>(srgb_from_linear(linear) * 255.0f + 0.5f);
}

}  // namespace tetralight
