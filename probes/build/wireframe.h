// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Two probes that are joined, the lower index first.
using ProbeEdge = std::array<uint32_t, 2>;

/// The edges of a volume's inner cells, each once and sorted.
struct Wireframe {
    /// Of the probes, world space.
    std::vector<glm::dvec3> positions;
    /// Edges within the convex hull, and the edges of the hull: disjoint.
    std::vector<ProbeEdge> inner_edges;
    std::vector<ProbeEdge> hull_edges;

    bool operator==(const Wireframe&) const = default;
};

/// Precondition: the indices of the volume's cells are sound (`verify`).
[[nodiscard]] Wireframe make_wireframe(const ProbeVolumeView& volume);

/// Wavefront OBJ: a vertex for each probe, line elements in the groups `cells` and `hull`. Numbers
/// read back to the same values.
[[nodiscard]] std::string obj_text(const Wireframe& wireframe);

/// ASCII PLY (Turk 1994): a vertex for each probe, in double; edges with `vertex1`, `vertex2` and
/// `hull`, which is 1 for those of the hull.
[[nodiscard]] std::string ply_text(const Wireframe& wireframe);

}  // namespace tetralight
