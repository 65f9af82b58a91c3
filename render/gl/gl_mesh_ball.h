// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/render/gl/instance_buffer.h>
#include <tetralight/render/gl/renderer.h>
#include <tetralight/render/mesh_ball.h>
#include <tetralight/render/scene_light.h>

namespace tetralight {

/// The mesh ball in OpenGL: spheres in one instance buffer, into which one batch query writes their
/// light. A context must be current during its lifetime.
class GlMeshBall {
  public:
    /// `scene_light` belongs to `scene`, which may be empty; the spheres mirror its reflection
    /// probes. Returns the errors of `Renderer::make`
    /// and of the ball's proxy volume.
    [[nodiscard]] static Result<GlMeshBall> make(const MeshBallSettings& settings,
                                                 const Scene& scene, SceneLight scene_light,
                                                 const ProbeVolumeView& volume,
                                                 uint32_t shadow_map_size);

    /// Rotates the ball and updates its light: writes transforms and, for `BallLight::Probes`,
    /// light into the instance buffer. This is all the work of the CPU for a frame.
    [[nodiscard]] Status set_frame(double angle_radians, BallLight light, Specular specular);

    /// Seconds of the last batch query including packing; 0 before the first.
    [[nodiscard]] double query_seconds() const noexcept { return query_seconds_; }

    [[nodiscard]] std::span<const glm::vec3> positions() const noexcept { return positions_; }

    [[nodiscard]] Renderer& renderer() noexcept { return renderer_; }

    [[nodiscard]] SphereInstances sphere_instances();

  private:
    GlMeshBall(const MeshBallSettings& settings, Renderer renderer, const ProbeVolumeView& volume);

    [[nodiscard]] Status query_light(std::span<GlInstance> memory);

    MeshBallSettings settings_;
    ProbeVolumeView volume_;
    Renderer renderer_;
    std::vector<BallInstance> instances_;
    std::vector<glm::vec3> positions_;
    std::vector<uint32_t> cells_;  // cell of each instance in the last query
    InstanceBuffer buffer_;
    uint32_t subdivisions_ = 0;
    uint32_t proxy_volume_ = kNoIndex;
    BallLight light_ = BallLight::Off;
    double query_seconds_ = 0.0;
};

}  // namespace tetralight
