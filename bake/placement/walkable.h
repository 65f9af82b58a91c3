// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/rays/ray_caster.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>

// The surface that things move on, in world space.

namespace tetralight {

/// Corners in world space, counter-clockwise as seen from the front.
using WorldTriangle = std::array<glm::dvec3, 3>;

/// Front faces whose normal is less than 60° from up; other triangles are ignored. Queries are
/// thread-safe. Heights are those of the triangles' planes in double precision. Triangles that meet
/// within 0.1 mm have no gap between them, also without common corners.
class WalkableSurface {
  public:
    /// Returns invalid_argument if a corner is not finite or there is no triangle to walk on,
    /// unsupported if the surface is larger than 1e12 m, and out_of_resources if memory does not
    /// suffice. Which triangle answers a query does not depend on the order of the triangles.
    [[nodiscard]] static Result<WalkableSurface> make(std::span<const WorldTriangle> triangles);

    /// Vertical distance to the nearest place straight below, metres. 0 for positions up to 1 cm
    /// below the surface; none if there is nothing below.
    [[nodiscard]] std::optional<double> height_above(const glm::dvec3& position) const;

    /// True if the height is in [0, agent_height].
    [[nodiscard]] bool holds(const glm::dvec3& position, double agent_height) const;

    /// All places of the surface on a vertical line, from max_y down to min_y. Places that are less
    /// than 1 mm apart are one.
    [[nodiscard]] std::vector<glm::dvec3> feet_in_column(double x, double z, double max_y,
                                                         double min_y) const;

  private:
    WalkableSurface() = default;

    /// Calls `visit(y)` for the places on a vertical line downwards until it returns false. `line`
    /// has the x and z of the line and a y at or above all places to visit. The planes are
    /// evaluated at `center`.
    template <class Visit>
    void visit_line(const glm::dvec3& line, const glm::dvec3& center, const Visit& visit) const;

    [[nodiscard]] double plane_height(const WorldTriangle& triangle,
                                      const glm::dvec3& center) const;

    std::vector<WorldTriangle> triangles_;
    /// Triangles and rays are relative to it, so that float suffices far from the world's origin.
    glm::dvec3 origin_{0.0};
    double max_y_ = 0.0;
    double gap_ = 0.0;    ///< metres; narrower gaps are closed
    double merge_ = 0.0;  ///< metres; places that are nearer to each other are one
    RayCaster caster_;
};

/// The triangles of the scene's walkable instances, whether or not they contribute global
/// illumination. Triangles of double-sided materials face up.
[[nodiscard]] std::vector<WorldTriangle> walkable_triangles(const Scene& scene);

/// The triangles of all meshes of a glTF file (.gltf or .glb) in world space, whatever their
/// extras. Returns invalid_argument if it has none, and the errors of `read_gltf`; messages name
/// the file.
[[nodiscard]] Result<std::vector<WorldTriangle>> read_walkable(const std::string& path);

}  // namespace tetralight
