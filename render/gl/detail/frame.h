// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec4.hpp>

#include <tetralight/probes/packed_sh.h>

namespace tetralight::detail {

/// The uniform block `Frame` of the shaders (std140).
struct Frame {
    glm::vec4 eye;    ///< position in render space
    glm::vec4 right;  ///< length: half the width of the picture at distance 1
    glm::vec4 up;     ///< length: half the height of the picture at distance 1
    glm::vec4 ahead;
    /// Lights; reflection probes; 1 = box projection; levels of the cubes - 1.
    glm::uvec4 counts;
    glm::vec4 shadow_color;  ///< `SceneLight::shadow_color`
    PackedSh sky;
};

static_assert(sizeof(Frame) == 96 + sizeof(PackedSh));

}  // namespace tetralight::detail
