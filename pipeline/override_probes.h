// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <type_traits>
#include <vector>

#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/probes/probe_volume.h>

// Changes that adjustment volumes make to baked probes.

namespace tetralight {

struct ProbeOverride {
    /// Factor on the probe's light.
    float intensity = 1.0f;
    /// The probe's validity; negative: as it was baked.
    float validity = -1.0f;

    bool operator==(const ProbeOverride&) const = default;
};

static_assert(sizeof(ProbeOverride) == 8 && std::is_trivially_copyable_v<ProbeOverride>);

/// One for each position; empty if the adjustment volumes change none of them.
[[nodiscard]] std::vector<ProbeOverride> find_overrides(
    std::span<const ProbeAdjustment> adjustments, std::span<const glm::dvec3> positions);

/// Sets the rendering layers of the probes that adjustment volumes give others than their groups.
void override_rendering_layers(std::span<const ProbeAdjustment> adjustments, ProbeVolume& volume);

/// Changes the light (with layers and transfer) and the validity of a baked volume. Precondition:
/// one override for each probe, or none.
void override_probes(std::span<const ProbeOverride> overrides, ProbeVolume& volume);

}  // namespace tetralight
