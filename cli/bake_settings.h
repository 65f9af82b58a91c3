// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/cli/values.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight::cli {

/// True if the samples are to follow from the default target error: neither samples, nor a target
/// error, nor a time budget was asked for. Throws a `UsageError` if there is a maximum of samples
/// without rounds that it limits, or one below the samples of the first round.
[[nodiscard]] bool takes_default_target(const BakeSettings& settings, const Values& values);

/// What `bake` is to do, from its settings. Throws a `UsageError` if some do not go together.
[[nodiscard]] BakeVolumeSettings bake_settings(const Values& values);

}  // namespace tetralight::cli
