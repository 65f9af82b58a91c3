// SPDX-License-Identifier: Apache-2.0
#include "bake/bake_probes.h"

#include "bake/bake_tallies.h"
#include "bake/project_environment.h"

namespace tetralight {

Result<BakedProbes> bake_probes(const Scene& scene, std::span<const glm::dvec3> positions,
                                const BakeSettings& settings, const BakeCallback& callback) {
    std::vector<ProbeTally> tallies(positions.size());
    const BakeHooks hooks{.progress = callback};
    const Status status = bake_tallies(scene, positions, settings, tallies, hooks);
    if (!status) return status.error();
    BakedProbes baked = baked_probes(tallies);
    baked.ambient = project_environment(scene.environment, settings.thread_count);
    return baked;
}

BakedProbes baked_probes(std::span<const ProbeTally> tallies) {
    BakedProbes baked;
    for (const ProbeTally& tally : tallies) {
        baked.radiance.push_back(tally.radiance());
        baked.validity.push_back(tally.validity());
        baked.standard_error.push_back(tally.standard_error());
        baked.direction_count.push_back(tally.direction_count);
        baked.ray_count += tally.ray_count;
    }
    return baked;
}

}  // namespace tetralight
