// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/process/memory.h>
#include <tetralight/base/result.h>

namespace tetralight {

/// The estimated memory of a bake, in bytes. Accurate to about a third.
struct BakeMemory {
    uint64_t triangle_count = 0;
    size_t probe_count = 0;
    /// Triangles in the trace scene: copies of their vertices, and Embree's BVH. Filtered textures.
    uint64_t scene_bytes = 0;
    /// Light sampling: emissive triangles with their light tree, and the texels of the sky.
    uint64_t light_bytes = 0;
    /// Probes, their cells, and the tetrahedralization while it is built.
    uint64_t probe_bytes = 0;

    [[nodiscard]] uint64_t total_bytes() const { return scene_bytes + light_bytes + probe_bytes; }
};

/// `light_group_values`: values per probe in the light groups (`LightGroupLayout::size`).
[[nodiscard]] BakeMemory estimate_bake_memory(const Scene& scene, size_t probe_count,
                                              size_t light_group_values = 0);

/// Returns out_of_resources if the estimate exceeds `limit_bytes`. The message gives both.
[[nodiscard]] Status check_bake_memory(const BakeMemory& memory,
                                       uint64_t limit_bytes = free_memory());

}  // namespace tetralight
