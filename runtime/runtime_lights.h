// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// The lights whose direct term is not in the probes, so that baked and real-time light count each
// term exactly once:
//
//     for (const RuntimeLight& light : lights) {
//         if (!light.lights_moving) continue;
//         float visible = light.visibility(occlusion);   // of static things, from the probes
//         visible *= shadow_map(light);                   // of moving things; of all without
//         channel direct += visible * direct_light(light.light, position, normal);
//     }

namespace tetralight {

/// A light that the runtime adds.
struct RuntimeLight {
    /// Dimmed by the weight of its layer.
    Light light;
    /// Among the volume's lights.
    uint32_t index = 0;
    /// The channel of the probes' occlusion that holds the shadows of static things on moving ones;
    /// kNoIndex: real-time shadows have to be of static things too.
    uint32_t channel = kNoIndex;
    /// False: in `Subtractive` bakes mixed lights other than the brightest sun light what stands
    /// still alone.
    bool lights_moving = true;

    /// What interpolated occlusion says of it; 1 without a channel.
    [[nodiscard]] float visibility(const glm::vec4& occlusion) const noexcept {
        return channel < 4 ? occlusion[static_cast<int>(channel)] : 1.0f;
    }

    bool operator==(const RuntimeLight&) const = default;
};

/// The volume's `Mixed` and `Realtime` lights, in its order.
[[nodiscard]] std::vector<RuntimeLight> runtime_lights(const ProbeVolumeView& volume);

/// Visibility of one light from the probes of a cell that keep it: what four channels say, but
/// right too where lights that share a channel meet. 1 where no probe of the cell keeps it.
[[nodiscard]] float interpolate_visibility(const ProbeVolumeView& volume,
                                           const CellLocation& location,
                                           const RuntimeLight& light) noexcept;

}  // namespace tetralight
