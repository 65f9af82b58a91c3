// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/probes/rendering_layers.h>

namespace tetralight {

/// Probes that belong together: a room, a prefab, a generated lattice. Names are unique in a scene.
struct ProbeGroup {
    std::string name;
    glm::dmat4 world_from_group{1.0};
    /// Positions in the group's own space, metres.
    std::vector<glm::dvec3> positions;
    /// Remove ringing (negative irradiance) from this group's probes after the bake.
    bool dering = false;
    /// Bit i: the probes light objects on rendering layer i.
    uint32_t rendering_layers = kAllRenderingLayers;
    /// What a warning says if the group has no probes: its file and the reason. Empty: the name.
    std::string empty_warning{};

    bool operator==(const ProbeGroup&) const = default;
};

}  // namespace tetralight
