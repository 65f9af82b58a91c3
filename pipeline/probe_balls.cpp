// SPDX-License-Identifier: Apache-2.0
#include "pipeline/probe_balls.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace tetralight {

Result<ProbeBalls> ProbeBalls::make(const ProbeVolumeView& volume, float radius) {
    ProbeBalls balls(volume);
    std::vector<glm::vec4> spheres;
    for (const glm::vec3& position : volume.positions) spheres.emplace_back(position, radius);
    balls.caster_.add_spheres(spheres);
    if (auto status = balls.caster_.commit(); !status) return status.error();
    return balls;
}

Result<ProbeBalls> ProbeBalls::make(std::span<const Lppv> volumes, float radius) {
    ProbeBalls balls(ProbeVolumeView{});
    std::vector<glm::vec4> spheres;
    for (const Lppv& lppv : volumes) {
        const glm::uvec3 size = lppv.grid.resolution;
        for (uint32_t i = 0; i < lppv.irradiance.size(); ++i) {
            const glm::uvec3 point(i % size.x, i / size.x % size.y, i / size.x / size.y);
            spheres.emplace_back(glm::vec3(lppv.grid.world_position(point)), radius);
        }
        balls.own_light_.insert(balls.own_light_.end(), lppv.irradiance.begin(),
                                lppv.irradiance.end());
    }
    balls.volume_.irradiance = balls.own_light_;
    balls.caster_.add_spheres(spheres);
    if (auto status = balls.caster_.commit(); !status) return status.error();
    return balls;
}

std::optional<ProbeBalls::Ball> ProbeBalls::find(const glm::dvec3& origin,
                                                 glm::vec3 direction) const {
    const auto hit = caster_.cast({glm::vec3(origin - volume_.info.world_origin), direction});
    if (!hit) return std::nullopt;
    return Ball{hit->primitive, hit->distance, glm::normalize(hit->normal)};
}

std::optional<SceneShader::Shaded> ProbeBalls::shade(const glm::dvec3& origin,
                                                     glm::vec3 direction) const {
    const auto ball = find(origin, direction);
    if (!ball) return std::nullopt;
    const IrradianceSh& light = ball->probe < volume_.irradiance.size()
                                    ? volume_.irradiance[ball->probe]
                                    : volume_.info.ambient;
    const glm::vec3 irradiance = evaluate_irradiance(light, ball->normal);
    return SceneShader::Shaded{glm::max(irradiance, glm::vec3(0.0f)) / std::numbers::pi_v<float>,
                               ball->distance};
}

}  // namespace tetralight
