// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>

namespace tetralight::bench {

/// Part of the sphere around a position that a triangle covers, from -2π to 2π; positive: its back
/// is seen (van Oosterom & Strackee 1983, "The Solid Angle of a Plane Triangle").
[[nodiscard]] double solid_angle(const std::array<glm::dvec3, 3>& corners,
                                 const glm::dvec3& position);

/// The closed parts of a scene's meshes, and exactly what lies inside of them: by winding numbers,
/// without rays.
class ClosedSolids {
  public:
    /// Keeps a reference.
    explicit ClosedSolids(const TraceScene& traced);

    /// Whether a mesh's closed parts wind around a position in render space, which is farther than
    /// rounding from their surfaces.
    [[nodiscard]] bool hold(glm::vec3 position) const;

    /// Whether no open part shows its back to a position in render space, so that `hold` is all
    /// there is to say.
    [[nodiscard]] bool decide(glm::vec3 position) const;

    [[nodiscard]] size_t count() const { return parts_.size(); }

  private:
    struct Part {
        uint32_t geometry = 0;
        glm::vec3 low{0.0f}, high{0.0f};
        std::vector<std::array<glm::dvec3, 3>> triangles;
    };

    void add_parts_of(uint32_t geometry);

    const TraceScene& traced_;
    std::vector<Part> parts_;                           ///< by geometry
    std::vector<std::vector<bool>> is_of_closed_part_;  ///< triangles, by geometry
};

}  // namespace tetralight::bench
