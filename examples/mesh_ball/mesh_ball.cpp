// SPDX-License-Identifier: Apache-2.0
// 1023 spheres lit by one batch query: mesh_ball VOLUME.probes OUT.ppm [X Y Z RADIUS
// [JOINS.probes]]
//
// With a second volume the ball turns for 90 frames, during which that volume joins the first and
// leaves again, in slices of half a millisecond. OUT.ppm has the ball before, with it, and after.
//
// The instance buffer is laid out as an engine would upload it. Spheres are then hit by rays and
// shaded with the same functions that shaders have (runtime/shaders/sh.glsl), on the CPU.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/joined_volume.h>
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

/// Pictures beside each other.
struct Picture {
    int count;  // of pictures
    std::vector<glm::vec3> pixels = std::vector<glm::vec3>(size_t(count) * kWidth * kHeight);

    void draw(int index, const std::vector<Instance>& instances, glm::vec3 center, float radius,
              const std::vector<RuntimeLight>& lights) {
        const glm::vec3 eye = center + glm::vec3(0.0f, 0.0f, 3.0f * radius);
        for (int i = 0; i < kWidth * kHeight; ++i) {
            const float x = float(i % kWidth) - 0.5f * kWidth;
            const float y = 0.5f * kHeight - float(i / kWidth);
            const glm::vec3 direction = glm::normalize(glm::vec3(x, y, -1.25f * kHeight));
            const Instance* nearest = nullptr;
            float distance = INFINITY;
            for (const Instance& instance : instances) {
                const float found = hit(instance, eye, direction);
                if (found < distance) distance = found, nearest = &instance;
            }
            pixels[size_t((i / kWidth * count + index) * kWidth + i % kWidth)] =
                nearest ? shade(*nearest, eye + distance * direction, lights) : glm::vec3(0.0f);
        }
    }

    bool write(const char* path) const {
        std::ofstream out(path, std::ios::binary);
        out << "P6\n" << count * kWidth << ' ' << kHeight << "\n255\n";
        for (const glm::vec3& pixel : pixels) {
            const glm::vec3 shown = tone_map_neutral(pixel);
            for (int k = 0; k < 3; ++k)
                out.put(char(std::lround(255.0f * std::pow(shown[k], 1.0f / 2.2f))));
        }
        if (!out.flush()) std::fprintf(stderr, "%s: cannot write\n", path);
        return bool(out);
    }
};

/// Spheres around a vertical axis through the center.
void turn(std::vector<Instance>& instances, glm::vec3 center, float angle) {
    for (Instance& instance : instances) {
        const glm::vec3 from = glm::vec3(instance.sphere) - center;
        const float c = std::cos(angle), s = std::sin(angle);
        const glm::vec3 to(c * from.x + s * from.z, from.y, c * from.z - s * from.x);
        instance.sphere = glm::vec4(center + to, instance.sphere.w);
    }
}

/// The frames in which a volume joins and leaves.
bool turn_and_join(const ProbeVolumeView& level, const ProbeVolumeView& part, glm::vec3 center,
                   float radius, const char* path) {
    using Clock = std::chrono::steady_clock;
    constexpr int kFrames = 90;
    JoinedVolume joined;
    if (!joined.add("level", level) || !joined.step(std::chrono::seconds(60))) return false;
    joined.commit();
    std::vector<Instance> instances = make_ball(center, radius);
    Picture picture{3};
    double longest = 0.0;
    for (int frame = 0; frame < kFrames; ++frame) {
        if (frame == kFrames / 3 && !joined.add("part", part)) return false;
        if (frame == 2 * kFrames / 3 && !joined.remove("part")) return false;
        const auto begin = Clock::now();
        const auto is_ready = joined.step(std::chrono::microseconds(500));
        if (!is_ready)
            return std::fprintf(stderr, "%s\n", error_text(is_ready.error()).c_str()), false;
        if (*is_ready) joined.commit();
        turn(instances, center, 0.02f);
        if (!light_instances(joined.view(), instances)) return false;
        const std::chrono::duration<double, std::milli> time = Clock::now() - begin;
        longest = std::max(longest, time.count());
        if (frame % (kFrames / 3) == kFrames / 3 - 1)
            picture.draw(frame / (kFrames / 3), instances, center, radius, runtime_lights(level));
    }
    std::printf("%d frames of %zu instances, %.2f ms at most, in %s\n", kFrames, instances.size(),
                longest, path);
    return picture.write(path);
}

int main(int argc, char** argv) {
    if (argc != 3 && argc != 7 && argc != 8)
        return std::fprintf(stderr, "mesh_ball VOLUME OUT.ppm [X Y Z RADIUS [JOINS]]\n"), 2;
    float ball[] = {0.0f, 1.5f, 0.0f, 1.0f};
    for (int i = 3; i < argc && i < 7; ++i) {
        char* end = nullptr;
        ball[i - 3] = std::strtof(argv[i], &end);
        if (end == argv[i] || *end != '\0' || !std::isfinite(ball[i - 3]))
            return std::fprintf(stderr, "mesh_ball: \"%s\" is not a number\n", argv[i]), 2;
    }
    const glm::vec3 center(ball[0], ball[1], ball[2]);
    const float radius = ball[3];

    const auto file = open_probe_file(argv[1]);
    if (!file) return std::fprintf(stderr, "%s\n", error_text(file.error()).c_str()), 1;
    if (argc == 8) {
        const auto part = open_probe_file(argv[7]);
        if (!part) return std::fprintf(stderr, "%s\n", error_text(part.error()).c_str()), 1;
        return turn_and_join(file->view(), part->view(), center, radius, argv[2]) ? 0 : 1;
    }
    std::vector<Instance> instances = make_ball(center, radius);
    if (!light_instances(file->view(), instances)) return 1;
    Picture picture{1};
    picture.draw(0, instances, center, radius, runtime_lights(file->view()));
    if (!picture.write(argv[2])) return 1;
    std::printf("%zu instances in %s\n", instances.size(), argv[2]);
}
