// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/result.h"
#include "pipeline/image_renderer.h"
#include "pipeline/render_scene.h"
#include "probes/probe_volume.h"

namespace tetralight {

struct MeshBallSettings {
    uint32_t instance_count = 1023;
    /// Of the ball that the instances fill, world space.
    glm::dvec3 center{0.0};
    double radius = 5.0;
    /// Radius of an instance as a share of the ball's: from half of this to one and a half of it.
    double instance_size = 0.06;
    uint64_t seed = 0;
};

/// One sphere of the mesh ball.
struct BallInstance {
    glm::dvec3 center{0.0};
    double radius = 0.0;
    glm::vec3 albedo{0.0f};

    bool operator==(const BallInstance&) const = default;
};

/// Spheres with random places, sizes and colours in a ball; the same for the same settings.
[[nodiscard]] std::vector<BallInstance> make_mesh_ball(const MeshBallSettings& settings);

struct MeshBallPicture {
    ImageF image;
    /// Time of the one batch call that fetched the light of all instances, packed for shading.
    double query_seconds = 0.0;
};

/// Lights all instances by one batch query and renders them, each with its own probe light, plus
/// the direct term of the volume's lights that are not `Baked`, with shadow rays among the spheres
/// and into the scene; where probes hold the occlusion of a light, that of each instance stands for
/// the shadow of the static scene. `scene` may be null: then the ball hangs in the sky.
[[nodiscard]] Result<MeshBallPicture> render_mesh_ball(std::span<const BallInstance> instances,
                                                       const SceneShader* scene,
                                                       const ProbeVolumeView& volume,
                                                       const Camera& camera,
                                                       const RenderSettings& settings);

}  // namespace tetralight
