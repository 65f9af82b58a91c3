// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/sampling/mix.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/lightmap.h>
#include <tetralight/bench/lightmap_texels.h>
#include <tetralight/lightmap/directional_light.h>
#include <tetralight/lightmap/sample_lightmap.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kPaths = 4096;
constexpr size_t kNormals = 8;

/// Light from many directions of the hemisphere of a texel.
struct TracedLight {
    std::vector<glm::vec3> directions;
    std::vector<glm::vec3> fluxes;

    void add(const glm::vec3& direction, const glm::vec3& flux) {
        directions.push_back(direction);
        fluxes.push_back(flux);
    }
};

TracedLight trace_light(const PathTracer& tracer, const TraceScene& traced,
                        const glm::dvec3& position, const TexelSurface& surface, uint64_t key) {
    TracedLight light;
    RandomStream random(key, 0x7e);
    for (uint32_t i = 0; i < kPaths; ++i) {
        const glm::vec3 offset = surface.origins[size_t{i} * surface.origins.size() / kPaths];
        PathStart start{.origin = traced.render_from_world(position) + offset};
        start.direction = sample_start(surface.normal, random.next2());
        const float weight = start_pdf(surface.normal, start.direction) * float{kPaths};
        const Sampler sampler(detail::mix(key), i);
        light.add(start.direction, tracer.trace(start, sampler).radiance / weight);
        for (const Light& lamp : tracer.baked_lights()) {
            const LightSample sample = sample_light(lamp, start.origin, random.next2());
            if (!(glm::dot(surface.normal, sample.to_light) > 0.0f)) continue;
            if (tracer.occluded(start.origin, sample, random.next())) continue;
            light.add(sample.to_light, sample.irradiance / float{kPaths});
        }
    }
    return light;
}

/// A normal within 45° of another, uniform by solid angle.
glm::vec3 tilted(const glm::vec3& normal, glm::vec2 u) {
    const float cosine = 1.0f - u.x * (1.0f - std::numbers::sqrt2_v<float> / 2.0f);
    const float angle = 2.0f * std::numbers::pi_v<float> * u.y;
    const glm::vec3 side = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 x = glm::normalize(glm::cross(normal, side)), y = glm::cross(normal, x);
    return cosine * normal +
           std::sqrt(1.0f - cosine * cosine) * (std::cos(angle) * x + std::sin(angle) * y);
}

/// Relative errors of three ways to light a mapped normal.
struct Errors {
    double directional = 0.0, mono = 0.0, linear = 0.0;  ///< sums of squares
    size_t count = 0;

    void report_as(const std::string& name) const {
        const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(count)); };
        report("lightmap.directional." + name, rms(directional), "relative error, RMS");
        report("lightmap.directional_mono." + name, rms(mono), "relative error, RMS");
        report("lightmap.directional_linear." + name, rms(linear), "relative error of n · v, RMS");
    }
};

void add_errors(const TracedLight& light, const glm::vec3& base, RandomStream& random,
                Errors& errors) {
    glm::vec3 flux(0.0f), flat(0.0f);
    std::array<glm::vec3, 3> vectors{};
    for (size_t i = 0; i < light.fluxes.size(); ++i) {
        flux += light.fluxes[i];
        for (int c = 0; c < 3; ++c)
            vectors[static_cast<size_t>(c)] += light.fluxes[i][c] * light.directions[i];
    }
    for (int c = 0; c < 3; ++c) flat[c] = glm::dot(base, vectors[static_cast<size_t>(c)]);
    const glm::vec3 u = mono_vector(flux, vectors);
    for (size_t k = 0; k < kNormals; ++k) {
        const glm::vec3 normal = tilted(base, random.next2());
        glm::vec3 exact(0.0f);
        for (size_t i = 0; i < light.fluxes.size(); ++i)
            exact += light.fluxes[i] * std::max(0.0f, glm::dot(normal, light.directions[i]));
        const float ratio = mono_ratio(u, base, normal);
        for (int c = 0; c < 3; ++c) {
            if (!(exact[c] > 0.0f)) continue;
            const auto& vector = vectors[static_cast<size_t>(c)];
            const float lit = directional_irradiance(flux[c], vector, base, normal);
            errors.directional += std::pow(lit / exact[c] - 1.0f, 2);
            errors.mono += std::pow(flat[c] * ratio / exact[c] - 1.0f, 2);
            errors.linear += std::pow(glm::dot(normal, vector) / exact[c] - 1.0f, 2);
            ++errors.count;
        }
    }
}

void bench_errors(const Scene& scene, const PreparedLightmaps& prepared, const std::string& name) {
    const ChosenTexels chosen = every_nth(prepared, 256);
    const auto traced = TraceScene::make_static(scene);
    const PathTracer tracer(scene, *traced, {}, prepared.settings.bake.plan);
    const TexelSurfaces surfaces{chosen.surfaces, prepared.texels.origins};
    Errors errors;
    for (size_t i = 0; i < chosen.positions.size(); ++i) {
        const TracedLight light =
            trace_light(tracer, *traced, chosen.positions[i], surfaces[i], i + 1);
        RandomStream random(i, 0x45);
        add_errors(light, surfaces[i].normal, random, errors);
    }
    require(errors.count > 0, "texels have light");
    errors.report_as(name);
}

/// Directional light on the texels' own normals against their irradiance, as stored.
void bench_flat_normals(const Scene& scene, PreparedLightmaps prepared, const std::string& name) {
    const auto bake = bake_texels(scene, prepared);
    require(bool(bake), "bake");
    const std::vector<size_t> indices = prepared.page_texels();
    const BakedLightmaps result = finish_lightmaps(std::move(prepared), *bake);
    const LightmapsView view = result.lightmaps.view();
    const size_t size = view.info.page_size;
    double sum = 0.0, squares = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < indices.size(); ++i) {
        const glm::vec2 texel(indices[i] % size, indices[i] / size % size);
        const glm::vec2 uv = (texel + 0.5f) / static_cast<float>(size);
        const auto page = static_cast<uint32_t>(indices[i] / (size * size));
        const float flat = sample_irradiance(view, page, uv).y;
        if (!(flat > 0.0f)) continue;
        const glm::vec3& normal = bake->normals[i];
        const glm::vec3 lit = sample_lightmap(view, page, uv, {normal, normal});
        const double difference = double{lit.y / flat} - 1.0;
        sum += difference;
        squares += difference * difference;
        ++count;
    }
    report("lightmap.directional_flat." + name, 1.0 + sum / static_cast<double>(count),
           "directional / irradiance on the own normal, mean");
    report("lightmap.directional_flat_rms." + name, std::sqrt(squares / static_cast<double>(count)),
           "difference from 1, RMS");
}

}  // namespace

void bench_lightmap_directional(const Scene& scene, const std::string& name) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = 4.0;
    settings.layout.page_size = 2048;
    auto prepared = prepare_lightmaps(scene, settings);
    require(bool(prepared), "the scene has texels");
    bench_errors(scene, *prepared, name);
    bench_flat_normals(scene, std::move(*prepared), name);
    Scene baked = scene;
    for (Light& light : baked.lights) light.mode = LightMode::Baked;
    prepared = prepare_lightmaps(baked, settings);
    require(bool(prepared), "the scene has texels");
    bench_errors(baked, *prepared, name + "_baked_sun");
}

}  // namespace tetralight::bench
