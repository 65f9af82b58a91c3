// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/bake/scene/probe_adjustment.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Reads a file of adjustment volumes:
///
///     { "adjustments": [
///         { "name": "cellar", "shape": "box", "center": [0, -2, 0], "size": [8, 3, 8],
///           "forbid": true },
///         { "name": "stage", "shape": "sphere", "center": [0, 1, 4], "radius": 2,
///           "spacing": 0.5, "validity": 1, "intensity": 0.8, "rendering_layers": [0, 3] } ] }
///
/// Names are unique. Defaults: center (0, 0, 0), size (1, 1, 1), radius 1. Returns corrupt for keys
/// that are unknown, missing or of the wrong type, and invalid_argument for values out of range,
/// with the member as the field: `adjustments[1].spacing`.
[[nodiscard]] Result<std::vector<ProbeAdjustment>> read_probe_adjustments(const std::string& path);

}  // namespace tetralight
