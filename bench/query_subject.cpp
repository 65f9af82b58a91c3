// SPDX-License-Identifier: Apache-2.0
#include "bench/query_subject.h"

#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "bake/placement/probe_grid.h"
#include "bake/scene/read_gltf.h"
#include "pipeline/bake_volume.h"
#include "probes/build/make_probe_volume.h"
#include "probes/compact_probes.h"
#include "probes/morton_order.h"

namespace tetralight::bench {
namespace {

Subject make_subject(const std::string& name, ProbeVolume volume) {
    require(volume.info.world_origin == glm::dvec3(0.0), name + " is far from the origin");
    Subject subject{name, std::move(volume)};
    subject.low = subject.high = subject.volume.positions[0];
    for (const glm::vec3& p : subject.volume.positions) {
        subject.low = glm::min(subject.low, p);
        subject.high = glm::max(subject.high, p);
    }
    return subject;
}

}  // namespace

std::vector<glm::vec3> Subject::positions(size_t count) {
    std::vector<glm::vec3> result;
    const glm::vec3 size = 1.1f * (high - low);
    const glm::vec3 corner = 0.5f * (low + high) - 0.5f * size;
    for (const glm::dvec3& p : random_positions(count, ++seed, 1.0)) {
        result.push_back(corner + size * glm::vec3(p));
    }
    return result;
}

std::vector<glm::vec3> Subject::sorted_positions(size_t count) {
    const std::vector<glm::vec3> any = positions(count);
    std::vector<uint64_t> memory(2 * count);
    std::vector<glm::vec3> sorted;
    for (const uint64_t key : morton_order(any, memory)) {
        sorted.push_back(any[static_cast<uint32_t>(key)]);
    }
    return sorted;
}

Subject make_random_subject(const std::string& name, size_t probe_count) {
    const ProbeGroup group = make_group("bench", random_positions(probe_count, 1, 100.0));
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    for (const glm::vec3& p : volume.positions) {
        volume.irradiance.push_back(irradiance_from_radiance(constant_radiance(p)));
    }
    make_compact_probes(volume);
    return make_subject(name, std::move(volume));
}

Subject make_scene_subject(const Options& options) {
    const auto scene =
        read_gltf(options.scene.value_or(TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb"));
    require(bool(scene), scene ? "" : scene.error().message);
    std::vector<ProbeGroup> groups = scene->probe_groups;
    if (groups.empty()) {
        const auto everything = [](const MeshInstance&) { return true; };
        const glm::dvec3 size = scene_bounds(*scene, everything).value_or(Box{}).size();
        ProbeGridSettings grid;
        grid.spacing = glm::dvec3(std::cbrt(size.x * size.y * size.z / 20'000.0));
        auto made = make_probe_grid(*scene, grid);
        require(bool(made), made ? "" : made.error().message);
        groups = std::move(made->groups);
    }
    BakeVolumeSettings settings;
    settings.bake.sample_count = 64;
    settings.bake.bounces = 1;
    auto baked = bake_volume(*scene, groups, settings);
    require(bool(baked), baked ? "" : baked.error().message);
    return make_subject("scene", std::move(baked->volume));
}

}  // namespace tetralight::bench
