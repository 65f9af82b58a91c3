// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/geometric.hpp>
#include <numbers>

#include <tetralight/probes/no_index.h>
#include <tetralight/probes/probe_volume.h>
#include "tests/support/scenes.h"

namespace tetralight::test {

/// Gives a volume a mixed sun without occlusion, which lights what faces it with radiance 1.
inline void add_sun(ProbeVolume& volume, glm::vec3 direction) {
    Scene lights;
    add_sun(lights, LightMode::Mixed, glm::vec3(std::numbers::pi_v<float>)).direction =
        glm::normalize(direction);
    volume.lights = lights.lights;
    volume.light_names = "sun\n";
    volume.light_states = {{MixedLighting::Indirect, kNoIndex, kNoIndex, 0}};
}

}  // namespace tetralight::test
