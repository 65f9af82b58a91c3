// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "bake/scene/scene.h"
#include "pipeline/bake_volume.h"

namespace tetralight {

/// Hash of all that the bytes of a baked volume depend on: what a bake sees of the scene, the
/// volume that waits for its light (and with it groups, metadata, program version), capture
/// positions and settings but for the number of threads. `prepared.key` is no part of it.
[[nodiscard]] uint64_t bake_key(const Scene& scene, const PreparedBake& prepared);

}  // namespace tetralight
