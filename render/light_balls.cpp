// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/light_balls.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace tetralight {

Result<LightBalls> LightBalls::make(std::span<const LightBall> balls) {
    LightBalls result(balls);
    std::vector<glm::vec4> spheres;
    for (const LightBall& ball : balls) {
        spheres.emplace_back(glm::vec3(ball.center - balls[0].center), ball.radius);
    }
    result.caster_.add_spheres(spheres);
    if (auto status = result.caster_.commit(); !status) return status.error();
    return result;
}

std::optional<LightBalls::Hit> LightBalls::find(const glm::dvec3& origin,
                                                glm::vec3 direction) const {
    if (balls_.empty()) return std::nullopt;
    const auto hit = caster_.intersect({glm::vec3(origin - balls_[0].center), direction});
    if (!hit) return std::nullopt;
    return Hit{hit->primitive, hit->distance, glm::normalize(hit->normal)};
}

std::optional<SceneShader::Shaded> LightBalls::shade(const glm::dvec3& origin,
                                                     glm::vec3 direction) const {
    const auto hit = find(origin, direction);
    if (!hit) return std::nullopt;
    const glm::vec3 irradiance = evaluate_irradiance(balls_[hit->ball].light, hit->normal);
    return SceneShader::Shaded{glm::max(irradiance, glm::vec3(0.0f)) / std::numbers::pi_v<float>,
                               hit->distance};
}

}  // namespace tetralight
