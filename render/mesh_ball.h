// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/mirror.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {

/// A ball that is filled with spheres.
struct MeshBallSettings {
    uint32_t instance_count = 1023;
    /// Center of the ball that the instances fill, world space.
    glm::dvec3 center{0.0};
    double radius = 5.0;
    /// Mean radius of an instance as a fraction of the ball's radius; radii vary by ±50 %.
    double instance_size = 0.06;
    uint64_t seed = 0;
    /// White and rough instead of coloured and glossy, so that only the light is seen.
    bool is_plain = false;
    /// All spheres are metal of this roughness.
    std::optional<float> metal_roughness;
};

/// One sphere of the mesh ball.
struct BallInstance {
    glm::dvec3 center{0.0};
    double radius = 0.0;
    glm::vec3 color{0.0f};
    float metallic = 0.0f;
    float smoothness = 1.0f;  ///< 1 − glTF's roughness

    bool operator==(const BallInstance&) const = default;
};

/// Spheres with random positions, sizes, colours and smoothness in a ball, a quarter of them metal
/// (unless `is_plain`). Equal settings give equal spheres.
[[nodiscard]] std::vector<BallInstance> make_mesh_ball(const MeshBallSettings& settings);

/// A rotation about the vertical axis through a center.
class BallTurn {
  public:
    BallTurn(const glm::dvec3& center, double angle_radians);

    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& position) const {
        const glm::dvec3 p = position - center_;
        return center_ + glm::dvec3(cosine_ * p.x + sine_ * p.z, p.y, cosine_ * p.z - sine_ * p.x);
    }

  private:
    glm::dvec3 center_;
    double cosine_;
    double sine_;
};

/// Source of the spheres' probe light.
enum class BallLight : uint8_t {
    Probes,       ///< one batch query for all centers
    ProxyVolume,  ///< a grid around the ball, sampled at each point of each sphere
    Off,          ///< none
};

/// A grid of light around the ball. Returns invalid_argument if the ball has no size.
[[nodiscard]] Result<Lppv> make_ball_proxy(const MeshBallSettings& settings,
                                           const ProbeVolumeView& volume);

enum class Specular : bool { Off, On };

/// What lights the spheres, and how they reflect it.
struct BallLighting {
    BallLight light = BallLight::Probes;
    /// On: spheres have highlights of lights and of the dominant direction of the probe light.
    Specular specular = Specular::Off;
    /// Needed for `BallLight::ProxyVolume`.
    const Lppv* proxy = nullptr;
    /// Reflection probes that spheres mirror, instead of the dominant direction of the probe light.
    const Mirror* mirror = nullptr;
};

/// Radiance, and what the query cost.
struct MeshBallPicture {
    ImageF image;
    /// Seconds of the batch query for all instances, including the packing for shading.
    double query_seconds = 0.0;
};

/// Lights all instances by one batch query, or by a grid around them, and renders them: diffuse and
/// specular probe light, plus the direct term of the volume's lights that are not `Baked`, with
/// shadow rays among the spheres and into the scene. If probes store the occlusion of a light, that
/// of each instance replaces the shadow of the static scene. If `scene` is null, only the spheres
/// and the sky are drawn.
[[nodiscard]] Result<MeshBallPicture> render_mesh_ball(
    std::span<const BallInstance> instances, const BallLighting& lighting, const SceneShader* scene,
    const ProbeVolumeView& volume, const Camera& camera, const RenderSettings& settings);

}  // namespace tetralight
