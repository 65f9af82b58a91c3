// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/partial_bake.h>

namespace tetralight {

/// The volume with the light that its bake has so far, for looking at: probes without samples have
/// the light of their neighbors (`dilate_probes`), or none before any probe has samples. The
/// metadata are {"is_preview":true}, so that nothing takes it for the result of the bake.
/// Precondition: the part is that of all probes.
[[nodiscard]] ProbeVolume preview_volume(const PreparedBake& prepared, const PartialBake& so_far);

}  // namespace tetralight
