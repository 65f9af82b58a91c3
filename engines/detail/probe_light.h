// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// Irradiance of each probe as queries read it: of volumes with half floats alone from these, of
/// volumes without light the ambient light.
[[nodiscard]] std::vector<IrradianceSh> probe_light(const ProbeVolumeView& volume);

/// Occlusion of each probe as queries read it; empty: 1.
[[nodiscard]] std::vector<glm::vec4> probe_occlusion(const ProbeVolumeView& volume);

/// World position of a probe.
[[nodiscard]] glm::dvec3 world_position(const ProbeVolumeView& volume, uint32_t probe);

/// The group that each probe came from first, as an index into `group_names`; kNoIndex for none.
[[nodiscard]] std::vector<uint32_t> probe_groups(const ProbeVolumeView& volume);

}  // namespace tetralight::detail
