// SPDX-License-Identifier: Apache-2.0
#include "bake/probe_estimator.h"

#include <glm/mat3x3.hpp>
#include <numbers>
#include <vector>

#include "bake/sampling.h"
#include "base/assert.h"

namespace tetralight {
namespace {

void add_baked_lights(const PathTracer& tracer, glm::vec3 origin, ProbeEstimate& estimate) {
    for (const Light& light : tracer.traced_lights()) {
        if (light.mode != LightMode::Baked) continue;
        const Illumination arriving = tracer.visible_light(light, origin);
        estimate.radiance +=
            radiance_from_directional_light(arriving.to_light, arriving.irradiance);
        ++estimate.ray_count;
    }
}

}  // namespace

ProbeEstimate estimate_probe(const PathTracer& tracer, glm::vec3 origin, uint64_t key,
                             uint32_t direction_count) {
    TETRALIGHT_ASSERT(direction_count > 0, "an estimate takes directions");
    RandomStream rotation_stream(key, ~uint64_t{0});
    const glm::mat3 rotation = sample_rotation(rotation_stream);
    ProbeEstimate estimate;
    estimate.direction_count = direction_count;
    RadianceShSum sum;
    for (uint32_t i = 0; i < direction_count; ++i) {
        const glm::vec3 direction = rotation * spherical_fibonacci(i, direction_count);
        const PathSample sample = tracer.trace(origin, direction, RandomStream(key, i));
        sum.add(direction, sample.radiance);
        estimate.behind_count += sample.is_behind_surface;
        estimate.ray_count += sample.ray_count;
    }
    estimate.radiance = radiance_from_sum(sum, 4.0 * std::numbers::pi / direction_count);
    add_baked_lights(tracer, origin, estimate);
    return estimate;
}

}  // namespace tetralight
