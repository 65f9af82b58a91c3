// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace tetralight::detail {

/// Puts vertices into rounds, each a random quarter of the vertices of the next, and keeps their
/// order within a round: "biased randomized insertion order" (Amenta, Choi and Rote, "Incremental
/// constructions con BRIO", 2003). `spare` is as long as `vertices`.
void order_by_rounds(std::span<uint32_t> vertices, std::span<uint32_t> spare);

}  // namespace tetralight::detail
