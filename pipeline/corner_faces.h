// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// A corner of an inner cell, and the corners of the face opposite to it.
struct CornerFace {
    uint32_t cell = 0;
    uint32_t probe = 0;
    std::array<uint32_t, 3> others{kNoIndex, kNoIndex, kNoIndex};
    int other_count = 0;
};

/// The inner cells at each probe, as faces that see the probe.
class CornerFaces {
  public:
    /// Keeps the view.
    explicit CornerFaces(const ProbeVolumeView& volume);

    /// Those of one probe, in the order of the cells.
    [[nodiscard]] std::vector<CornerFace> faces(uint32_t probe) const;

  private:
    ProbeVolumeView volume_;
    std::vector<size_t> first_;    ///< the cells of probe p are [first_[p], first_[p + 1])
    std::vector<uint32_t> cells_;  ///< ascending for each probe
};

/// Barycentric weights of positions that are spread evenly over a face with so many vertices,
/// `divisions` + 1 of them along an edge. Those of places without a vertex are 0. Precondition: one
/// to three vertices.
[[nodiscard]] std::vector<glm::dvec3> face_positions(int vertex_count, int divisions);

}  // namespace tetralight
