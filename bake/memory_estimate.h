// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "bake/light_plan.h"
#include "bake/scene/scene.h"
#include "base/result.h"

namespace tetralight {

/// What a bake will take, in bytes, before any of it is taken. Good to about a third.
struct BakeMemory {
    uint64_t triangle_count = 0;
    size_t probe_count = 0;
    /// Traced triangles: copies of their vertices and Embree's tree.
    uint64_t scene_bytes = 0;
    /// What light is drawn from: emissive triangles with their tree, and the sky's texels.
    uint64_t light_bytes = 0;
    /// Probes, their cells and what builds them.
    uint64_t probe_bytes = 0;

    [[nodiscard]] uint64_t total_bytes() const { return scene_bytes + light_bytes + probe_bytes; }
};

/// `split`: what the light of each probe is split into.
[[nodiscard]] BakeMemory estimate_bake_memory(const Scene& scene, size_t probe_count,
                                              const SplitLayout& split = {});

/// Memory that this process may still take: the system's free memory, or what is left of a limit of
/// its control group. The largest number where the system does not say.
[[nodiscard]] uint64_t free_memory();

/// "20.3 GB", to a tenth.
[[nodiscard]] std::string gigabytes(double bytes);
[[nodiscard]] std::string gigabytes(uint64_t bytes);

/// Refuses a bake that `limit_bytes` do not hold, with the estimate: "needs about 20.3 GB ...".
[[nodiscard]] Status check_bake_memory(const Scene& scene, size_t probe_count,
                                       uint64_t limit_bytes = free_memory());
[[nodiscard]] Status check_bake_memory(const Scene& scene, size_t probe_count,
                                       const SplitLayout& split,
                                       uint64_t limit_bytes = free_memory());

}  // namespace tetralight
