// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight::bench {

/// Solid angle of a triangle seen from a position, from -2π to 2π; positive if its back is seen
/// (van Oosterom & Strackee 1983, "The Solid Angle of a Plane Triangle").
[[nodiscard]] double solid_angle(const std::array<glm::dvec3, 3>& corners,
                                 const glm::dvec3& position);

/// The closed parts of a scene's meshes. Tells by exact winding numbers, without rays, which
/// positions are inside.
class ClosedSolids {
  public:
    /// Keeps a reference.
    explicit ClosedSolids(const TraceScene& traced);

    /// True if the closed parts of a mesh contain a position in render space. The position must be
    /// farther from their surfaces than rounding errors.
    [[nodiscard]] bool hold(glm::vec3 position) const;

    /// True if no open part shows its back to a position in render space, so that `hold` decides
    /// alone.
    [[nodiscard]] bool decide(glm::vec3 position) const;

    [[nodiscard]] size_t count() const { return parts_.size(); }

  private:
    struct Part {
        uint32_t geometry = 0;
        glm::vec3 min{0.0f}, max{0.0f};
        std::vector<std::array<glm::dvec3, 3>> triangles;
    };

    void add_parts_of(uint32_t geometry);

    const TraceScene& traced_;
    std::vector<Part> parts_;                           ///< sorted by geometry
    std::vector<std::vector<bool>> is_of_closed_part_;  ///< for each geometry and triangle
};

}  // namespace tetralight::bench
