// SPDX-License-Identifier: Apache-2.0
#include "pipeline/mesh_ball.h"

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "bake/ray_caster.h"
#include "bake/sampling.h"
#include "probes/packed_sh.h"
#include "runtime/pack_instances.h"
#include "runtime/runtime_lights.h"
#include "runtime/shade.h"

namespace tetralight {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Fully saturated to pale: h, s in [0, 1), value 0.9.
glm::vec3 color_from_hue(float hue, float saturation) {
    glm::vec3 color;
    for (int i = 0; i < 3; ++i) {
        const float wave =
            std::cos(2.0f * std::numbers::pi_v<float> * (hue - static_cast<float>(i) / 3.0f));
        color[i] = 0.9f * (1.0f - saturation * (0.5f - 0.5f * wave));
    }
    return color;
}

/// The spheres with their light, ready for rays. Space: relative to the first sphere.
class LitBall {
  public:
    LitBall(std::span<const BallInstance> instances, const SceneShader* scene,
            const ProbeVolumeView& volume)
        : instances_(instances), scene_(scene) {
        if (!instances.empty()) origin_ = instances[0].center;
        for (const RuntimeLight& light : runtime_lights(volume)) {
            if (light.lights_moving) direct_lights_.push_back(light);
        }
    }

    Status build() {
        std::vector<glm::vec4> spheres;
        for (const BallInstance& instance : instances_) {
            spheres.emplace_back(glm::vec3(instance.center - origin_), instance.radius);
        }
        caster_.add_spheres(spheres);
        return caster_.commit();
    }

    /// One batch call for all instances.
    Status fetch_light(const ProbeVolumeView& volume, MeshBallPicture& picture) {
        std::vector<glm::vec3> positions;
        for (const BallInstance& instance : instances_) {
            positions.emplace_back(instance.center);
        }
        light_.resize(positions.size());
        occlusion_.resize(positions.size());
        const auto start = std::chrono::steady_clock::now();
        const auto report = pack_instances(
            volume, {.positions = positions, .packed = light_, .occlusion = occlusion_});
        picture.query_seconds = seconds_since(start);
        if (!report) return report.error();
        return Ok{};
    }

    [[nodiscard]] std::optional<SceneShader::Shaded> shade(const glm::dvec3& origin,
                                                           glm::vec3 direction) const {
        const Ray ray{glm::vec3(origin - origin_), direction};
        const auto hit = caster_.cast(ray);
        if (!hit) return std::nullopt;
        const BallInstance& instance = instances_[hit->primitive];
        const glm::vec3 normal = glm::normalize(hit->normal);
        const glm::dvec3 surface =
            instance.center + glm::dvec3(normal) * (instance.radius * (1.0 + 1e-4));
        const glm::vec3 radiance = shade_diffuse(instance.albedo, light_[hit->primitive], normal,
                                                 direct_term(surface, normal, hit->primitive));
        return SceneShader::Shaded{radiance, hit->distance};
    }

    [[nodiscard]] bool is_blocked(const glm::dvec3& origin, glm::vec3 direction,
                                  float distance) const {
        return caster_.is_blocked({glm::vec3(origin - origin_), direction, distance});
    }

  private:
    /// Shadows of the scene come from the probes where they hold those of a light, else from rays;
    /// those of spheres and of what moves in the scene from rays.
    [[nodiscard]] glm::vec3 direct_term(const glm::dvec3& position, glm::vec3 normal,
                                        uint32_t sphere) const {
        glm::vec3 sum(0.0f);
        for (const RuntimeLight& runtime : direct_lights_) {
            const glm::vec3 direct = direct_light(runtime.light, glm::vec3(position), normal) *
                                     runtime.visibility(occlusion_[sphere]);
            if (direct == glm::vec3(0.0f)) continue;
            const Illumination arriving = illuminate(runtime.light, glm::vec3(position));
            const auto casters = runtime.channel == kNoIndex ? SceneShader::Casters::All
                                                             : SceneShader::Casters::Moving;
            const bool is_shadowed =
                is_blocked(position, arriving.to_light, arriving.distance) ||
                (scene_ != nullptr &&
                 scene_->is_blocked(position, arriving.to_light, arriving.distance, casters));
            if (!is_shadowed) sum += direct;
        }
        return sum;
    }

    std::span<const BallInstance> instances_;
    const SceneShader* scene_;
    glm::dvec3 origin_{0.0};
    std::vector<RuntimeLight> direct_lights_;
    RayCaster caster_;
    std::vector<PackedSh> light_;
    std::vector<glm::vec4> occlusion_;
};

}  // namespace

std::vector<BallInstance> make_mesh_ball(const MeshBallSettings& settings) {
    std::vector<BallInstance> instances;
    for (uint32_t i = 0; i < settings.instance_count; ++i) {
        RandomStream random(settings.seed, i);
        const double height = 2.0 * random.next() - 1.0;
        const double angle = 2.0 * std::numbers::pi * random.next();
        const double ring = std::sqrt(1.0 - height * height);
        const double distance = settings.radius * std::cbrt(random.next());
        const glm::dvec3 direction(ring * std::cos(angle), height, ring * std::sin(angle));
        const double size = settings.instance_size * (0.5 + random.next());
        const float hue = random.next();
        instances.push_back({settings.center + distance * direction, settings.radius * size,
                             color_from_hue(hue, 0.1f + 0.4f * random.next())});
    }
    return instances;
}

Result<MeshBallPicture> render_mesh_ball(std::span<const BallInstance> instances,
                                         const SceneShader* scene, const ProbeVolumeView& volume,
                                         const Camera& camera, const RenderSettings& settings) {
    MeshBallPicture picture;
    LitBall ball(instances, scene, volume);
    if (auto status = ball.build(); !status) return status.error();
    if (auto status = ball.fetch_light(volume, picture); !status) return status.error();

    picture.image =
        render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            const auto sphere = ball.shade(origin, direction);
            const auto behind = scene != nullptr ? scene->shade(origin, direction) : std::nullopt;
            if (sphere && (!behind || sphere->distance < behind->distance)) return sphere->radiance;
            return behind ? behind->radiance : sky_radiance(volume, direction);
        });
    return picture;
}

}  // namespace tetralight
