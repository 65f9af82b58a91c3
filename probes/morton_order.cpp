// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/morton_order.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include <tetralight/base/box.h>

namespace tetralight {
namespace {

/// Spreads the low 10 bits so that two zero bits follow each.
uint32_t spread_bits(uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

/// The lattice of a Morton curve in the bounding box of some positions.
struct MortonLattice {
    glm::vec3 origin{0.0f};
    glm::vec3 scale{0.0f};
    int bits = 1;

    explicit MortonLattice(std::span<const glm::vec3> positions) {
        auto box = Box<glm::vec3>::empty();
        for (const glm::vec3& p : positions) {
            if (is_finite(p)) box = union_of(box, p);
        }
        origin = box.min;
        // About eight lattice points a position.
        bits = std::clamp(static_cast<int>(std::bit_width(positions.size())) / 3 + 1, 1, 10);
        const auto steps = static_cast<float>(1 << bits);
        for (int axis = 0; axis < 3; ++axis) {
            const float size = box.size()[axis];
            if (size > 0.0f && std::isfinite(size)) scale[axis] = steps / size;
        }
    }

    [[nodiscard]] uint32_t index(const glm::vec3& position) const {
        const glm::vec3 point = (position - origin) * scale;
        return spread_bits(step(point.x)) << 2 | spread_bits(step(point.y)) << 1 |
               spread_bits(step(point.z));
    }

  private:
    /// The lattice point below a coordinate; 0 for NaN, which huge boxes give (infinity times 0).
    [[nodiscard]] uint32_t step(float coordinate) const {
        const auto last = static_cast<float>((1 << bits) - 1);
        return coordinate > 0.0f ? static_cast<uint32_t>(std::min(coordinate, last)) : 0u;
    }
};

/// One pass of the radix sort by the digit of `digit_bits` bits from bit `shift` on.
void sort_by_digit(std::span<const uint64_t> from, std::span<uint64_t> to, int shift,
                   int digit_bits) {
    std::array<uint32_t, 1 << 12> begins{};
    const size_t mask = (size_t{1} << digit_bits) - 1;
    const auto digit_of = [&](uint64_t key) { return static_cast<size_t>(key >> shift) & mask; };
    for (const uint64_t key : from) ++begins[digit_of(key)];
    uint32_t begin = 0;
    for (size_t digit = 0; digit <= mask; ++digit) {
        begin += std::exchange(begins[digit], begin);
    }
    for (const uint64_t key : from) to[begins[digit_of(key)]++] = key;
}

}  // namespace

std::span<const uint64_t> morton_order(std::span<const glm::vec3> positions,
                                       std::span<uint64_t> memory) noexcept {
    const size_t count = positions.size();
    std::span<uint64_t> keys = memory.first(count);
    std::span<uint64_t> other = memory.subspan(count, count);
    const MortonLattice lattice(positions);
    for (size_t i = 0; i < count; ++i) {
        const uint64_t index = is_finite(positions[i]) ? lattice.index(positions[i]) : 0;
        keys[i] = index << 32 | i;
    }
    constexpr int kLargestDigit = 12;
    const int bits = 3 * lattice.bits;
    const int passes = (bits + kLargestDigit - 1) / kLargestDigit;
    const int digit_bits = (bits + passes - 1) / passes;
    for (int pass = 0; pass < passes; ++pass) {
        sort_by_digit(keys, other, 32 + pass * digit_bits, digit_bits);
        std::swap(keys, other);
    }
    return keys;
}

}  // namespace tetralight
