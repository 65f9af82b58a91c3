// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/mesh_ball.h>

#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/runtime/pack_instances.h>
#include <tetralight/runtime/probe_shading.h>
#include <tetralight/runtime/runtime_lights.h>
#include <tetralight/runtime/shade.h>

namespace tetralight {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// An RGB colour of value 0.9 from hue and saturation in [0, 1).
glm::vec3 color_from_hue(float hue, float saturation) {
    glm::vec3 color;
    for (int i = 0; i < 3; ++i) {
        const float wave =
            std::cos(2.0f * std::numbers::pi_v<float> * (hue - static_cast<float>(i) / 3.0f));
        color[i] = 0.9f * (1.0f - saturation * (0.5f - 0.5f * wave));
    }
    return color;
}

/// The spheres with their light, as an Embree scene relative to the first sphere.
class LitBall {
  public:
    LitBall(std::span<const BallInstance> instances, const BallLighting& lighting,
            const SceneShader* scene, const ProbeVolumeView& volume)
        : instances_(instances), lighting_(lighting), scene_(scene) {
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

    /// Queries the light of all instances in one batch.
    Status fetch_light(const ProbeVolumeView& volume, MeshBallPicture& picture) {
        std::vector<glm::vec3> positions;
        for (const BallInstance& instance : instances_) {
            positions.emplace_back(instance.center);
        }
        light_.assign(positions.size(), PackedSh{});
        occlusion_.assign(positions.size(), glm::vec4(1.0f));
        if (lighting_.light != BallLight::Probes) return Ok{};
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
        const auto hit = caster_.intersect(ray);
        if (!hit) return std::nullopt;
        const BallInstance& instance = instances_[hit->primitive];
        const glm::vec3 normal = glm::normalize(hit->normal);
        const Point point{instance.center + glm::dvec3(normal) * (instance.radius * (1.0 + 1e-4)),
                          normal, -direction};
        return SceneShader::Shaded{radiance(point, hit->primitive), hit->distance};
    }

    [[nodiscard]] bool occluded(const glm::dvec3& origin, glm::vec3 direction,
                                float distance) const {
        return caster_.occluded({glm::vec3(origin - origin_), direction, distance});
    }

  private:
    struct Point {
        glm::dvec3 position{0.0};
        glm::vec3 normal{0.0f};
        glm::vec3 to_eye{0.0f};
    };

    [[nodiscard]] glm::vec3 radiance(const Point& point, uint32_t sphere) const {
        const BallInstance& instance = instances_[sphere];
        const float roughness = 1.0f - instance.smoothness;
        const glm::vec3 f0 = glm::mix(glm::vec3(0.04f), instance.color, instance.metallic);
        const bool mirrors = lighting_.mirror != nullptr && lighting_.mirror->has_probes();
        const glm::vec3 albedo =
            mirrors ? instance.color * (0.96f * (1.0f - instance.metallic))
                    : diffuse_reflectivity(instance.color, instance.metallic, roughness);
        PackedSh light = light_[sphere];
        glm::vec4 occlusion = occlusion_[sphere];
        if (lighting_.light == BallLight::ProxyVolume) {
            const InterpolatedProbe sampled =
                sample_lppv(*lighting_.proxy, glm::vec3(point.position));
            light = pack_sh(sampled.irradiance);
            occlusion = sampled.occlusion;
        }
        const auto specular = [&](glm::vec3 to_light, glm::vec3 irradiance) {
            if (lighting_.specular == Specular::Off) return glm::vec3(0.0f);
            return irradiance *
                   specular_reflection(point.normal, to_light, point.to_eye, f0, roughness);
        };
        glm::vec3 sum = shade_diffuse(albedo, light, point.normal, glm::vec3(0.0f));
        if (mirrors) {
            const glm::vec3 baked =
                shade_diffuse(glm::vec3(1.0f), light, point.normal, glm::vec3(0.0f));
            sum += lighting_.mirror->radiance(
                {point.position, point.normal, point.to_eye, f0, roughness}, baked);
        } else {
            const glm::vec3 dominant = dominant_direction(light);
            sum += specular(dominant, dominant_irradiance(light, dominant));
        }
        for (const RuntimeLight& runtime : direct_lights_) {
            const Illumination arriving = illuminate(runtime.light, glm::vec3(point.position));
            const float visible = visibility(runtime, arriving, occlusion, point);
            if (visible == 0.0f) continue;
            sum += visible * (albedo * direct_light(arriving, point.normal) +
                              specular(arriving.to_light, arriving.irradiance));
        }
        return sum;
    }

    /// The visible fraction of a light. The static scene's shadow comes from the probes if they
    /// store the occlusion of the light; all other shadows are traced.
    [[nodiscard]] float visibility(const RuntimeLight& runtime, const Illumination& arriving,
                                   const glm::vec4& occlusion, const Point& point) const {
        const float visible = runtime.visibility(occlusion);
        const bool is_lit = glm::dot(point.normal, arriving.to_light) > 0.0f &&
                            arriving.irradiance != glm::vec3(0.0f);
        if (visible == 0.0f || !is_lit) return 0.0f;
        const auto casters =
            runtime.channel == kNoIndex ? SceneShader::Casters::All : SceneShader::Casters::Moving;
        const bool is_shadowed =
            occluded(point.position, arriving.to_light, arriving.distance) ||
            (scene_ != nullptr &&
             scene_->occluded(point.position, arriving.to_light, arriving.distance, casters));
        return is_shadowed ? 0.0f : visible;
    }

    std::span<const BallInstance> instances_;
    BallLighting lighting_;
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
        const glm::vec3 color = color_from_hue(hue, 0.1f + 0.4f * random.next());
        const float metallic = random.next() < 0.25f ? 1.0f : 0.0f;
        const float smoothness = 0.05f + 0.75f * random.next();
        instances.push_back({settings.center + distance * direction, settings.radius * size, color,
                             metallic, smoothness});
        BallInstance& made = instances.back();
        if (settings.is_plain) {
            made.color = glm::vec3(0.9f);
            made.metallic = 0.0f;
            made.smoothness = 0.0f;
        }
        if (settings.metal_roughness) {
            made.metallic = 1.0f;
            made.smoothness = 1.0f - *settings.metal_roughness;
        }
    }
    return instances;
}

BallTurn::BallTurn(const glm::dvec3& center, double angle_radians)
    : center_(center), cosine_(std::cos(angle_radians)), sine_(std::sin(angle_radians)) {}

Result<Lppv> make_ball_proxy(const MeshBallSettings& settings, const ProbeVolumeView& volume) {
    constexpr uint32_t kPoints = 17;
    // The ball holds the centers of the spheres; their surfaces reach farther out.
    const double reach = settings.radius * (1.0 + 1.5 * settings.instance_size);
    LppvSettings grid_settings;
    grid_settings.bounds = LppvBounds::Custom;
    grid_settings.custom_box = {settings.center, glm::dvec3(2.0 * reach)};
    grid_settings.resolution_mode = LppvResolution::Custom;
    grid_settings.resolution = glm::uvec3(kPoints);
    const auto grid = make_lppv_grid({}, grid_settings);
    if (!grid) return grid.error();
    return make_lppv(volume, *grid, {});
}

Result<MeshBallPicture> render_mesh_ball(std::span<const BallInstance> instances,
                                         const BallLighting& lighting, const SceneShader* scene,
                                         const ProbeVolumeView& volume, const Camera& camera,
                                         const RenderSettings& settings) {
    MeshBallPicture picture;
    LitBall ball(instances, lighting, scene, volume);
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
