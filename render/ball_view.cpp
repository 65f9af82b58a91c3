// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/ball_view.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include <tetralight/base/contract.h>
#include <tetralight/render/image_renderer.h>

namespace tetralight {
namespace {

/// Distance of the eye in radii of the ball, and the field of view that holds the ball from there.
struct EyeDistance {
    double distance = 0.0;
    double fov_y_radians = 0.0;
};

const EyeDistance kEyeDistances[] = {
    {3.2, glm::radians(45.0)}, {2.2, glm::radians(65.0)}, {1.5, glm::radians(100.0)}};

/// Height of the eye for a horizontal distance of 1.04: slightly above, level, high above.
constexpr double kRises[] = {0.25, 0.0, 0.8};

constexpr int kTurnCount = 8;

/// Unit direction to the eye, turned about +Y.
glm::dvec3 direction_to_eye(double rise, int turn) {
    const double angle = 2.0 * std::numbers::pi * turn / kTurnCount;
    const double x = 0.3 * std::cos(angle) + std::sin(angle);
    const double z = std::cos(angle) - 0.3 * std::sin(angle);
    return glm::normalize(glm::dvec3(x, rise, z));
}

Camera ball_camera(const EyeDistance& eye, const glm::dvec3& to_eye, const glm::dvec3& center,
                   double radius) {
    return look_at(center + to_eye * (eye.distance * radius), center, eye.fov_y_radians);
}

/// True if nothing is between the eye and the center of the ball and four points of its rim.
bool sees_ball(const SceneShader& scene, const Camera& camera, const glm::dvec3& center,
               double radius) {
    const glm::dvec3 eye(camera.world_from_camera[3]);
    const glm::dvec3 right = glm::dvec3(camera.world_from_camera[0]) * (0.8 * radius);
    const glm::dvec3 up = glm::dvec3(camera.world_from_camera[1]) * (0.8 * radius);
    for (const glm::dvec3& offset : {glm::dvec3(0.0), right, -right, up, -up}) {
        const glm::dvec3 to_point = center + offset - eye;
        const double distance = glm::length(to_point);
        if (scene.occluded(eye, glm::vec3(to_point / distance), static_cast<float>(distance))) {
            return false;
        }
    }
    return true;
}

}  // namespace

std::optional<Camera> find_ball_camera(const SceneShader* scene, const glm::dvec3& center,
                                       double radius) {
    for (const EyeDistance& eye : kEyeDistances) {
        for (const double rise : kRises) {
            for (int turn = 0; turn < kTurnCount; ++turn) {
                const Camera camera =
                    ball_camera(eye, direction_to_eye(rise, turn), center, radius);
                if (scene == nullptr || sees_ball(*scene, camera, center, radius)) return camera;
            }
        }
    }
    return std::nullopt;
}

bool is_open(const SceneShader& scene, const glm::dvec3& center, double radius) {
    for (int i = 0; i < 27; ++i) {
        const glm::ivec3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        const int axes = std::abs(step.x) + std::abs(step.y) + std::abs(step.z);
        if (axes != 1 && axes != 3) continue;  // towards the faces and the corners of a cube
        const glm::vec3 direction = glm::normalize(glm::vec3(step));
        if (scene.occluded(center, direction, static_cast<float>(radius))) return false;
    }
    return true;
}

BallView find_ball_view(const SceneShader* scene, std::span<const glm::dvec3> centers,
                        std::span<const double> radii) {
    TETRALIGHT_ASSERT(!centers.empty() && !radii.empty(), "a ball needs a center and a radius");
    for (const double radius : radii) {
        for (const glm::dvec3& center : centers) {
            if (scene != nullptr && !is_open(*scene, center, radius)) continue;
            const auto camera = find_ball_camera(scene, center, radius);
            if (camera) return {center, radius, *camera};
        }
    }
    const Camera front =
        ball_camera(kEyeDistances[0], direction_to_eye(kRises[0], 0), centers[0], radii[0]);
    return {centers[0], radii[0], find_ball_camera(scene, centers[0], radii[0]).value_or(front)};
}

}  // namespace tetralight
