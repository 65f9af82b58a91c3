// SPDX-License-Identifier: Apache-2.0
// 1023 spheres lit by one batch query: mesh_ball VOLUME.probes OUT.ppm [X Y Z RADIUS]
//
// The instance buffer is laid out as an engine would upload it. Spheres are then hit by rays and
// shaded with the same functions that shaders have (runtime/shaders/sh.glsl), on the CPU.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/runtime/pack_instances.h>
#include <tetralight/runtime/runtime_lights.h>
#include <tetralight/runtime/shade.h>
#include <tetralight/runtime/tone_map.h>

using namespace tetralight;

/// One element of the instance buffer.
struct Instance {
    glm::vec4 sphere;     // centre and radius
    glm::vec4 color;      // albedo
    PackedSh light;       // written by the batch query
    glm::vec4 occlusion;  // written by the batch query
};

constexpr size_t kCount = 1023;
constexpr int kWidth = 480, kHeight = 360;

std::vector<Instance> make_ball(glm::vec3 center, float radius) {
    std::mt19937 engine(1);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    std::vector<Instance> instances(kCount);
    for (Instance& instance : instances) {
        const glm::vec3 direction =
            glm::normalize(glm::vec3(normal(engine), normal(engine), normal(engine)));
        const glm::vec3 place = center + direction * (radius * std::cbrt(share(engine)));
        instance.sphere = glm::vec4(place, radius * 0.06f * (0.5f + share(engine)));
        instance.color = {0.3f + 0.6f * share(engine), 0.3f + 0.6f * share(engine),
                          0.3f + 0.6f * share(engine), 1.0f};
    }
    return instances;
}

/// The whole of it: light of all probes that the instances need, straight into their buffer.
bool light_instances(const ProbeVolumeView& volume, std::vector<Instance>& instances) {
    std::vector<glm::vec3> positions;
    for (const Instance& instance : instances) positions.emplace_back(instance.sphere);
    const auto bytes = std::as_writable_bytes(std::span(instances));
    InstanceBatch batch;
    batch.positions = positions;
    batch.packed =
        strided(bytes.subspan(offsetof(Instance, light)), ShFormat::Packed, sizeof(Instance));
    batch.occlusion =
        strided_occlusion(bytes.subspan(offsetof(Instance, occlusion)), sizeof(Instance));
    const auto report = pack_instances(volume, batch);
    if (!report) std::fprintf(stderr, "%s\n", error_text(report.error()).c_str());
    return bool(report);
}

/// Distance to the first hit in front of the eye, or infinity.
float hit(const Instance& instance, glm::vec3 eye, glm::vec3 direction) {
    const glm::vec3 offset = eye - glm::vec3(instance.sphere);
    const float b = glm::dot(offset, direction);
    const float square = b * b - glm::dot(offset, offset) + instance.sphere.w * instance.sphere.w;
    const float distance = square >= 0.0f ? -b - std::sqrt(square) : INFINITY;
    return distance > 0.0f ? distance : INFINITY;
}

glm::vec3 shade(const Instance& instance, glm::vec3 place,
                const std::vector<RuntimeLight>& lights) {
    const glm::vec3 normal = (place - glm::vec3(instance.sphere)) / instance.sphere.w;
    // What the bake left to the runtime; shadows of the scene come from the probes.
    glm::vec3 direct(0.0f);
    for (const RuntimeLight& light : lights) {
        if (light.lights_moving)
            direct +=
                light.visibility(instance.occlusion) * direct_light(light.light, place, normal);
    }
    return shade_diffuse(glm::vec3(instance.color), instance.light, normal, direct);
}

int main(int argc, char** argv) {
    if (argc != 3 && argc != 7)
        return std::fprintf(stderr, "mesh_ball VOLUME OUT.ppm [X Y Z RADIUS]\n"), 2;
    float ball[] = {0.0f, 1.5f, 0.0f, 1.0f};
    for (int i = 3; i < argc; ++i) {
        char* end = nullptr;
        ball[i - 3] = std::strtof(argv[i], &end);
        if (end == argv[i] || *end != '\0' || !std::isfinite(ball[i - 3]))
            return std::fprintf(stderr, "mesh_ball: \"%s\" is not a number\n", argv[i]), 2;
    }
    const glm::vec3 center(ball[0], ball[1], ball[2]);
    const float radius = ball[3];

    const auto file = open_probe_file(argv[1]);
    if (!file) return std::fprintf(stderr, "%s\n", error_text(file.error()).c_str()), 1;
    std::vector<Instance> instances = make_ball(center, radius);
    if (!light_instances(file->view(), instances)) return 1;
    const std::vector<RuntimeLight> lights = runtime_lights(file->view());

    std::ofstream out(argv[2], std::ios::binary);
    out << "P6\n" << kWidth << ' ' << kHeight << "\n255\n";
    const glm::vec3 eye = center + glm::vec3(0.0f, 0.0f, 3.0f * radius);
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const float x = float(i % kWidth) - 0.5f * kWidth, y = 0.5f * kHeight - float(i / kWidth);
        const glm::vec3 direction = glm::normalize(glm::vec3(x, y, -1.25f * kHeight));
        const Instance* nearest = nullptr;
        float distance = INFINITY;
        for (const Instance& instance : instances) {
            const float found = hit(instance, eye, direction);
            if (found < distance) distance = found, nearest = &instance;
        }
        const glm::vec3 color =
            nearest ? shade(*nearest, eye + distance * direction, lights) : glm::vec3(0.0f);
        const glm::vec3 shown = tone_map_neutral(color);
        for (int k = 0; k < 3; ++k)
            out.put(char(std::lround(255.0f * std::pow(shown[k], 1.0f / 2.2f))));
    }
    if (!out.flush()) return std::fprintf(stderr, "%s: cannot write\n", argv[2]), 1;
    std::printf("%zu instances in %s\n", instances.size(), argv[2]);
}
