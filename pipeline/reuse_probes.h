// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/partial_bake.h>

// Bakes only what changed: probes that stayed where they were take the light that an earlier bake
// found for them. The volume has the bytes of a bake of all probes.
//
//     prepare_bake → reuse_probes → bake_of_others → bake_range → spread_others → finish_bake

namespace tetralight {

/// Finds the probes whose light is in `old` as this bake would leave it: those at the same place,
/// that gather light at the same place. Not taken are probes that are dilated or that others are
/// dilated from, and those whose ringing is removed by another rule than it was.
///
/// `prepared.reused` keeps the view. Error: the scene, a setting or the program's version is
/// another one (it says which), or `old` was relit or has no light.
[[nodiscard]] Status reuse_probes(const ProbeVolumeView& old, PreparedBake& prepared);

/// A bake of the probes that take no light, for `bake_range` that keeps no file and for
/// `bake_in_chunks`. It cannot be finished.
[[nodiscard]] PreparedBake bake_of_others(const PreparedBake& prepared);

/// What that bake found, as a part of all probes; those that take their light are empty.
[[nodiscard]] PartialBake spread_others(const PreparedBake& prepared, const PartialBake& others);

}  // namespace tetralight
