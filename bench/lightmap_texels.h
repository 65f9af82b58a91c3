// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include <tetralight/bake/radiance_cache.h>
#include <tetralight/pipeline/bake_lightmaps.h>

namespace tetralight::bench {

/// Some of the texels of a prepared bake.
struct ChosenTexels {
    std::vector<glm::dvec3> positions;
    std::vector<TexelSurfaces::Texel> surfaces;
};

/// Every n-th valid texel, about `count` of them.
[[nodiscard]] ChosenTexels every_nth(const PreparedLightmaps& prepared, size_t count);

/// The light of a texel.
struct GreenLight {
    double value = 0.0;  ///< irradiance on its normal
    double error = 0.0;  ///< standard error, absolute
};

[[nodiscard]] GreenLight green_light(const ProbeAccumulator& sums);

struct TimedCache {
    RadianceCache cache;
    double seconds_each = 0.0;  ///< per baked texel
};

[[nodiscard]] TimedCache make_timed_cache(const Scene& scene, const PreparedLightmaps& prepared);

}  // namespace tetralight::bench
