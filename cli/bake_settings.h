// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/values.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight::cli {

/// What `bake` is to do, from its settings. Throws a `UsageError` if some do not go together.
[[nodiscard]] BakeVolumeSettings bake_settings(const Values& values);

}  // namespace tetralight::cli
