// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace tetralight {

/// Independent random numbers: PCG-XSH-RR (O'Neill 2014, "PCG: A Family of Simple Fast
/// Space-Efficient Statistically Good Algorithms for Random Number Generation").
class Pcg {
  public:
    /// Streams of different numbers are independent.
    Pcg(uint64_t seed, uint64_t stream) : increment_(2 * stream + 1) {
        next_bits();
        state_ += seed;
        next_bits();
    }

    /// Uniform in [0, 1).
    [[nodiscard]] float next() { return static_cast<float>(next_bits() >> 8) * 0x1p-24f; }

    [[nodiscard]] glm::vec2 next2() {
        const float x = next();
        return {x, next()};
    }

    uint32_t next_bits() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + increment_;
        const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }

  private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

}  // namespace tetralight
