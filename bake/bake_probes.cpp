// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_probes.h>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/project_environment.h>

namespace tetralight {

Result<BakedProbes> bake_probes(const Scene& scene, std::span<const glm::dvec3> positions,
                                const BakeSettings& settings, const BakeCallback& callback) {
    std::vector<ProbeAccumulator> accumulators(positions.size());
    const BakeHooks hooks{.progress = callback};
    const Status status = bake_accumulators(scene, {positions}, settings, accumulators, hooks);
    if (!status) return status.error();
    BakedProbes baked = make_baked_probes(accumulators);
    baked.ambient = project_environment(scene.environment, settings.thread_count);
    return baked;
}

BakedProbes make_baked_probes(std::span<const ProbeAccumulator> accumulators) {
    BakedProbes baked;
    for (const ProbeAccumulator& accumulator : accumulators) {
        baked.radiance.push_back(accumulator.radiance());
        baked.validity.push_back(accumulator.validity());
        baked.standard_error.push_back(accumulator.standard_error());
        baked.sampling_error.push_back(accumulator.sampling_error());
        baked.sample_count.push_back(accumulator.sample_count);
        baked.ray_count += accumulator.ray_count;
    }
    return baked;
}

}  // namespace tetralight
