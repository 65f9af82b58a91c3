// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/render/render_scene.h>

namespace tetralight {

/// A ball in a scene and a camera that looks at it.
struct BallView {
    glm::dvec3 center{0.0};
    double radius = 0.0;
    Camera camera;
};

/// A camera that sees a whole ball. Candidate positions lie around the ball, the front first, then
/// nearer ones; the first with a free line of sight is taken. Empty if there is none, for example
/// if the ball is inside a wall. If `scene` is null, nothing blocks the view.
[[nodiscard]] std::optional<Camera> find_ball_camera(const SceneShader* scene,
                                                     const glm::dvec3& center, double radius);

/// True if none of 14 rays from the center of a ball hits the scene within its radius.
[[nodiscard]] bool is_open(const SceneShader& scene, const glm::dvec3& center, double radius);

/// The first ball (in order of `radii`, then of `centers`) that is open and that some camera sees
/// whole. If there is none: the first radius at the first center, from a camera that sees it, or
/// from the front. Precondition: neither list is empty.
[[nodiscard]] BallView find_ball_view(const SceneShader* scene, std::span<const glm::dvec3> centers,
                                      std::span<const double> radii);

}  // namespace tetralight
