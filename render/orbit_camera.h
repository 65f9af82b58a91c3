// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// A camera that orbits a target.
class OrbitCamera {
  public:
    /// Starts at the position of `start`.
    OrbitCamera(const Camera& start, const glm::dvec3& target);

    /// Rotates about the vertical axis and up or down, not quite to the poles.
    void turn(double yaw_radians, double pitch_radians);

    /// Multiplies the distance to the target, and what an orthographic camera shows.
    void zoom(double factor);

    [[nodiscard]] Camera camera() const;

  private:
    glm::dvec3 target_;
    double distance_;
    double yaw_;
    double pitch_;
    double fov_y_radians_;
    std::optional<double> half_height_;
};

}  // namespace tetralight
