// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// The lights whose direct term is not in the probes. Baked and real-time light together count each
// term exactly once:
//
//     for (const RuntimeLight& light : lights) {
//         if (!light.lights_moving) continue;
//         float visible = light.visibility(occlusion);   // shadows of static objects, from probes
//         visible *= shadow_map(light);  // shadows of moving objects; without a channel, of all
// direct += visible * direct_light(light.light, position, normal);
//     }

namespace tetralight {

/// A light that the runtime adds.
struct RuntimeLight {
    /// Its intensity includes the weight of its layer.
    Light light;
    /// Index among the lights of the volume.
    uint32_t index = 0;
    /// The channel of the probes' occlusion with the shadows of static objects on moving objects.
    /// kNoIndex: real-time shadows must include static objects too.
    uint32_t channel = kNoIndex;
    /// False for the mixed lights of a `Subtractive` bake other than the brightest sun: they light
    /// only static objects.
    bool lights_moving = true;

    /// Its visibility in interpolated occlusion; 1 without a channel.
    [[nodiscard]] float visibility(const glm::vec4& occlusion) const noexcept {
        return channel < 4 ? occlusion[static_cast<int>(channel)] : 1.0f;
    }

    bool operator==(const RuntimeLight&) const = default;
};

/// The volume's `Mixed` and `Realtime` lights, in its order.
[[nodiscard]] std::vector<RuntimeLight> runtime_lights(const ProbeVolumeView& volume);

/// Visibility of one light, interpolated only from the probes of a cell that store it. Unlike the
/// four channels it is correct between probes that use one channel for different lights. 1 if no
/// probe of the cell stores the light.
[[nodiscard]] float interpolate_visibility(const ProbeVolumeView& volume,
                                           const CellLocation& location,
                                           const RuntimeLight& light) noexcept;

}  // namespace tetralight
