// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// Reads a file of places of reflection probes:
///
///     { "reflection_probes": [
///         { "name": "hall", "position": [0, 1.5, 0],
///           "box": { "center": [0, 0.25, 0], "half_size": [4, 1.75, 3],
///                    "axes": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] },
///           "blend_distance": 0.35, "importance": 2, "near": 0 } ] }
///
/// The center of the box is relative to the position. Names are unique; name and position are
/// required, and the rest has the defaults of `ReflectionPlace`. Returns corrupt for keys that are
/// unknown, missing or of the wrong type, and invalid_argument for values out of range, with the
/// member as the field: `reflection_probes[1].box.half_size`.
[[nodiscard]] Result<std::vector<ReflectionPlace>> read_reflection_places_json(
    const std::string& path);

/// Writes a file that `read_reflection_places_json` reads; the same places give the same bytes.
/// Returns the errors of the reader, and invalid_argument if a name is not UTF-8.
[[nodiscard]] Status write_reflection_places_json(const std::string& path,
                                                  std::span<const ReflectionPlace> places);

}  // namespace tetralight
