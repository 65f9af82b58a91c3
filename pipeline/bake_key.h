// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// Hash of all that a bake reads of a scene.
[[nodiscard]] uint64_t scene_key(const Scene& scene);

/// Hash of what adjustment volumes change of baked probes.
[[nodiscard]] uint64_t adjustments_key(const std::vector<ProbeAdjustment>& adjustments);

/// SHA-256 of all that the light of a probe depends on beside its position: all that a bake reads
/// of the scene, the settings but for the number of threads, and the program's version.
[[nodiscard]] Sha256Digest light_key(const Scene& scene, const BakeSettings& settings);

/// Hash of all that the bytes of a baked volume depend on: the volume without light (with groups,
/// and metadata with the scene's key and the program's version), capture positions, and settings
/// but for the number of threads. `prepared.key` is not hashed.
[[nodiscard]] uint64_t bake_key(const PreparedBake& prepared);

/// Hash of all that the radiance cache of a bake of lightmaps depends on beside `light_key`.
[[nodiscard]] uint64_t cache_key(const PreparedLightmaps& prepared);

/// The same as `bake_key` for lightmaps. `prepared.key` is not hashed.
[[nodiscard]] uint64_t lightmap_key(const PreparedLightmaps& prepared);

}  // namespace tetralight
