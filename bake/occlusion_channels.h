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

/// Which of the four occlusion channels of the probes is whose.
struct OcclusionChannels {
    /// One a light: 0 to 3, or kNoIndex.
    std::vector<uint32_t> of_light;
    /// One a light: it is `Mixed` and would have occlusion, but lights around it have all four
    /// channels. It has to be baked fully.
    std::vector<bool> fell_back;

    bool operator==(const OcclusionChannels&) const = default;
};

/// Gives each `Mixed` light that can have occlusion the first channel that no light has whose
/// volume overlaps its own: suns first, then by power, so that the weakest of five goes without.
/// Lights whose volumes do not touch share channels, however many there are.
///
/// What a light gets depends on the lights that it is joined to by overlaps and on nothing else:
/// others may come, go and change. Precondition: as many names as lights.
[[nodiscard]] OcclusionChannels assign_channels(std::span<const Light> lights,
                                                std::span<const std::string> names,
                                                MixedLighting mode);

/// Whose visibility a probe keeps in each channel: of the lights that have the channel that whose
/// volume the position lies in, or else is nearest to.
[[nodiscard]] OcclusionLights occlusion_lights_at(const glm::dvec3& position,
                                                  std::span<const Light> lights,
                                                  std::span<const uint32_t> channels);

}  // namespace tetralight
