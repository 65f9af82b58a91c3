// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/delaunay/detail/insertion_order.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>

namespace tetralight::detail {
namespace {

constexpr uint32_t kRounds = 12;

/// A random number that depends on `i` alone.
uint32_t hash(uint32_t i) {
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}

uint32_t round_of(uint32_t i) {
    const auto quarters = static_cast<uint32_t>(std::countr_zero(hash(i))) / 2;
    return kRounds - 1 - std::min(quarters, kRounds - 1);
}

}  // namespace

void order_by_rounds(std::span<uint32_t> vertices, std::span<uint32_t> spare) {
    std::array<size_t, kRounds + 1> begins{};
    for (uint32_t i = 0; i < vertices.size(); ++i) ++begins[round_of(i) + 1];
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    for (uint32_t i = 0; i < vertices.size(); ++i) spare[begins[round_of(i)]++] = vertices[i];
    std::copy(spare.begin(), spare.end(), vertices.begin());
}

}  // namespace tetralight::detail
