// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/memory.h>
#include <tetralight/base/result.h>

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

/// `split_numbers`: numbers that the light of each probe is split into (`LightGroupLayout::size`).
[[nodiscard]] BakeMemory estimate_bake_memory(const Scene& scene, size_t probe_count,
                                              size_t split_numbers = 0);

/// Returns out_of_resources if `limit_bytes` are not enough, with the estimate: "needs about 20.3
/// GB".
[[nodiscard]] Status check_bake_memory(const BakeMemory& memory,
                                       uint64_t limit_bytes = free_memory());

}  // namespace tetralight
