// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "base/result.h"
#include "probes/locate.h"
#include "probes/probe_volume.h"

namespace tetralight {

/// What a volume answers for one position.
struct InterpolatedProbe {
    IrradianceSh irradiance;
    /// Four channels, 1 = lit.
    glm::vec4 occlusion{1.0f};

    bool operator==(const InterpolatedProbe&) const = default;
};

/// Blends the probes of a located cell. Without a cell, or without baked light, the answer is the
/// volume's ambient light and occlusion (1, 1, 1, 1). Thread-safe.
[[nodiscard]] InterpolatedProbe interpolate(const ProbeVolumeView& volume,
                                            const CellLocation& location) noexcept;

/// The same for many positions in one call.
struct InterpolationBatch {
    /// World space.
    std::span<const glm::vec3> positions;
    /// In: where each walk starts; out: the cell found, for the next frame. May be empty: then each
    /// walk starts at the cell of the position before it.
    std::span<uint32_t> hints;
    /// Either may be empty (not wanted), not both.
    std::span<IrradianceSh> irradiance;
    std::span<glm::vec4> occlusion;
};

/// Locates and blends every position of the batch. Errors: no output at all, and a span that is
/// shorter than `positions` (the message says both lengths). Thread-safe on one volume; allocates
/// nothing.
[[nodiscard]] Status interpolate(const ProbeVolumeView& volume, const InterpolationBatch& batch);

}  // namespace tetralight
