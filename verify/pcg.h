// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace tetralight {

/// Random numbers: PCG-XSH-RR (O'Neill 2014, "PCG: A Family of Simple Fast
/// Space-Efficient Statistically Good Algorithms for Random Number Generation").
class Pcg {
  public:
    /// Streams of one seed are different, but not independent: their states follow from each other.
    /// Independent ones need seeds that differ by a good mix (`batch_random`).
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

/// Mixes one more number into a key (splitmix64 of Steele et al. 2014).
[[nodiscard]] inline uint64_t mixed_key(uint64_t key, uint64_t number) {
    uint64_t z = (key ^ number) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// The random numbers of one of the batches of a key: independent of those of its other batches.
[[nodiscard]] inline Pcg batch_random(uint64_t key, uint64_t batch) {
    return {mixed_key(key, batch), batch};
}

}  // namespace tetralight
