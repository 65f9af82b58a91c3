// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/bake_scenes.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/lights/light_bounds.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/error_text.h>
#include <tetralight/bench/scene_parts.h>

namespace tetralight::bench {
namespace {

constexpr size_t kProbeCount = 64;

void add_two_sided(Scene& scene, Mesh mesh, glm::vec3 albedo, glm::vec3 emission) {
    Material material;
    material.base_color = glm::vec4(albedo, 1.0f);
    material.metallic = 0.0f;
    material.emission = emission;
    material.is_double_sided = true;
    add_mesh(scene, std::move(mesh), material);
}

Mesh room_walls(glm::vec3 size) {
    Mesh walls;
    const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    append_quad(walls, glm::vec3(0.0f), z, x);
    append_quad(walls, y, x, z);
    append_quad(walls, glm::vec3(0.0f), x, y);
    append_quad(walls, z, y, x);
    append_quad(walls, glm::vec3(0.0f), y, z);
    append_quad(walls, x, z, y);
    return walls;
}

/// Positions with at least a thousandth of the mean light. Other free positions are in sealed
/// cavities between walls, where relative errors mean nothing.
std::vector<glm::dvec3> lit_positions(const Scene& scene, std::span<const glm::dvec3> positions) {
    const auto baked = bake_probes(scene, positions, {});
    require(bool(baked), "bake");
    const auto light = [&](size_t i) { return power_of(baked->radiance[i].coefficients[0]); };
    double mean = 0.0;
    for (size_t i = 0; i < positions.size(); ++i)
        mean += light(i) / static_cast<double>(positions.size());
    std::vector<glm::dvec3> lit;
    for (size_t i = 0; i < positions.size() && lit.size() < kProbeCount; ++i) {
        if (light(i) > 1e-3 * mean) lit.push_back(positions[i]);
    }
    return lit;
}

/// Every n-th probe of the scene's groups.
std::vector<glm::dvec3> group_positions(const Scene& scene, size_t count) {
    std::vector<glm::dvec3> all;
    for (const ProbeGroup& group : scene.probe_groups) {
        for (const glm::dvec3& p : group.positions) {
            all.emplace_back(group.world_from_group * glm::dvec4(p, 1.0));
        }
    }
    std::vector<glm::dvec3> chosen;
    for (size_t i = 0; i < std::min(count, all.size()); ++i) {
        chosen.push_back(all[i * all.size() / std::min(count, all.size())]);
    }
    return chosen;
}

BakeSubject read_subject(const std::string& name, const std::string& path) {
    auto scene = read_gltf(path);
    require(bool(scene), scene ? "" : error_text(scene.error()));
    BakeSubject subject{name, std::move(*scene), {}};
    subject.probes = group_positions(subject.scene, kProbeCount);
    light_if_dark(subject.scene);
    if (subject.probes.empty()) {
        subject.probes =
            lit_positions(subject.scene, free_positions(subject.scene, 4 * kProbeCount));
    }
    return subject;
}

}  // namespace

std::vector<glm::dvec3> free_positions(const Scene& scene, size_t count) {
    const auto everything = [](const MeshInstance&) { return true; };
    const WorldBox bounds = scene_bounds(scene, everything).value_or(WorldBox{});
    std::vector<glm::dvec3> candidates = random_positions(4 * count, 1, 1.0);
    for (glm::dvec3& p : candidates) p = bounds.min + p * bounds.size();
    const auto visibility = probe_visibilities(scene, candidates);
    require(bool(visibility), "survey");
    std::vector<glm::dvec3> free;
    for (size_t i = 0; i < candidates.size() && free.size() < count; ++i) {
        if ((*visibility)[i].behind_fraction < 0.1f) free.push_back(candidates[i]);
    }
    return free;
}

Scene emitter_room() {
    constexpr glm::vec3 kSize(20.0f, 6.0f, 20.0f);
    constexpr size_t kColors = 10;
    Scene scene;
    add_two_sided(scene, room_walls(kSize), glm::vec3(0.6f), glm::vec3(0.0f));
    const std::vector<glm::dvec3> places = random_positions(10'000, 2, 1.0);
    std::array<Mesh, kColors> emitters;
    for (size_t i = 0; i < places.size(); ++i) {
        append_quad(emitters[i % kColors], glm::vec3(places[i]) * (kSize - 0.1f) + 0.04f,
                    {0.02f, 0, 0}, {0, 0, 0.02f});
    }
    for (size_t i = 0; i < kColors; ++i) {
        const auto t = static_cast<float>(i + 1) / kColors;
        add_two_sided(scene, std::move(emitters[i]), glm::vec3(0.0f),
                      100.0f * t * t * glm::vec3(1.0f, t, 1.5f - t));
    }
    return scene;
}

void light_if_dark(Scene& scene) {
    if (!scene.lights.empty() || scene.environment.radiance != glm::vec3(0.0f)) return;
    scene.environment.radiance = glm::vec3(1.0f);
    Light sun;
    sun.intensity = glm::vec3(10.0f);
    sun.direction = glm::normalize(glm::vec3(0.3f, -1.0f, 0.2f));
    scene.lights.push_back(sun);
    scene.light_names.push_back("sun");
}

std::vector<glm::dvec3> some_probes(const BakeSubject& subject) {
    std::vector<glm::dvec3> some;
    for (size_t i = 0; i < subject.probes.size(); i += 4) some.push_back(subject.probes[i]);
    return some;
}

std::vector<BakeSubject> bake_subjects(const Options& options) {
    std::vector<BakeSubject> subjects;
    if (is_selected(options, "courtyard")) {
        subjects.push_back(
            read_subject("courtyard", TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb"));
    }
    if (options.scene && is_selected(options, "scene")) {
        subjects.push_back(read_subject("scene", *options.scene));
    }
    if (is_selected(options, "emitters")) {
        subjects.push_back({"emitters", emitter_room(), {}});
        subjects.back().probes = free_positions(subjects.back().scene, kProbeCount);
    }
    return subjects;
}

}  // namespace tetralight::bench
