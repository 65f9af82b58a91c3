// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Quantiles of relative standard errors over probes. All 0 if the error of no probe is known.
struct NoiseStatistics {
    uint32_t probe_count = 0;  ///< probes that count and whose error is known
    float median = 0.0f;
    float p99 = 0.0f;  ///< 99th percentile
    float worst = 0.0f;

    bool operator==(const NoiseStatistics&) const = default;
};

/// The errors of each layer, over the probes that it lights to a hundredth of its mean light or
/// more. One element a layer; empty if the volume does not know the errors of its layers.
/// Precondition: `verify`.
[[nodiscard]] std::vector<NoiseStatistics> layer_noise(const ProbeVolumeView& volume);

/// Relative standard error of a probe's light with the weights that the layers have now, from the
/// errors of the layers, which are taken to be independent:
///
///     √( Σ_k w_k² σ_k² |E_k|² ) / |Σ_k w_k E_k|
///
/// with |E|² = Σ_i E_i². If all weights are 1, or if the errors of the layers are not known, the
/// standard error of the bake. 0: not known. Layers share paths, so that the error of a sum of
/// several layers may be half as large again.
[[nodiscard]] float relit_error(const ProbeVolumeView& volume, uint32_t probe) noexcept;

/// The same for all probes.
[[nodiscard]] NoiseStatistics relit_noise(const ProbeVolumeView& volume);

}  // namespace tetralight
