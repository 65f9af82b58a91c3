// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec4.hpp>

#include <tetralight/probes/packed_sh.h>

namespace tetralight::detail {

/// The uniform block `Frame` of the shaders (std140).
struct Frame {
    /// Position of the eye in render space, w = 1. Orthographic cameras: unit vector to the eye,
    /// w = 0.
    glm::vec4 eye;
    glm::vec4 right;  ///< length: what half the picture's width grows by per metre of depth
    glm::vec4 up;     ///< length: what half the picture's height grows by per metre of depth
    glm::vec4 ahead;
    /// Lights; reflection probes; 1 = box projection; levels of the cubes - 1.
    glm::uvec4 counts;
    glm::vec4 shadow_color;  ///< `SceneLight::shadow_color`
    PackedSh sky;
};

static_assert(sizeof(Frame) == 96 + sizeof(PackedSh));

}  // namespace tetralight::detail
