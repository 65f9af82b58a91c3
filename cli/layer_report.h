// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/probes/layer_noise.h>

// The error bars of layers, for `bake` and `info`.

namespace tetralight::cli {

/// null if the error of no probe is known.
[[nodiscard]] Json to_json(const NoiseStatistics& noise);

/// "median 0.50 %, 99 % below 1.20 %, worst 3.00 %", or "not known".
[[nodiscard]] std::string to_text(const NoiseStatistics& noise);

/// [{"name": "sun", "standard_error": {...}}]: one a layer.
[[nodiscard]] Json layer_noise_json(const ProbeVolumeView& volume);

/// Lines "\n  layer sun: median ...", one a layer; empty if the errors of layers are not known.
[[nodiscard]] std::string layer_noise_text(const ProbeVolumeView& volume);

}  // namespace tetralight::cli
