// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/pipeline/place_range.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Light of probes that is copied from the volume of an earlier bake, as the end of that bake left
/// it. Arrays have one element for each of `probes`; those that the volume does not have are empty.
struct ReusedLight {
    /// Indices in the new volume.
    std::vector<uint32_t> probes;
    std::vector<float> standard_error;
    std::vector<float> validity;
    std::vector<IrradianceSh> irradiance;
    std::vector<glm::vec4> occlusion;
    std::vector<ProbeTransfer> transfer;
    /// All layers of the first probe, then of the next.
    std::vector<IrradianceSh> layer_irradiance;
    std::vector<float> layer_errors;  ///< in the same order

    /// One for each probe of a volume: true if its light is reused.
    [[nodiscard]] std::vector<bool> flags(size_t probe_count) const;

    /// That of the probes of a range.
    [[nodiscard]] ReusedLight in_range(const PlaceRange& range) const;

    /// Appends the light of other probes.
    void append(const ReusedLight& other);

    bool operator==(const ReusedLight&) const = default;
};

/// Calls `visit(name, array, count)` for each array of values: the name of its section in a part,
/// and the number of values that a probe of the volume has.
template <class Light, class Visit>
void for_each_array(Light& light, const ProbeVolume& volume, Visit visit) {
    visit("reused_errors", light.standard_error, size_t{1});
    visit("reused_validity", light.validity, size_t{1});
    visit("reused_irradiance", light.irradiance, size_t{1});
    visit("reused_occlusion", light.occlusion, size_t{volume.occlusion_lights.empty() ? 0u : 1u});
    visit("reused_transfer", light.transfer, size_t{volume.sky.empty() ? 0u : 1u});
    visit("reused_layers", light.layer_irradiance, volume.layers.size());
    visit("reused_layer_errors", light.layer_errors, volume.layers.size());
}

/// The light of probes of `old`. `old_probes` has one element for each probe of the new volume: the
/// index of the same probe in `old`, or kNoIndex.
[[nodiscard]] ReusedLight reused_light(const ProbeVolumeView& old,
                                       std::span<const uint32_t> old_probes);

/// Writes reused light over the light of a volume. It is final: steps that change light of single
/// probes (adjustments, dering) are done before, and this is called again after them.
void copy_reused(const ReusedLight& light, ProbeVolume& volume);

/// Writes the reused standard errors.
void copy_reused(const ReusedLight& light, BakedProbes& baked);

}  // namespace tetralight
