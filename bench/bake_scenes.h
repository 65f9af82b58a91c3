// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "bake/scene/scene.h"
#include "bench/harness.h"

namespace tetralight::bench {

/// A scene and where its light is measured.
struct BakeSubject {
    std::string name;
    Scene scene;
    std::vector<glm::dvec3> probes;
};

/// The courtyard with its own probes, the scene of the options, and a room with 10 000 emitters.
[[nodiscard]] std::vector<BakeSubject> bake_subjects(const Options& options);

/// A grey room of 20 × 6 × 20 m, with 10 000 emitters of 2 × 2 cm that hang in it, each of its own
/// colour and strength.
[[nodiscard]] Scene emitter_room();

}  // namespace tetralight::bench
