// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/values.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight::cli {

/// What `lightmap` is to do, from its settings. Samples are as many as were asked for, or as many
/// as the default error takes. Throws a `UsageError` if some do not go together.
[[nodiscard]] BakeLightmapsSettings lightmap_settings(const Values& values);

}  // namespace tetralight::cli
