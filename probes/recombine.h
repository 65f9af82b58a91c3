// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

// Light that can change after the bake. A volume with layers keeps the light of each (the sun, the
// sky, a lamp, a material); queries read their weighted sum, which is rewritten in place:
//
//     const auto weights = layer_weights(volume.view(), {{"lamp", 0.0f}, {"neon", 2.0f}});
//     if (!weights) return weights.error();
//     auto status = recombine(volume, *weights);
//
// To spread it over frames while others read: probes/live_light.h.

namespace tetralight {

/// A layer by its name, or by the part after its colon: "lamp" for "light:lamp".
struct LayerWeight {
    std::string_view name;
    float weight = 1.0f;
};

/// Weights of layers with some of them replaced: of volumes, lightmaps and reflection probes.
/// `layer_names` has one name a line, `weights` one weight a name. Returns not_found if no layer
/// has a name (the message lists the layers), and invalid_argument if several have it or a weight
/// is negative or not finite.
[[nodiscard]] Result<std::vector<float>> changed_weights(std::string_view layer_names,
                                                         std::vector<float> weights,
                                                         std::span<const LayerWeight> changes);

/// The weights that the volume's light has now.
[[nodiscard]] std::vector<float> layer_weights(const ProbeVolumeView& volume);

/// The same with some of them replaced. Returns the errors of `changed_weights`.
[[nodiscard]] Result<std::vector<float>> layer_weights(const ProbeVolumeView& volume,
                                                       std::span<const LayerWeight> changes);

/// The index of a layer by its full name; kNoIndex if there is no such layer.
[[nodiscard]] uint32_t find_layer(const ProbeVolumeView& volume, std::string_view name) noexcept;

/// The current weight of a light: that of its layer, or 1 without a layer. A runtime multiplies the
/// direct term of a `Mixed` light by it.
[[nodiscard]] float light_weight(const ProbeVolumeView& volume, size_t light) noexcept;

/// Values of the whole volume that follow from the weights.
struct RecombinedInfo {
    /// Scale of compact probes: from the bound Σ w_k · largest_k, so that it is known beforehand.
    float compact_scale = 0.0f;
    IrradianceSh ambient;

    bool operator==(const RecombinedInfo&) const = default;
};

/// Returns invalid_argument if the volume has no layers, if there is not one weight a layer, or if
/// a weight is negative, not finite, or so large that the light would not be finite.
[[nodiscard]] Result<RecombinedInfo> check_weights(const ProbeVolumeView& volume,
                                                   std::span<const float> weights);

/// Probes [begin, end) of the sum, into spans that begin with probe `begin`. Either may be empty.
/// Only the irradiance of compact probes is written. Precondition: `check_weights`, whose scale it
/// takes; the layers hold all probes.
void recombine_probes(const ProbeVolumeView& volume, std::span<const float> weights, size_t begin,
                      size_t end, std::span<IrradianceSh> irradiance,
                      std::span<CompactProbe> compact, float compact_scale) noexcept;

/// Probes of one task of a parallel recombination.
inline constexpr size_t kRecombineTaskSize = 4096;

/// Rewrites the volume's light as Σ w_k · layer_k, added in the order of the layers: irradiance,
/// compact probes if there are any, ambient light, and the weights that the layers record.
/// If no layer is negative anywhere, neither is the sum. The same bits for any tasks. Returns the
/// errors of `check_weights`, and corrupt if a section of light has another number of elements than
/// there are probes.
///
/// `parallel_for(count, task)` calls task(0) .. task(count − 1) in any order, on any threads, and
/// returns when all are done.
template <class ParallelFor>
[[nodiscard]] Status recombine(ProbeVolume& volume, std::span<const float> weights,
                               ParallelFor&& parallel_for);

[[nodiscard]] Status recombine(ProbeVolume& volume, std::span<const float> weights);

/// The number of probes whose irradiance is not the weighted sum of their layers, beyond rounding.
/// 0 if the volume holds no layers or no irradiance. Precondition: `verify`.
[[nodiscard]] uint32_t count_wrong_sums(const ProbeVolumeView& volume) noexcept;

namespace detail {

/// Returns corrupt if the volume holds irradiance or compact probes of another number than probes.
[[nodiscard]] Status check_light_sizes(const ProbeVolumeView& volume);

/// Records weights and what follows from them.
void store_weights(ProbeVolume& volume, std::span<const float> weights,
                   const RecombinedInfo& info) noexcept;

/// One task of `recombine`.
void recombine_task(ProbeVolume& volume, std::span<const float> weights, size_t task) noexcept;

}  // namespace detail

template <class ParallelFor>
Status recombine(ProbeVolume& volume, std::span<const float> weights, ParallelFor&& parallel_for) {
    if (auto status = detail::check_light_sizes(volume.view()); !status) return status;
    const auto info = check_weights(volume.view(), weights);
    if (!info) return info.error();
    detail::store_weights(volume, weights, *info);
    const size_t count = (volume.positions.size() + kRecombineTaskSize - 1) / kRecombineTaskSize;
    parallel_for(count, [&](size_t task) { detail::recombine_task(volume, weights, task); });
    return Ok{};
}

}  // namespace tetralight
