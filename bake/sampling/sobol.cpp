// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/sampling/sobol.h>

#include <tetralight/bake/sampling/mix.h>

namespace tetralight {
namespace {

uint32_t reverse_bits(uint32_t x) {
    x = __builtin_bswap32(x);
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    return (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
}

/// A permutation in which each bit depends on itself and lower bits only: on bit-reversed numbers,
/// an Owen scramble (Laine & Karras 2011; these constants by Vegdahl 2021, "Building a Better LK
/// Hash").
uint32_t permute_upwards(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Digits of the second Sobol dimension, least significant bit first. Its matrix is Pascal's
/// triangle modulo 2: binomial(k, j) is odd where the bits of j are among those of k (Lucas), so
/// that the product is a sum over supersets.
uint32_t second_dimension(uint32_t index) {
    uint32_t y = index;
    y ^= y >> 1 & 0x55555555u;
    y ^= y >> 2 & 0x33333333u;
    y ^= y >> 4 & 0x0f0f0f0fu;
    y ^= y >> 8 & 0x00ff00ffu;
    y ^= y >> 16 & 0x0000ffffu;
    return y;
}

/// Bits, least significant digit first, as a number in [0, 1).
float unit_float(uint32_t digits) {
    return static_cast<float>(reverse_bits(digits) >> 8) * 0x1p-24f;
}

float first_of_pair(uint32_t index, uint64_t seed) {
    return unit_float(permute_upwards(index, static_cast<uint32_t>(seed)));
}

}  // namespace

glm::vec2 owen_sobol2(uint32_t index, uint64_t seed) noexcept {
    return {
        first_of_pair(index, seed),
        unit_float(permute_upwards(second_dimension(index), static_cast<uint32_t>(seed >> 32)))};
}

Sampler::Sampler(uint64_t key, uint32_t path) noexcept
    : key_(key), reversed_path_(reverse_bits(path)) {}

void Sampler::skip() noexcept {
    key_ += detail::kGoldenRatio64;
}

Sampler Sampler::branch() const noexcept {
    Sampler other = *this;
    other.key_ = detail::mix(~key_);
    return other;
}

Sampler::Pair Sampler::next_pair() noexcept {
    skip();
    const uint64_t order = detail::mix(key_);
    const uint64_t seed = detail::mix(order);
    // An Owen scramble of the index maps aligned blocks to aligned blocks, so that the first paths
    // are as well distributed as all of them.
    return {reverse_bits(permute_upwards(reversed_path_, static_cast<uint32_t>(order))), seed};
}

glm::vec2 Sampler::next2() noexcept {
    const Pair pair = next_pair();
    return owen_sobol2(pair.index, pair.seed);
}

float Sampler::next() noexcept {
    const Pair pair = next_pair();
    return first_of_pair(pair.index, pair.seed);
}

double Sampler::next_double() noexcept {
    const glm::vec2 u = next2();
    return static_cast<double>(u.x) + static_cast<double>(u.y) * 0x1p-24;
}

}  // namespace tetralight
