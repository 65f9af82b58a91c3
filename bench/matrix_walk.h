// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::bench {

/// What engines ship: for each tetrahedron a matrix that makes barycentric weights of a position,
/// and its neighbors. A walk begins at a hint and leaves by the face with the most negative weight
/// (Cupisz, GDC 2012). Scalar code in floats.
class MatrixWalk {
  public:
    explicit MatrixWalk(const ProbeVolumeView& volume);

    /// Locates positions inside the hull; each walk begins where the one before it ended.
    void locate(std::span<const glm::vec3> positions, std::span<CellLocation> locations) const;

  private:
    struct Tetrahedron {
        std::array<glm::vec3, 3> rows;  ///< of the weights of the first three corners
        glm::vec3 last_corner{0.0f};
        std::array<uint32_t, 4> neighbors{};
    };

    std::vector<Tetrahedron> tetrahedra_;
};

}  // namespace tetralight::bench
