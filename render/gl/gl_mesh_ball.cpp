// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/gl/gl_mesh_ball.h>

#include <chrono>
#include <cstddef>
#include <utility>

#include <tetralight/runtime/pack_instances.h>

namespace tetralight {
namespace {

/// Fewer triangles for more spheres, at most about 6 million in all.
uint32_t find_subdivisions(uint32_t count) {
    if (count <= 4'096) return 3;
    if (count <= 16'384) return 2;
    return count <= 65'536 ? 1 : 0;
}

}  // namespace

Result<GlMeshBall> GlMeshBall::make(const MeshBallSettings& settings, const Scene& scene,
                                    SceneLight scene_light, const ProbeVolumeView& volume,
                                    uint32_t shadow_map_size) {
    auto proxy = make_ball_proxy(settings, volume);
    if (!proxy) return proxy.error();
    const auto index = static_cast<uint32_t>(scene_light.proxy_volumes.size());
    scene_light.proxy_volumes.push_back(std::move(*proxy));
    const double reach = settings.radius * (1.0 + 1.5 * settings.instance_size);
    const glm::dvec4 bounds(settings.center, reach);
    auto renderer =
        Renderer::make(scene, volume, scene_light,
                       {.shadow_map_size = shadow_map_size, .sphere_bounds = {&bounds, 1}});
    if (!renderer) return renderer.error();
    GlMeshBall ball(settings, std::move(*renderer), volume);
    ball.proxy_volume_ = index;
    return ball;
}

GlMeshBall::GlMeshBall(const MeshBallSettings& settings, Renderer renderer,
                       const ProbeVolumeView& volume)
    : settings_(settings),
      volume_(volume),
      renderer_(std::move(renderer)),
      instances_(make_mesh_ball(settings)),
      positions_(instances_.size()),
      cells_(instances_.size(), kNoIndex),
      buffer_(instances_.size()),
      subdivisions_(find_subdivisions(settings.instance_count)) {
    const auto memory = buffer_.begin_write();
    for (size_t i = 0; i < instances_.size(); ++i) {
        const BallInstance& source = instances_[i];
        GlInstance& instance = memory[i];
        instance.color = glm::vec4(source.color, 1.0f);
        instance.factors = {source.metallic, 1.0f - source.smoothness, 0.0f, 1.0f};
        instance.material = renderer_.sphere_material(subdivisions_);
        instance.direct = DirectUse::Moving;
        instance.is_round = 1;
    }
}

Status GlMeshBall::set_frame(double angle_radians, BallLight light, Specular specular) {
    static constexpr ProbeUse kUses[] = {ProbeUse::Given, ProbeUse::ProxyVolume, ProbeUse::Off};
    light_ = light;
    const BallTurn turn(settings_.center, angle_radians);
    const auto memory = buffer_.begin_write();
    for (size_t i = 0; i < instances_.size(); ++i) {
        const BallInstance& source = instances_[i];
        const glm::dvec3 center = turn(source.center);
        const glm::vec3 place(center - renderer_.origin());
        const auto size = static_cast<float>(source.radius);
        positions_[i] = glm::vec3(center);
        GlInstance& instance = memory[i];
        instance.rows[0] = {size, 0.0f, 0.0f, place.x};
        instance.rows[1] = {0.0f, size, 0.0f, place.y};
        instance.rows[2] = {0.0f, 0.0f, size, place.z};
        instance.use = kUses[static_cast<size_t>(light)];
        instance.factors.z = specular == Specular::On ? 1.0f : 0.0f;
        instance.occlusion = glm::vec4(1.0f);
    }
    return light == BallLight::Probes ? query_light(memory) : Status(Ok{});
}

Status GlMeshBall::query_light(std::span<GlInstance> memory) {
    const auto bytes = std::as_writable_bytes(memory);
    if (memory.empty()) return Ok{};
    const auto start = std::chrono::steady_clock::now();
    const auto report = pack_instances(
        volume_, {.positions = positions_,
                  .hints = cells_,
                  .packed = strided(bytes.subspan(offsetof(GlInstance, light)), ShFormat::Packed,
                                    sizeof(GlInstance)),
                  .occlusion = strided_occlusion(bytes.subspan(offsetof(GlInstance, occlusion)),
                                                 sizeof(GlInstance))});
    query_seconds_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!report) return report.error();
    return Ok{};
}

SphereInstances GlMeshBall::sphere_instances() {
    return {&buffer_, positions_.size(), subdivisions_,
            light_ == BallLight::ProxyVolume ? proxy_volume_ : kNoIndex};
}

}  // namespace tetralight
