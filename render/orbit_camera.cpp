// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/orbit_camera.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/render/image_renderer.h>

namespace tetralight {
namespace {

constexpr double kSteepest = 1.5;  // radians: a little below the pole

}  // namespace

OrbitCamera::OrbitCamera(const Camera& start, const glm::dvec3& target)
    : target_(target), fov_y_radians_(start.fov_y_radians), half_height_(start.half_height) {
    const glm::dvec3 offset = glm::dvec3(start.world_from_camera[3]) - target;
    distance_ = std::max(glm::length(offset), 1e-6);
    yaw_ = std::atan2(offset.x, offset.z);
    pitch_ =
        std::clamp(std::asin(std::clamp(offset.y / distance_, -1.0, 1.0)), -kSteepest, kSteepest);
}

void OrbitCamera::turn(double yaw_radians, double pitch_radians) {
    yaw_ += yaw_radians;
    pitch_ = std::clamp(pitch_ + pitch_radians, -kSteepest, kSteepest);
}

void OrbitCamera::zoom(double factor) {
    distance_ *= factor;
    if (half_height_) *half_height_ *= factor;
}

Camera OrbitCamera::camera() const {
    const double ring = std::cos(pitch_);
    const glm::dvec3 direction(ring * std::sin(yaw_), std::sin(pitch_), ring * std::cos(yaw_));
    Camera camera = look_at(target_ + distance_ * direction, target_, fov_y_radians_);
    camera.half_height = half_height_;
    return camera;
}

}  // namespace tetralight
