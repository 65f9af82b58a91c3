// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/hilbert.h>

#include <algorithm>
#include <utility>

namespace tetralight {
namespace {

constexpr int kBits = kHilbertBits;
constexpr double kLargest = (1u << kBits) - 1;

constexpr std::array<std::array<uint8_t, 3>, 6> kPermutations = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
constexpr uint32_t kOrientationCount = 6 * 16;

/// Orientation of the curve in a cube: which axes take the place of x, y and z, which of them are
/// reversed, and whether the Gray code before this level ends with inverted bits.
struct Orientation {
    std::array<uint8_t, 3> axes{};
    std::array<bool, 3> is_reversed{};
    bool is_inverted = false;
};

constexpr Orientation orientation_at(uint32_t number) {
    return {kPermutations[number / 16],
            {(number & 2) != 0, (number & 4) != 0, (number & 8) != 0},
            (number & 1) != 0};
}

constexpr uint32_t number_of(const Orientation& orientation) {
    uint32_t number = 0;
    while (kPermutations[number] != orientation.axes) ++number;
    return number * 16 + orientation.is_reversed[0] * 2u + orientation.is_reversed[1] * 4u +
           orientation.is_reversed[2] * 8u + orientation.is_inverted;
}

/// One level of Skilling's transform: for an octant of a cube its place along the curve (the lowest
/// three bits), and the orientation of the curve in it.
constexpr uint16_t step(uint32_t number, uint32_t octant) {
    Orientation orientation = orientation_at(number);
    std::array<bool, 3> bits{};
    for (size_t i = 0; i < 3; ++i) {
        bits[i] = ((octant >> (2 - orientation.axes[i]) & 1u) != 0) != orientation.is_reversed[i];
    }
    uint32_t place = 0;
    bool gray = orientation.is_inverted;
    for (const bool bit : bits) {
        gray = gray != bit;
        place = place << 1 | gray;
    }
    orientation.is_inverted = gray;
    for (size_t i = 0; i < 3; ++i) {
        if (bits[i]) {
            orientation.is_reversed[0] = !orientation.is_reversed[0];
        } else {
            std::swap(orientation.axes[0], orientation.axes[i]);
            std::swap(orientation.is_reversed[0], orientation.is_reversed[i]);
        }
    }
    return static_cast<uint16_t>(number_of(orientation) << 3 | place);
}

/// `step` for each orientation (the upper bits of the index) and octant.
constexpr std::array<uint16_t, kOrientationCount* 8> kSteps = [] {
    std::array<uint16_t, kOrientationCount * 8> steps{};
    for (uint32_t i = 0; i < steps.size(); ++i) steps[i] = step(i >> 3, i & 7u);
    return steps;
}();

}  // namespace

uint64_t hilbert_index(std::array<uint32_t, 3> point) noexcept {
    uint64_t index = 0;
    uint32_t state = 0;
    for (int bit = kBits - 1; bit >= 0; --bit) {
        const uint32_t octant =
            (point[0] >> bit & 1u) << 2 | (point[1] >> bit & 1u) << 1 | (point[2] >> bit & 1u);
        state = kSteps[(state & ~7u) | octant];
        index = index << 3 | (state & 7u);
    }
    return index;
}

uint64_t HilbertCube::index(const glm::dvec3& position) const noexcept {
    std::array<uint32_t, 3> point;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = (position[axis] - min[axis]) * scale;
        point[axis] = step > 0.0 ? static_cast<uint32_t>(std::min(step, kLargest)) : 0u;
    }
    return hilbert_index(point);
}

HilbertCube make_hilbert_cube(const glm::dvec3& min, const glm::dvec3& max) noexcept {
    const glm::dvec3 size = max - min;
    const double longest = std::max({size.x, size.y, size.z});
    return {min, longest > 0.0 ? kLargest / longest : 0.0};
}

}  // namespace tetralight
