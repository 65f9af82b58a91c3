// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>

#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>

// The answers of queries as JSON: what `tetralight query --json` prints and the service sends.

namespace tetralight {

/// A position with its answer.
struct AnsweredPosition {
    const glm::vec3& position;
    const CellLocation& location;
    const IrradianceSh& irradiance;
    const glm::vec4& occlusion;
};

/// Room that `write_json` needs, although the text is shorter.
inline constexpr size_t kAnswerJsonSize = 1024;

/// Writes an object on one line: position, cell, the probes of the cell with their weights, the
/// fraction of ambient light, irradiance and occlusion. Numbers are the shortest that read back to
/// the same floats; the cell is null if there is none, and so are numbers that are not finite.
/// Returns the end of the text. Precondition: there is room for kAnswerJsonSize characters.
[[nodiscard]] char* write_json(char* to, const ProbeVolumeView& volume,
                               const AnsweredPosition& answer) noexcept;

/// The same with the cell itself; null if there is none.
[[nodiscard]] char* write_json(char* to, const Cell* cell, const AnsweredPosition& answer) noexcept;

}  // namespace tetralight
