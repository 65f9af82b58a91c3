// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/reflection/bake_cubes.h>
#include <tetralight/bake/reflection/prefilter_cube.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/reflection_pmrem.h>
#include <tetralight/pipeline/bake_reflections.h>
#include <tetralight/reflection/sample_reflections.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kSize = 128;

struct Error {
    double squares = 0.0, light = 0.0;

    void add(const glm::dvec3& found, const glm::dvec3& exact) {
        squares += glm::dot(found - exact, found - exact);
        light += glm::dot(exact, exact);
    }

    [[nodiscard]] double rms() const { return light > 0.0 ? std::sqrt(squares / light) : 0.0; }
};

CubeImage bake_cube(const Scene& scene, const glm::dvec3& position, uint32_t size,
                    uint32_t samples) {
    BakeSettings settings;
    settings.sample_count = samples;
    const CubePosition place{position};
    auto cubes = bake_cubes(scene, std::span(&place, 1), size, settings);
    require(bool(cubes), "a baked cube");
    return std::move(cubes->front().image);
}

/// The weighted mean of all texels, in doubles.
glm::dvec3 brute_force(const CubeImage& source, const glm::dvec3& direction, double roughness) {
    glm::dvec3 light(0.0);
    double sum = 0.0;
    for (size_t i = 0; i < source.texels.size(); ++i) {
        const CubeTexel texel = source.texel(i);
        const glm::dvec3 to_texel(cube_direction(texel, source.size));
        const double weight = ggx_lobe(std::min(1.0, glm::dot(direction, to_texel)), roughness) *
                              cube_solid_angle(texel.x, texel.y, source.size);
        light += weight * glm::dvec3(source.texels[i]);
        sum += weight;
    }
    return light / sum;
}

/// Texels of a level that are compared: each eighth of the finer ones, for brute force is slow.
std::vector<size_t> compared_texels(const CubeImage& level) {
    std::vector<size_t> texels;
    const size_t step = std::max<size_t>(1, level.texels.size() / 700);
    for (size_t i = 0; i < level.texels.size(); i += step) texels.push_back(i);
    return texels;
}

/// The sum that engines take on the GPU: half vectors in proportion to D cos θ_h by a sequence of
/// low discrepancy, mirrored, weighted by the cosine.
glm::dvec3 sampled(const CubeImage& source, glm::vec3 direction, float roughness, uint32_t count) {
    const glm::mat3 frame = frame_around(direction);
    const float alpha = roughness * roughness;
    glm::dvec3 light(0.0);
    double sum = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec2 u = owen_sobol2(i, 1);
        const float tan_squared = alpha * alpha * u.x / (1.0f - u.x);
        const float cosine = 2.0f / (1.0f + tan_squared) - 1.0f;
        if (cosine <= 0.0f) continue;
        const float angle = 2.0f * std::numbers::pi_v<float> * u.y;
        const float sine = std::sqrt(1.0f - cosine * cosine);
        const CubePlace place =
            cube_place(frame * glm::vec3(sine * std::cos(angle), sine * std::sin(angle), cosine));
        const auto x = std::min(
            source.size - 1, static_cast<uint32_t>(place.uv.x * static_cast<float>(source.size)));
        const auto y = std::min(
            source.size - 1, static_cast<uint32_t>(place.uv.y * static_cast<float>(source.size)));
        light += double{cosine} * glm::dvec3(source.texels[source.index({place.face, x, y})]);
        sum += double{cosine};
    }
    return light / sum;
}

CubeImage sampled_level(const CubeImage& source, uint32_t size, float roughness, uint32_t count) {
    CubeImage level{size, std::vector<glm::vec3>(cube_texel_count(size))};
    for (size_t i = 0; i < level.texels.size(); ++i) {
        const glm::vec3 direction = cube_direction(level.texel(i), size);
        level.texels[i] = glm::vec3(sampled(source, direction, roughness, count));
    }
    return level;
}

double error_of(const CubeImage& level, const std::vector<size_t>& texels,
                const std::vector<glm::dvec3>& exact) {
    Error error;
    for (size_t i = 0; i < texels.size(); ++i) error.add(level.texels[texels[i]], exact[i]);
    return error.rms();
}

/// Levels against brute force, and against samples that take as many as reach the same error.
void bench_prefilter(const CubeImage& cube, const std::string& name) {
    const uint32_t count = reflection_level_count(kSize);
    const auto levels = prefilter_levels(cube, 1);
    double baseline_seconds = 0.0, our_seconds = 0.0;
    for (uint32_t k = 1; k < count; ++k) {
        const float roughness = roughness_of_level(k, count);
        const auto texels = compared_texels(levels[k]);
        std::vector<glm::dvec3> exact;
        for (const size_t i : texels) {
            const glm::dvec3 direction(cube_direction(levels[k].texel(i), levels[k].size));
            exact.push_back(brute_force(cube, direction, double{roughness}));
        }
        const double error = error_of(levels[k], texels, exact);
        report(str_cat("reflection.prefilter_error.", name, ".", roughness), 100.0 * error, "%");
        const uint32_t size = levels[k].size;
        our_seconds += cpu_seconds([&] { (void)prefilter_cube(cube, size, roughness, 1); });
        uint32_t samples = 16;
        CubeImage found;
        double time = 0.0;
        do {
            samples *= 2;
            time = cpu_seconds([&] { found = sampled_level(cube, size, roughness, samples); });
        } while (samples < 1u << 14 && error_of(found, texels, exact) > error);
        baseline_seconds += time;
    }
    report_contest("reflection.prefilter." + name, 1.0 / our_seconds, 1.0 / baseline_seconds,
                   "cubes/s", "GGX importance sampling with as many samples as reach our error");
}

/// The irradiance of a cube against that of a light probe, over normals.
void bench_sh(const Scene& scene, const glm::dvec3& position, const CubeImage& cube,
              const std::string& name) {
    BakeSettings settings;
    settings.sample_count = 1u << 20;
    const auto probe = bake_probes(scene, std::span(&position, 1), settings);
    require(bool(probe), "a baked probe");
    const IrradianceSh ours = irradiance_from_radiance(project_cube(cube));
    const IrradianceSh exact = irradiance_from_radiance(probe->radiance[0]);
    Error error;
    for (uint32_t i = 0; i < 256; ++i) {
        const glm::vec3 normal = spherical_fibonacci(i, 256);
        error.add(evaluate_irradiance(ours, normal), evaluate_irradiance(exact, normal));
    }
    // As many paths as the cube has: half of them are a probe of their own.
    BakeSettings half = settings;
    half.seed = 1;
    const auto other = bake_probes(scene, std::span(&position, 1), half);
    require(bool(other), "a baked probe");
    const IrradianceSh again = irradiance_from_radiance(other->radiance[0]);
    Error noise;
    for (uint32_t i = 0; i < 256; ++i) {
        const glm::vec3 normal = spherical_fibonacci(i, 256);
        noise.add(evaluate_irradiance(again, normal), evaluate_irradiance(exact, normal));
    }
    report("reflection.sh." + name, 100.0 * error.rms(), "%");
    report("reflection.sh_noise." + name, 100.0 * noise.rms(), "%");
}

constexpr glm::dvec3 kLow(-3.0, 0.0, -2.0), kHigh(3.0, 3.0, 2.0);

/// The light of the walls of a room of 6 × 3 × 4 m, which is not the same at any two places.
glm::vec3 light_of_walls(const glm::dvec3& p) {
    return {1.0 + 0.8 * std::sin(1.7 * p.x + p.y), 1.0 + 0.8 * std::sin(2.3 * p.y - p.z),
            1.0 + 0.8 * std::sin(1.9 * p.z + 0.7 * p.x)};
}

struct WallHit {
    glm::dvec3 place{0.0};
    double edge_distance = 0.0;  ///< to the nearest edge of the room
};

WallHit hit_walls(const glm::dvec3& origin, const glm::dvec3& direction) {
    double distance = std::numeric_limits<double>::infinity();
    int side = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) continue;
        const double end = direction[axis] > 0.0 ? kHigh[axis] : kLow[axis];
        const double along = (end - origin[axis]) / direction[axis];
        if (along < distance) side = axis;
        distance = std::min(distance, along);
    }
    WallHit hit{origin + distance * direction, std::numeric_limits<double>::infinity()};
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == side) continue;
        const double to_edge =
            std::min(hit.place[axis] - kLow[axis], kHigh[axis] - hit.place[axis]);
        hit.edge_distance = std::min(hit.edge_distance, to_edge);
    }
    return hit;
}

/// A probe of the room, captured at a position.
Reflections room_probe(const glm::dvec3& position) {
    const SampleCube sample = [](const glm::dvec3& origin, glm::vec3 direction, float,
                                 const Sampler&, std::span<glm::vec3>) {
        return CubeSample{light_of_walls(hit_walls(origin, direction).place)};
    };
    const CubePosition place{position};
    const auto cubes = bake_cubes(std::span(&place, 1), {kSize, 64}, sample);
    require(bool(cubes), "a baked cube");
    Reflections reflections;
    reflections.size = kSize;
    ReflectionProbe probe;
    probe.position = position;
    probe.box_center = glm::vec3(0.5 * (kLow + kHigh) - position);
    probe.half_size = glm::vec3(0.5 * (kHigh - kLow));
    probe.blend_distance = 0.1f;
    reflections.probes.push_back(probe);
    add_cube(reflections, cubes->front().image, 0);
    return reflections;
}

/// A mirror ball at places of the room, by box projection, against the walls themselves.
void bench_box() {
    const Reflections room = room_probe({0.4, 1.7, -0.3});
    const ReflectionsView view = room.view();
    Error error;
    for (uint32_t i = 0; i < 20'000; ++i) {
        Sampler sampler(5, i);
        const glm::vec2 u = sampler.next2(), w = sampler.next2();
        const glm::dvec3 center(-2.0 + 4.0 * u.x, 0.9 + 1.2 * u.y, -1.0 + 2.0 * w.x);
        const glm::vec3 normal = spherical_fibonacci(i, 20'000);
        const glm::dvec3 place = center + 0.5 * glm::dvec3(normal);
        const glm::vec3 looking = uniform_direction(sampler.next2());
        if (glm::dot(looking, normal) >= 0.0f) continue;
        const glm::vec3 mirrored = glm::reflect(looking, normal);
        const WallHit hit = hit_walls(place, mirrored);
        if (hit.edge_distance < 0.1) continue;
        const ReflectionBlend blend = blend_reflections(view, place);
        error.add(sample_reflections(view, blend, place, mirrored, 0.0f),
                  light_of_walls(hit.place));
    }
    report("reflection.box", 100.0 * error.rms(), "%");
}

/// The largest change of the light that a ball reflects per 1 mm, on its way from a white room into
/// a black one through a doorway as long as the blend distance.
void bench_blend() {
    Reflections two;
    two.size = 8;
    for (int i = 0; i < 2; ++i) {
        ReflectionProbe probe;
        probe.position = {4.5 * i, 0.0, 0.0};
        probe.half_size = {2.0f, 2.0f, 2.0f};
        probe.blend_distance = 0.5f;
        two.probes.push_back(probe);
        const CubeImage cube{
            8, std::vector<glm::vec3>(cube_texel_count(8), glm::vec3(i == 0 ? 1.0f : 0.0f))};
        add_cube(two, cube, 0);
    }
    const ReflectionsView view = two.view();
    double worst = 0.0;
    float before = -1.0f;
    for (int step = 0; step <= 4500; ++step) {
        const glm::dvec3 place(0.001 * step, 0.2, 0.1);
        const ReflectionBlend blend = blend_reflections(view, place);
        const float light = sample_reflections(view, blend, place, {0, 1, 0}, 0.5f).x;
        if (before >= 0.0f) worst = std::max(worst, std::abs(double{light} - double{before}));
        before = light;
    }
    report("reflection.blend", 255.0 * worst, "1/255");
}

void bench_scene(const std::string& path, const glm::dvec3& position, const std::string& name,
                 const std::optional<std::string>& pmrem) {
    auto scene = read_gltf(path);
    require(bool(scene), "the scene " + path);
    light_if_dark(*scene);
    if (pmrem) {
        for (const uint32_t size : {kSize, 2 * kSize}) {
            write_pmrem_subject(*pmrem, str_cat(name, '.', size),
                                bake_cube(*scene, position, size, 64));
        }
        return;
    }
    const CubeImage cube = bake_cube(*scene, position, kSize, 64);
    bench_prefilter(cube, name);
    bench_sh(*scene, position, cube, name);
}

}  // namespace

void bench_reflection(const Options& options) {
    bench_scene(TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb", {0.0, 1.5, 0.0},
                "courtyard", options.pmrem);
    if (options.scene) bench_scene(*options.scene, {0.0, 2.0, 0.0}, "scene", options.pmrem);
    if (options.pmrem) {
        write_pmrem_checks(*options.pmrem, kSize);
        return;
    }
    bench_box();
    bench_blend();
}

}  // namespace tetralight::bench
