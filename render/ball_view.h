// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {

/// A ball in a scene, and who looks at it.
struct BallView {
    glm::dvec3 center{0.0};
    double radius = 0.0;
    Camera camera;
};

/// A camera that sees a whole ball: the first of places around it, the front first, then nearer
/// ones, between which and the ball nothing of `scene` stands. None when there is no such place, as
/// when the ball is in a wall. `scene` may be null: nothing blocks the view then.
[[nodiscard]] std::optional<Camera> find_ball_camera(const SceneShader* scene,
                                                     const glm::dvec3& center, double radius);

/// Whether nothing of the scene reaches into a ball, as far as 14 rays from its centre tell.
[[nodiscard]] bool is_open(const SceneShader& scene, const glm::dvec3& center, double radius);

/// The first of `radii`, and with it the first of `centers`, whose ball stands in the open and some
/// camera sees whole. When there is none: the first of both, from where it is seen, or from the
/// front. Precondition: neither is empty.
[[nodiscard]] BallView find_ball_view(const SceneShader* scene, std::span<const glm::dvec3> centers,
                                      std::span<const double> radii);

}  // namespace tetralight
