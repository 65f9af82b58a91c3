// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

namespace tetralight::conformance {

/// Random numbers that are the same with every standard library, unlike those of its distributions.
class Numbers {
  public:
    explicit Numbers(uint64_t seed) : engine_(seed) {}

    /// In [low, high).
    [[nodiscard]] double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }

    /// In [0, count).
    [[nodiscard]] size_t below(size_t count) { return static_cast<size_t>(engine_() % count); }

    [[nodiscard]] glm::dvec3 in_cube(double half_side) {
        const double x = between(-half_side, half_side);
        const double y = between(-half_side, half_side);
        const double z = between(-half_side, half_side);
        return {x, y, z};
    }

    /// A unit vector.
    [[nodiscard]] glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v = in_cube(1.0);
            const double square = glm::dot(v, v);
            if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
        }
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace tetralight::conformance
