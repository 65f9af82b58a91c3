// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/charts/detail/mask_packer.h>
#include <tetralight/charts/pack_charts.h>

namespace tetralight::detail {

/// How a chart is turned before it is placed.
enum class QuarterTurn : uint8_t { None, Left };

/// A chart as texels: its footprint and the texels around it.
struct ChartShape {
    struct Turned {
        TexelMask mask;
        MaskShape shape;
        glm::dvec2 offset{};  ///< of the chart's least corner from the mask's, texels
    };

    uint32_t chart = 0;
    uint64_t texels = 0;         ///< number of texels of the mask
    std::vector<Turned> turned;  ///< one for each `QuarterTurn` that is allowed
};

/// A UV of a chart, metres, turned and in texels from the chart's least corner.
[[nodiscard]] glm::dvec2 turn_uv(glm::vec2 uv, glm::vec2 chart_size, QuarterTurn turn,
                                 double texels_per_meter);

/// Shapes of all charts, in their order. Returns invalid_argument as soon as they need more texels
/// than a page has, without memory for larger charts.
[[nodiscard]] Result<std::vector<ChartShape>> make_chart_shapes(const Unwrap& charts,
                                                                const PackSettings& settings);

}  // namespace tetralight::detail
