// SPDX-License-Identifier: Apache-2.0
#include "bake/memory_estimate.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "bake/scene/surface_color.h"
#include "base/text.h"

namespace tetralight {
namespace {

/// Embree 3, medium quality: indices, a tree with its own copy of the corners, and what builds it.
constexpr uint64_t kBytesPerTriangle = 300;
/// A vertex in traced space, ours and Embree's.
constexpr uint64_t kBytesPerVertex = 24;
/// Bounds, their tree, and what builds it.
constexpr uint64_t kBytesPerEmissiveTriangle = 350;
/// A cumulated share, and the integrals that it is made from.
constexpr uint64_t kBytesPerSkyTexel = 12;
/// Light as radiance and irradiance, compact, health, positions: 450 bytes; about 6.8 tetrahedra of
/// 32 bytes; CGAL's vertices and cells while it builds them.
constexpr uint64_t kBytesPerProbe = 450 + 7 * 32 + 1500;

/// A sum in double while it is baked, a float in the volume and one in its file.
constexpr uint64_t kBytesPerSplitNumber = 8 + 4 + 4;

constexpr uint64_t kUnknown = std::numeric_limits<uint64_t>::max();

/// The number behind a word at the start of a line; without a word the first of the file.
uint64_t number_in(const char* path, const std::string& word) {
    std::ifstream file(path);
    std::string first;
    uint64_t number = 0;
    if (word.empty()) return file >> number ? number : kUnknown;
    while (file >> first) {
        if (first == word) return file >> number ? number : kUnknown;
        file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return kUnknown;
}

/// What is left of the limit of the control group that a container runs in.
uint64_t free_in_group() {
    const uint64_t limit = number_in("/sys/fs/cgroup/memory.max", "");  // "max" is no number
    const uint64_t used = number_in("/sys/fs/cgroup/memory.current", "");
    if (limit == kUnknown || used == kUnknown) return kUnknown;
    return limit - std::min(limit, used);
}

bool emits(const Material& material) {
    return material.bakes_emission && emission_source(material).factor != glm::vec3(0.0f);
}

}  // namespace

std::string gigabytes(double bytes) {
    return text(std::round(bytes / 1e8) / 10.0, " GB");
}

std::string gigabytes(uint64_t bytes) {
    return gigabytes(static_cast<double>(bytes));
}

BakeMemory estimate_bake_memory(const Scene& scene, size_t probe_count, const SplitLayout& split) {
    BakeMemory memory;
    memory.probe_count = probe_count;
    uint64_t vertex_count = 0, emissive_count = 0;
    for (const MeshInstance& instance : scene.instances) {
        if (!instance.contributes_gi) continue;
        const Mesh& mesh = scene.meshes[instance.mesh];
        memory.triangle_count += mesh.indices.size() / 3;
        vertex_count += mesh.positions.size();
        if (emits(scene.materials[mesh.material])) emissive_count += mesh.indices.size() / 3;
    }
    memory.light_bytes = emissive_count * kBytesPerEmissiveTriangle +
                         scene.environment.image.pixels.size() * kBytesPerSkyTexel;
    memory.scene_bytes = memory.triangle_count * kBytesPerTriangle + vertex_count * kBytesPerVertex;
    memory.probe_bytes = probe_count * (kBytesPerProbe + split.size() * kBytesPerSplitNumber);
    return memory;
}

uint64_t free_memory() {
    const uint64_t kilobytes = number_in("/proc/meminfo", "MemAvailable:");
    const uint64_t system = kilobytes > kUnknown / 1024 ? kUnknown : kilobytes * 1024;
    return std::min(system, free_in_group());
}

Status check_bake_memory(const Scene& scene, size_t probe_count, uint64_t limit_bytes) {
    return check_bake_memory(scene, probe_count, SplitLayout(), limit_bytes);
}

Status check_bake_memory(const Scene& scene, size_t probe_count, const SplitLayout& split,
                         uint64_t limit_bytes) {
    const BakeMemory memory = estimate_bake_memory(scene, probe_count, split);
    if (memory.total_bytes() <= limit_bytes) return Ok{};
    return Error{text("the bake needs about ", gigabytes(memory.total_bytes()), " of memory (",
                      memory.triangle_count, " triangles ",
                      gigabytes(memory.scene_bytes + memory.light_bytes), ", ", probe_count,
                      " probes ", gigabytes(memory.probe_bytes), "), ", gigabytes(limit_bytes),
                      " are free")};
}

}  // namespace tetralight
