// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/ambient_occlusion.h>

#include <tetralight/bake/sampling/mix.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>

namespace tetralight {

float ambient_occlusion(const TraceScene& scene, glm::vec3 position, const TexelSurface& surface,
                        float distance, uint64_t key) {
    // Other random numbers than those of the texel's light.
    const uint64_t own_key = detail::mix(~key);
    uint32_t open = 0;
    for (uint32_t i = 0; i < kAmbientOcclusionRayCount; ++i) {
        // Rays that follow each other start at one place: they are well distributed.
        const size_t place = size_t{i} * surface.origins.size() / kAmbientOcclusionRayCount;
        const glm::vec3 direction =
            sample_cosine_hemisphere(surface.normal, owen_sobol2(i, own_key));
        const glm::vec3 origin = position + surface.origins[place];
        open += !scene.occluded({origin, direction, distance});
    }
    return static_cast<float>(open) / static_cast<float>(kAmbientOcclusionRayCount);
}

}  // namespace tetralight
