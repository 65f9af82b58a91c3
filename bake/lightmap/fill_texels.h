// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tetralight/bake/lightmap/texel_map.h>

namespace tetralight {

/// How the texels of a rectangle that have no light of their own get that of others. A function of
/// the geometry alone, so that the light of layers still adds up after it.
struct TexelFill {
    /// A texel becomes the mean of a range of `sources`, by index in the rectangle. The index after
    /// the last texel is the mean of all texels with light.
    struct Step {
        uint32_t texel = 0;
        uint32_t first_source = 0;
        uint32_t source_count = 0;
    };

    std::vector<Step> steps;  ///< in order: sources may be targets of earlier steps
    std::vector<uint32_t> sources;
    /// Size of the rectangle in texels.
    size_t texel_count = 0;

    /// Fills `values`, one a texel of the rectangle and one more.
    template <class Value>
    void apply(std::vector<Value>& values) const {
        for (const Step& step : steps) {
            Value sum{};
            for (uint32_t i = 0; i < step.source_count; ++i) {
                sum += values[sources[step.first_source + i]];
            }
            values[step.texel] = sum * (1.0f / static_cast<float>(step.source_count));
        }
    }
};

/// Fills texels of a chart from texels of the same chart around them, until all of it has light;
/// charts without any light from the mean of the rectangle; and then the free texels around charts,
/// one ring, for filters that read beyond the footprint. `has_light`: one a texel of the map. Empty
/// if no texel has light.
[[nodiscard]] TexelFill make_texel_fill(const TexelMap& map, const std::vector<bool>& has_light);

}  // namespace tetralight
