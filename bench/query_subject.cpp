// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/query_subject.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <random>
#include <utility>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/morton_order.h>

namespace tetralight::bench {
namespace {

Subject make_subject(const std::string& name, ProbeVolume volume) {
    require(volume.info.world_origin == glm::dvec3(0.0), name + " is far from the origin");
    Subject subject{name, std::move(volume)};
    subject.min = subject.max = subject.volume.positions[0];
    for (const glm::vec3& p : subject.volume.positions) {
        subject.min = glm::min(subject.min, p);
        subject.max = glm::max(subject.max, p);
    }
    return subject;
}

}  // namespace

std::vector<glm::vec3> Subject::positions(size_t count) {
    std::vector<glm::vec3> result;
    const glm::vec3 size = 1.1f * (max - min);
    const glm::vec3 corner = 0.5f * (min + max) - 0.5f * size;
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

namespace {

/// Probes whose radiance is a function of their position.
Subject make_lit_subject(const std::string& name, std::vector<glm::dvec3> positions,
                         glm::vec3 (*radiance)(const glm::vec3& position)) {
    const ProbeGroup group = make_group("bench", std::move(positions));
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    for (const glm::vec3& p : volume.positions) {
        volume.irradiance.push_back(irradiance_from_radiance(constant_radiance(radiance(p))));
    }
    make_compact_probes(volume);
    return make_subject(name, std::move(volume));
}

}  // namespace

void add_random_walls(ProbeVolume& volume, double blocked_share) {
    const ProbeEdges edges(volume.view());
    std::mt19937 engine(9);
    std::bernoulli_distribution is_blocked(blocked_share);
    std::uniform_int_distribution<int> free(0, kFreeEdge), blocked(kUnknownEdge + 1, 255);
    std::vector<uint8_t> codes(edges.size());
    for (uint8_t& code : codes) {
        code = static_cast<uint8_t>(is_blocked(engine) ? blocked(engine) : free(engine));
    }
    store_visibility(edges, codes, volume);
}

Subject make_random_subject(const std::string& name, size_t probe_count) {
    return make_lit_subject(name, random_positions(probe_count, 1, 100.0),
                            [](const glm::vec3& p) { return p; });
}

Subject make_lattice_subject(const std::string& name, size_t probe_count) {
    const auto side = static_cast<size_t>(std::cbrt(static_cast<double>(probe_count)));
    const glm::dmat3 turn(
        glm::mat4_cast(glm::angleAxis(0.3, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)))));
    std::vector<glm::dvec3> positions;
    for (size_t i = 0; i < side * side * side; ++i) {
        positions.push_back(turn * glm::dvec3(i % side, i / side % side, i / side / side));
    }
    return make_lit_subject(name, std::move(positions), [](const glm::vec3& p) { return p * p; });
}

Subject make_scene_subject(const Options& options) {
    const auto scene =
        read_gltf(options.scene.value_or(TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb"));
    require(bool(scene), scene ? "" : error_text(scene.error()));
    std::vector<ProbeGroup> groups = scene->probe_groups;
    if (groups.empty()) {
        const auto everything = [](const MeshInstance&) { return true; };
        const glm::dvec3 size = scene_bounds(*scene, everything).value_or(WorldBox{}).size();
        ProbeGridSettings grid;
        grid.spacing = glm::dvec3(std::cbrt(size.x * size.y * size.z / 20'000.0));
        auto made = make_probe_grid(*scene, grid);
        require(bool(made), made ? "" : error_text(made.error()));
        groups = std::move(made->groups);
    }
    BakeVolumeSettings settings;
    settings.bake.sample_count = 64;
    settings.bake.bounces = 1;
    auto baked = bake_volume(*scene, groups, settings);
    require(bool(baked), baked ? "" : error_text(baked.error()));
    return make_subject("scene", std::move(baked->volume));
}

}  // namespace tetralight::bench
