// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/probes/light.h>
#include <tetralight/probes/mixed_lighting.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// The assignment of lights to the four occlusion channels of the probes.
struct OcclusionChannels {
    /// The channel of each light: 0 to 3, or kNoIndex.
    std::vector<uint32_t> of_light;
    /// True for each `Mixed` light that would have occlusion, but all four channels belong to
    /// lights whose volumes overlap its own. Such a light has to be baked fully.
    std::vector<bool> fell_back;

    bool operator==(const OcclusionChannels&) const = default;
};

/// Assigns each `Mixed` light that can have occlusion the first channel that no light with an
/// overlapping volume has. Directional lights come first, then lights by descending power, so that
/// the weakest of five overlapping lights gets no channel. Lights whose volumes do not overlap can
/// share a channel, so the number of lights is not limited.
///
/// The channel of a light depends only on the lights that are connected to it by a chain of
/// overlapping volumes. Precondition: one name per light.
[[nodiscard]] OcclusionChannels assign_channels(std::span<const Light> lights,
                                                std::span<const std::string> names,
                                                MixedLighting mode);

/// The light of each channel at a probe: among the lights with that channel, the one whose volume
/// contains the position or else is the nearest; kNoIndex if no light has the channel.
[[nodiscard]] OcclusionLights occlusion_lights_at(const glm::dvec3& position,
                                                  std::span<const Light> lights,
                                                  std::span<const uint32_t> channels);

}  // namespace tetralight
