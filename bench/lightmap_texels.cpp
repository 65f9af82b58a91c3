// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/lightmap_texels.h>

#include <algorithm>
#include <utility>

#include <tetralight/bake/lightmap/make_radiance_cache.h>
#include <tetralight/bake/texel_light.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

ChosenTexels every_nth(const PreparedLightmaps& prepared, size_t count) {
    ChosenTexels chosen;
    const size_t step = std::max<size_t>(1, prepared.positions.size() / count);
    for (size_t i = 0; i < prepared.positions.size(); i += step) {
        chosen.positions.push_back(prepared.positions[i]);
        chosen.surfaces.push_back(prepared.surfaces[i]);
    }
    return chosen;
}

GreenLight green_light(const ProbeAccumulator& sums) {
    const auto value = double{irradiance_on_normal(glm::dvec3(sums.radiance().coefficients[2])).y};
    return {value, value * double{sums.sampling_error(ErrorMeasure::OwnNormal)}};
}

TimedCache make_timed_cache(const Scene& scene, const PreparedLightmaps& prepared) {
    Result<RadianceCache> cache = RadianceCache{};
    const double time = seconds([&] {
        cache = make_radiance_cache(scene, prepared.layout, prepared.maps, prepared.texels,
                                    prepared.settings.bake);
    });
    require(bool(cache), "cache");
    return {std::move(*cache), time / static_cast<double>(prepared.baked.size())};
}

}  // namespace tetralight::bench
