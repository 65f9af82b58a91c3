// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// The probes of a volume and the corners of a box around them, with tetrahedra that fill the box:
/// for engines that have no light outside of tetrahedra.
struct BoxedCells {
    /// Relative to `VolumeInfo::world_origin`.
    Box<glm::vec3> box;
    /// The probes, then the eight corners; relative to `VolumeInfo::world_origin`.
    std::vector<glm::vec3> positions;
    std::vector<IrradianceSh> light;
    /// Positively oriented. Those of the volume are first, and unchanged.
    std::vector<std::array<uint32_t, 4>> tetrahedra;
};

/// The box is that of the probes, grown by its longest side in each direction (10 m if it is a
/// point). Corners have the light that the volume has there. The probes of a plane and of a line
/// keep their triangles and segments as faces and edges. Precondition: the volume has probes.
[[nodiscard]] BoxedCells boxed_cells(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
