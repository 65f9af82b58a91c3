// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/render/image_renderer.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {

struct MeshBallSettings {
    uint32_t instance_count = 1023;
    /// Of the ball that the instances fill, world space.
    glm::dvec3 center{0.0};
    double radius = 5.0;
    /// Radius of an instance as a share of the ball's: from half of this to one and a half of it.
    double instance_size = 0.06;
    uint64_t seed = 0;
    /// White and rough instead of colours and gloss: shows the light alone.
    bool is_plain = false;
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

/// Spheres with random places, sizes, colours and gloss in a ball, a quarter of them metal, unless
/// they are plain; the same for the same settings.
[[nodiscard]] std::vector<BallInstance> make_mesh_ball(const MeshBallSettings& settings);

/// A turn about the vertical axis through a place.
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

/// Where the spheres take their probe light from.
enum class BallLight : uint8_t {
    Probes,       ///< one batch query for all, each from its centre
    ProxyVolume,  ///< a grid around the ball, at each point of each sphere
    Off,          ///< nowhere
};

/// A grid of light around the ball. Error: its grid's, for a ball without size.
[[nodiscard]] Result<Lppv> make_ball_proxy(const MeshBallSettings& settings,
                                           const ProbeVolumeView& volume);

enum class Specular : bool { Off, On };

/// What lights the spheres.
struct BallLighting {
    BallLight light = BallLight::Probes;
    /// Whether they mirror the lights, and of the probes' light its dominant direction.
    Specular specular = Specular::Off;
    /// With `ProxyVolume`.
    const Lppv* proxy = nullptr;
};

struct MeshBallPicture {
    ImageF image;
    /// Time of the one batch call that fetched the light of all instances, packed for shading.
    double query_seconds = 0.0;
};

/// Lights all instances by one batch query, or by a grid around them, and renders them: diffuse and
/// mirrored probe light, plus the direct term of the volume's lights that are not `Baked`, with
/// shadow rays among the spheres and into the scene; where probes hold the occlusion of a light,
/// that of each instance stands for the shadow of the static scene. `scene` may be null: then the
/// ball hangs in the sky.
[[nodiscard]] Result<MeshBallPicture> render_mesh_ball(
    std::span<const BallInstance> instances, const BallLighting& lighting, const SceneShader* scene,
    const ProbeVolumeView& volume, const Camera& camera, const RenderSettings& settings);

}  // namespace tetralight
