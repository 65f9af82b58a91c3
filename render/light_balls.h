// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/sh.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {

/// A white, diffuse ball lit by given light, for example by that of a probe.
struct LightBall {
    glm::dvec3 center{0.0};
    float radius = 0.0f;
    IrradianceSh light;
};

/// Balls that rays can hit.
class LightBalls {
  public:
    /// Returns out_of_resources if memory is short.
    [[nodiscard]] static Result<LightBalls> make(std::span<const LightBall> balls);

    struct Hit {
        uint32_t ball = 0;
        float distance = 0.0f;
        glm::vec3 normal{0.0f};
    };

    /// The first ball that a ray from a world position in a unit direction hits.
    [[nodiscard]] std::optional<Hit> find(const glm::dvec3& origin, glm::vec3 direction) const;

    /// Radiance and distance of the first ball that a ray hits; empty if it hits none.
    [[nodiscard]] std::optional<SceneShader::Shaded> shade(const glm::dvec3& origin,
                                                           glm::vec3 direction) const;

  private:
    explicit LightBalls(std::span<const LightBall> balls) : balls_(balls.begin(), balls.end()) {}

    std::vector<LightBall> balls_;
    RayCaster caster_;  // relative to the first ball
};

}  // namespace tetralight
