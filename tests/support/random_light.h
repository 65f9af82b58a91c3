// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include <tetralight/probes/sh.h>
#include "tests/support/random_probes.h"

namespace tetralight::test {

/// Directions that come within 0.01 of each direction.
inline std::vector<glm::vec3> dense_directions() {
    std::vector<glm::vec3> directions;
    constexpr int kCount = 40'000;
    const double golden = 2.399963229728653;
    for (int i = 0; i < kCount; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kCount, radius = std::sqrt(1.0 - z * z);
        directions.emplace_back(radius * std::cos(golden * i), radius * std::sin(golden * i), z);
    }
    return directions;
}

/// A few distant lights of any colour over a faint sky: what rings.
inline IrradianceSh ringing_light(std::mt19937_64& engine) {
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    RadianceSh radiance = constant_radiance(glm::vec3(0.02f * value(engine)));
    const int count = 1 + static_cast<int>(engine() % 3);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 color(value(engine), value(engine), value(engine));
        radiance += radiance_from_directional_light(random_direction(engine), color);
    }
    return irradiance_from_radiance(radiance);
}

/// Any coefficients at all, as no light has them.
inline IrradianceSh arbitrary_irradiance(std::mt19937_64& engine) {
    std::uniform_real_distribution<float> value(-1.0f, 1.0f);
    IrradianceSh sh;
    for (glm::vec3& c : sh.coefficients) c = {value(engine), value(engine), value(engine)};
    return sh;
}

}  // namespace tetralight::test
