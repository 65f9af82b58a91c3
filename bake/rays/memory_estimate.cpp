// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/rays/memory_estimate.h>

#include <vector>

#include <tetralight/bake/scene/reflectivity_map.h>
#include <tetralight/bake/scene/surface_color.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Embree 3 at medium quality: indices, a BVH with its own copy of the corners, and its build; 64
/// bytes of corners and texture coordinates for hits.
constexpr uint64_t kBytesPerTriangle = 186 + 64;
/// A vertex in Embree.
constexpr uint64_t kBytesPerVertex = 12;
/// An object in Embree and in the tracer.
constexpr uint64_t kBytesPerInstance = 600;
/// Light bounds, the light tree, and its build.
constexpr uint64_t kBytesPerEmissiveTriangle = 350;
/// A value of the cumulative distribution, and the integral that it is computed from.
constexpr uint64_t kBytesPerSkyTexel = 12;
/// 450 bytes of radiance, irradiance, compact light, health and positions; about 6.8 tetrahedra of
/// 32 bytes; CGAL's vertices and cells during the build.
constexpr uint64_t kBytesPerProbe = 450 + 7 * 32 + 1500;

/// A double during the bake, a float in the volume, and a float in the file.
constexpr uint64_t kBytesPerLightGroupValue = 8 + 4 + 4;

bool emits(const Material& material) {
    return material.bakes_emission && emission_source(material).factor != glm::vec3(0.0f);
}

}  // namespace

BakeMemory estimate_bake_memory(const Scene& scene, size_t probe_count, size_t light_group_values) {
    BakeMemory memory;
    memory.probe_count = probe_count;
    uint64_t vertex_count = 0, emissive_count = 0, instance_count = 0;
    std::vector<bool> is_used(scene.materials.size());
    for (const MeshInstance& instance : scene.instances) {
        if (!instance.contributes_gi) continue;
        const Mesh& mesh = scene.meshes[instance.mesh];
        ++instance_count;
        memory.triangle_count += mesh.indices.size() / 3;
        vertex_count += mesh.positions.size();
        is_used[mesh.material] = true;
        if (emits(scene.materials[mesh.material])) emissive_count += mesh.indices.size() / 3;
    }
    memory.light_bytes = emissive_count * kBytesPerEmissiveTriangle +
                         scene.environment.image.pixels.size() * kBytesPerSkyTexel;
    memory.scene_bytes = memory.triangle_count * kBytesPerTriangle +
                         vertex_count * kBytesPerVertex + instance_count * kBytesPerInstance;
    for (size_t i = 0; i < is_used.size(); ++i) {
        if (is_used[i]) memory.scene_bytes += reflectivity_map_bytes(scene, scene.materials[i]);
    }
    memory.probe_bytes =
        probe_count * (kBytesPerProbe + light_group_values * kBytesPerLightGroupValue);
    return memory;
}

Status check_bake_memory(const BakeMemory& memory, uint64_t limit_bytes) {
    if (memory.total_bytes() <= limit_bytes) return Ok{};
    return Error{ErrorCode::OutOfResources,
                 str_cat("the bake needs about ", gigabytes(memory.total_bytes()), " of memory (",
                         memory.triangle_count, " triangles ",
                         gigabytes(memory.scene_bytes + memory.light_bytes), ", ",
                         memory.probe_count, " probes ", gigabytes(memory.probe_bytes), "), ",
                         gigabytes(limit_bytes), " are free")};
}

}  // namespace tetralight
