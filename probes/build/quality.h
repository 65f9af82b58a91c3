// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Shape of a tetrahedron: 6√2 · volume / (root mean square of its edges)³. 1 when regular, 0 when
/// flat, negative when turned inside out.
[[nodiscard]] double tetrahedron_quality(const glm::dvec3& a, const glm::dvec3& b,
                                         const glm::dvec3& c, const glm::dvec3& d);

/// How flat some tetrahedra are. Light that is interpolated in flat ones swings between probes that
/// are far apart.
struct QualityReport {
    uint64_t tetrahedra = 0;
    uint64_t slivers = 0;  ///< quality below 1e-3
    uint64_t flat = 0;     ///< quality below 1e-6: slivers too
    double smallest = 1.0;

    /// Slivers among all tetrahedra, 0 to 1.
    [[nodiscard]] double sliver_fraction() const;

    bool operator==(const QualityReport&) const = default;
};

/// Measures tetrahedra over positions: the inner cells of a volume that is not flat, for example.
[[nodiscard]] QualityReport measure_quality(std::span<const glm::dvec3> positions,
                                            std::span<const Cell> tetrahedra);

}  // namespace tetralight
