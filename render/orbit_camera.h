// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// A camera that turns around a place.
class OrbitCamera {
  public:
    /// Begins where `start` stands.
    OrbitCamera(const Camera& start, const glm::dvec3& target);

    /// Turns about the vertical axis and up or down, short of the poles.
    void turn(double yaw_radians, double pitch_radians);

    /// Goes nearer (below 1) or farther away.
    void zoom(double factor);

    [[nodiscard]] Camera camera() const;

  private:
    glm::dvec3 target_;
    double distance_;
    double yaw_;
    double pitch_;
    double fov_y_radians_;
};

}  // namespace tetralight
