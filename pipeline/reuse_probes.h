// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// Sets `prepared.reused` to the light of probes that did not change since `old` was baked: those
/// with the same position and the same capture position, bit for bit. `bake_range` does not bake
/// them, and the volume has the bytes of a bake of all probes. Excluded are dilated probes, probes
/// that light is dilated from, and probes with another dering setting.
///
/// Returns invalid_argument, with the member of the metadata as field, if the scene, a setting or
/// the program's version differs, or if `old` was relit or has no light.
[[nodiscard]] Status reuse_probes(const ProbeVolumeView& old, PreparedBake& prepared);

}  // namespace tetralight
