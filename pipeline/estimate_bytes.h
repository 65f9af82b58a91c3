// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_volume.h>

// The sizes of files before they are baked: that of the same file without light.

namespace tetralight {

/// Bytes of the `.probes` file.
[[nodiscard]] uint64_t estimate_bytes(const PreparedBake& prepared);

/// Bytes of the `.lightmaps` file.
[[nodiscard]] uint64_t estimate_bytes(const PreparedLightmaps& prepared);

}  // namespace tetralight
