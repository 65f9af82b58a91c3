// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// Hash of what the light of a probe depends on in a scene: all that a bake sees of it.
[[nodiscard]] uint64_t scene_key(const Scene& scene);

/// Hash of what adjustment volumes say about baked probes.
[[nodiscard]] uint64_t adjustments_key(const std::vector<ProbeAdjustment>& adjustments);

/// Hash of all that the bytes of a baked volume depend on: the volume that waits for its light (and
/// with it groups, and metadata with the scene's key and the program's version), capture positions
/// and settings but for the number of threads. `prepared.key` is no part of it.
[[nodiscard]] uint64_t bake_key(const PreparedBake& prepared);

}  // namespace tetralight
