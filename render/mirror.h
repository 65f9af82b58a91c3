// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/reflection/reflections.h>

namespace tetralight {

/// A point of a surface that mirrors.
struct MirrorPoint {
    glm::dvec3 position{0.0};
    glm::vec3 normal{0.0f};  ///< unit vector, as is `to_eye`
    glm::vec3 to_eye{0.0f};
    glm::vec3 f0{0.0f};  ///< reflectance at normal incidence
    float roughness = 0.0f;
};

/// Reflection probes as pictures show them. The twin in OpenGL is
/// render/gl/detail/reflection_shader.cpp.
class Mirror {
  public:
    /// Shows nothing.
    Mirror() = default;

    /// The owner of the probes outlives the mirror. Without box projection the light of each cube
    /// comes from far away.
    Mirror(const ReflectionsView& reflections, bool has_box_projection);

    [[nodiscard]] bool has_probes() const noexcept { return !reflections_.probes.empty(); }

    /// Radiance that a point reflects towards the eye. `baked`: irradiance / π at the point, so
    /// that dark corners do not shine.
    [[nodiscard]] glm::vec3 radiance(const MirrorPoint& point, const glm::vec3& baked) const;

  private:
    ReflectionsView reflections_;
    bool has_box_projection_ = true;
    std::vector<glm::vec2> split_sum_;  ///< `make_split_sum_table`
};

}  // namespace tetralight
