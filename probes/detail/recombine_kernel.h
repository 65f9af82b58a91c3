// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tetralight::detail {

/// Σ_k w_k · layer_k over `count` floats, added in the order of k, in floats and in halves.
struct RecombineBlock {
    /// Of layer 0; that of layer k is k · `layer_stride` floats behind it.
    const float* layers = nullptr;
    size_t layer_stride = 0;
    std::span<const float> weights;
    size_t count = 0;
    float* sums = nullptr;
    /// Sums times `half_factor`; null: not asked for.
    uint16_t* halves = nullptr;
    float half_factor = 1.0f;
};

/// The scalar twin.
void recombine_floats(const RecombineBlock& block) noexcept;

#ifdef TETRALIGHT_HAS_HIGHWAY
/// The same bits by vector code.
void recombine_floats_in_vectors(const RecombineBlock& block) noexcept;
#endif

/// The fastest of this machine.
inline void recombine_fast(const RecombineBlock& block) noexcept {
#ifdef TETRALIGHT_HAS_HIGHWAY
    recombine_floats_in_vectors(block);
#else
    recombine_floats(block);
#endif
}

}  // namespace tetralight::detail
