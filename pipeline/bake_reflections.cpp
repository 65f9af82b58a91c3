// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/bake_reflections.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/reflection/bake_cubes.h>
#include <tetralight/bake/reflection/path_cubes.h>
#include <tetralight/bake/reflection/prefilter_cube.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/bake/virtual_offset.h>
#include <tetralight/base/half.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/lightmap_cubes.h>
#include <tetralight/pipeline/reflection_settings.h>
#include <tetralight/pipeline/scene_choice_record.h>
#include <tetralight/pipeline/stored_cubes.h>
#include <tetralight/pipeline/value_record.h>

namespace tetralight {
namespace {

constexpr float kLargestHalf = 65504.0f;

/// A place inside geometry is moved by at most this share of the shortest side of its box, to this
/// share in front of the surface.
constexpr float kLongestOffset = 0.25f;
constexpr float kOffsetMargin = 0.01f;

/// Samples of each texel of the sky, which has no noise.
constexpr uint32_t kSkySamples = 64;

Status check_settings(const BakeReflectionsSettings& settings) {
    const uint32_t size = settings.cube_size;
    if (!std::has_single_bit(size) || size < 8 || size > kLargestCubeSize) {
        return Error{
            ErrorCode::InvalidArgument, "cube_size", str_cat(size),
            str_cat("cube_size: ", size, " is not a power of two from 8 to ", kLargestCubeSize)};
    }
    if (settings.bake.sample_count == 0)
        return Error{ErrorCode::InvalidArgument, "samples", "0", "samples: must be at least 1"};
    if (std::ranges::find(settings.layers, "transfer") == settings.layers.end()) return Ok{};
    return Error{ErrorCode::Unsupported, "layers", "transfer",
                 "layers: reflection probes have no transfer of distant light"};
}

/// To hundredths.
double rounded_percent(double share) {
    return std::round(1e4 * share) / 100.0;
}

/// Hash of all that cubes depend on beside `light_key`.
StoreKey cubes_key(const Scene& scene, const BakeSettings& settings,
                   const LightmapsView& lightmaps) {
    Sha256 hash;
    hash.add(light_key(scene, settings));
    for (const MeshInstance& instance : scene.instances) {
        const std::byte is_seen{instance.is_in_reflections};
        hash.add(std::span(&is_seen, 1));
    }
    hash.add(std::as_bytes(std::span(&lightmaps.info, 1)));
    hash.add(std::as_bytes(lightmaps.rectangles));
    hash.add(std::as_bytes(lightmaps.corner_uvs));
    hash.add(std::as_bytes(lightmaps.irradiance));
    return hash.digest();
}

std::string metadata(const Scene& scene, const BakeReflectionsSettings& settings,
                     const ReflectionSources& sources) {
    nlohmann::ordered_json json;
    json["generator"] = "tetralight " TETRALIGHT_VERSION;
    json["scene"] = hex(scene_key(scene));
    record_scene_choice(scene.choice, json);
    if (sources.lightmaps.info.page_count > 0) json["light"] = "lightmaps";
    const BakeReflectionsSettings defaults;
    for_each_reflection_setting(settings,
                                [&](const char* name, const auto& member, Recorded record) {
                                    if (record != Recorded::Never)
                                        json[name] = value_record(member);
                                });
    for_each_reflection_setting(
        defaults, [&](const char* name, const auto& member, Recorded record) {
            if (record == Recorded::WhenChanged && json[name] == value_record(member))
                json.erase(name);
        });
    return json.dump();
}

/// A probe where it was placed.
ReflectionProbe probe_at(const ReflectionPlace& place) {
    ReflectionProbe probe;
    probe.position = place.position;
    probe.box_center = place.box_center;
    probe.half_size = place.half_size;
    probe.axes = {place.axes[0], place.axes[1], place.axes[2]};
    probe.blend_distance = place.blend_distance;
    probe.importance = place.importance;
    return probe;
}

/// Bakes probes one after the other into levels of halves.
class ReflectionBaker {
  public:
    ReflectionBaker(const Scene& scene, const BakeReflectionsSettings& settings,
                    const ReflectionSources& sources, const LightingPlan& plan)
        : scene_(scene),
          settings_(settings),
          sources_(sources),
          plan_(plan.bake),
          has_rest_(plan.has_rest()) {
        settings_.bake.plan = plan.bake;
        baked_.warnings = plan.warnings;
        if (is_of_another_scene(sources.lightmaps.metadata, scene)) {
            baked_.warnings.emplace_back(
                "the lightmaps were baked for other lights, surfaces or options than the scene has "
                "now: reflections show both");
        }
        Reflections& all = baked_.reflections;
        all.size = settings.cube_size;
        all.metadata = metadata(scene, settings, sources);
        if (settings.layers.empty()) return;
        all.layers.resize(plan.layer_names.size());
        for (const std::string& name : plan.layer_names) all.layer_names += name + '\n';
    }

    [[nodiscard]] Status add_places(std::span<const ReflectionPlace> places,
                                    const BakeCallback& callback) {
        const auto paths = PathCubes::make(scene_, settings_.bake);
        if (!paths) return paths.error();
        std::vector<ReflectionProbe> probes;
        std::vector<CubePosition> positions;
        for (const ReflectionPlace& place : places) {
            probes.push_back(probe_at(place));
            move_out_of_geometry(paths->trace_scene(), place, probes.back());
            positions.push_back({probes.back().position, place.near_distance});
        }
        Stopwatch watch;
        auto baked = bake(positions, *paths, callback);
        if (!baked) return baked.error();
        baked_.stored = std::move(baked->stored);
        baked_.bake_seconds = watch.lap();
        for (size_t i = 0; i < places.size(); ++i) {
            BakedCube& cube = baked->cubes[i];
            probes[i].validity = cube.validity;
            baked_.ray_count += cube.ray_count;
            const float moved =
                static_cast<float>(glm::distance(probes[i].position, places[i].position));
            add({places[i].name, cube.validity, moved}, probes[i], std::move(cube.image),
                std::move(cube.layers));
        }
        baked_.prefilter_seconds = watch.lap();
        return Ok{};
    }

    void add_sky() {
        if (scene_.environment.radiance == glm::vec3(0.0f)) return;
        ReflectionProbe probe;
        probe.importance = std::numeric_limits<int32_t>::min();
        CubeImage cube = bake_sky_cube(scene_.environment, settings_.cube_size, kSkySamples,
                                       settings_.bake.thread_count);
        std::vector<CubeImage> layers(plan_.layer_count,
                                      {cube.size, std::vector<glm::vec3>(cube.texels.size())});
        if (plan_.layer_of_sky < layers.size()) layers[plan_.layer_of_sky] = cube;
        add({"sky"}, probe, std::move(cube), std::move(layers));
    }

    [[nodiscard]] BakedReflections finish() { return std::move(baked_); }

  private:
    [[nodiscard]] Result<StoredCubes> bake(std::span<const CubePosition> positions,
                                           const PathCubes& paths,
                                           const BakeCallback& callback) const {
        const BakeSettings& bake = settings_.bake;
        const CubeSampling sampling{settings_.cube_size, bake.sample_count, bake.seed,
                                    bake.thread_count, plan_.layer_count};
        const StoreKey key = cubes_key(scene_, bake, sources_.lightmaps);
        if (sources_.lightmaps.info.page_count == 0) {
            const SampleCube sample = [&](const glm::dvec3& position, glm::vec3 direction,
                                          float spread, const Sampler& sampler,
                                          std::span<glm::vec3> layers) {
                return paths.sample(position, direction, spread, sampler, layers);
            };
            return bake_stored_cubes(positions, sampling, sample, key, sources_.storage, callback);
        }
        const auto cubes = LightmapCubes::make(scene_, paths, sources_.lightmaps);
        if (!cubes) return cubes.error();
        const SampleCube sample = [&](const glm::dvec3& position, glm::vec3 direction, float spread,
                                      const Sampler& sampler, std::span<glm::vec3>) {
            return cubes->sample(position, direction, spread, sampler);
        };
        return bake_stored_cubes(positions, sampling, sample, key, sources_.storage, callback);
    }

    void move_out_of_geometry(const TraceScene& traced, const ReflectionPlace& place,
                              ReflectionProbe& probe) {
        const glm::vec3 position = traced.render_from_world(place.position);
        const float min_validity = settings_.min_validity;
        if (!probe_visibility(traced, position).is_inside(min_validity)) return;
        const float side =
            2.0f * std::min({place.half_size.x, place.half_size.y, place.half_size.z});
        const auto found = find_virtual_offset(
            traced, position, {kLongestOffset * side, kOffsetMargin * side, min_validity});
        if (!found) {
            baked_.warnings.push_back(
                str_cat("reflection probe \"", place.name, "\" lies inside geometry"));
            return;
        }
        probe.position += glm::dvec3(*found);
        probe.box_center -= *found;
    }

    /// `layers`: of the light of the cube, without the rest.
    void add(ReflectionFacts facts, ReflectionProbe probe, CubeImage cube,
             std::vector<CubeImage> layers) {
        Reflections& all = baked_.reflections;
        facts.clamped_share = clamped_share(cube);
        if (facts.clamped_share > 0.0) {
            baked_.warnings.push_back(str_cat(
                "reflection probe \"", facts.name, "\": ", rounded_percent(facts.clamped_share),
                " % of its light is brighter than a half can be, and was clamped"));
        }
        probe.irradiance = irradiance_from_radiance(project_cube(cube));
        all.probes.push_back(probe);
        all.names.push_back(facts.name);
        baked_.facts.push_back(std::move(facts));
        const uint32_t thread_count = settings_.bake.thread_count;
        if (all.layers.empty()) return add_cube(all, std::move(cube), thread_count);
        if (has_rest_) layers.push_back(rest_of(std::move(cube), layers));
        IrradianceSh sum{};
        for (const CubeImage& layer : layers) {
            all.layer_irradiance.push_back(irradiance_from_radiance(project_cube(layer)));
            sum += all.layer_irradiance.back();
        }
        all.probes.back().irradiance = sum;
        add_layered_cube(all, std::move(layers), thread_count);
    }

    /// The light that is in none of the layers.
    static CubeImage rest_of(CubeImage cube, const std::vector<CubeImage>& layers) {
        for (size_t i = 0; i < cube.texels.size(); ++i) {
            for (const CubeImage& layer : layers) cube.texels[i] -= layer.texels[i];
            cube.texels[i] = glm::max(cube.texels[i], glm::vec3(0.0f));  // rounding
        }
        return cube;
    }

    static double clamped_share(const CubeImage& cube) {
        double all = 0.0, clamped = 0.0;
        for (size_t i = 0; i < cube.texels.size(); ++i) {
            const CubeTexel texel = cube.texel(i);
            const double solid_angle = cube_solid_angle(texel.x, texel.y, cube.size);
            for (int channel = 0; channel < 3; ++channel) {
                const float light = cube.texels[i][channel];
                all += solid_angle * double{light};
                clamped += solid_angle * double{std::max(0.0f, light - kLargestHalf)};
            }
        }
        return all > 0.0 ? clamped / all : 0.0;
    }

    const Scene& scene_;
    BakeReflectionsSettings settings_;
    const ReflectionSources& sources_;
    const LightPlan& plan_;
    bool has_rest_;
    BakedReflections baked_;
};

RadianceTexel texel_of(glm::vec3 light) {
    return {half_from_float_saturated(light.r), half_from_float_saturated(light.g),
            half_from_float_saturated(light.b), half_from_float(1.0f)};
}

/// Appends the texels of all levels.
void append_levels(const std::vector<CubeImage>& levels,
                   std::vector<std::vector<RadianceTexel>>& to) {
    to.resize(levels.size());
    for (size_t level = 0; level < levels.size(); ++level) {
        for (const glm::vec3& light : levels[level].texels) to[level].push_back(texel_of(light));
    }
}

}  // namespace

void add_cube(Reflections& reflections, CubeImage cube, uint32_t thread_count) {
    append_levels(prefilter_levels(std::move(cube), thread_count), reflections.levels);
}

void add_layered_cube(Reflections& reflections, std::vector<CubeImage> layers,
                      uint32_t thread_count) {
    std::vector<CubeImage> sum;
    for (CubeImage& layer : layers) {
        const auto levels = prefilter_levels(std::move(layer), thread_count);
        append_levels(levels, reflections.layer_levels);
        if (sum.empty()) {
            sum = levels;
            continue;
        }
        for (size_t level = 0; level < sum.size(); ++level) {
            for (size_t i = 0; i < sum[level].texels.size(); ++i)
                sum[level].texels[i] += levels[level].texels[i];
        }
    }
    append_levels(sum, reflections.levels);
}

CubeImage bake_sky_cube(const Environment& environment, uint32_t size, uint32_t samples_per_texel,
                        uint32_t thread_count) {
    const SampleCube sample = [&](const glm::dvec3&, glm::vec3 direction, float, const Sampler&,
                                  std::span<glm::vec3>) {
        return CubeSample{environment_radiance(environment, direction)};
    };
    const CubePosition position;
    auto cubes =
        bake_cubes(std::span(&position, 1), {size, samples_per_texel, 0, thread_count}, sample);
    return std::move(cubes->front().image);
}

Status check_reflections(const Scene& scene, std::span<const ReflectionPlace> places,
                         const BakeReflectionsSettings& settings, const LightmapsView& lightmaps) {
    if (auto status = check_settings(settings); !status) return status;
    if (!settings.layers.empty() && lightmaps.info.page_count > 0) {
        return Error{ErrorCode::InvalidArgument, "layers", "",
                     "layers: are baked by paths, not from lightmaps"};
    }
    for (size_t i = 0; i < places.size(); ++i) {
        if (auto status = check_characters(places[i].name); !status)
            return status.error().in(
                str_cat("reflection probe ", i, ", \"", shown_path(places[i].name), "\""));
    }
    const auto plan = plan_lighting(scene, {MixedLighting::Indirect, settings.layers});
    if (!plan) return plan.error();
    const bool has_sky = settings.has_sky && scene.environment.radiance != glm::vec3(0.0f);
    const size_t probe_count = places.size() + (has_sky ? 1 : 0);
    if (probe_count == 0) {
        return Error{ErrorCode::InvalidArgument, "probes", "",
                     "there are neither reflection probes nor a sky"};
    }
    const size_t layer_count = settings.layers.empty() ? 0 : plan->layer_names.size();
    const size_t cube_count = probe_count * (1 + layer_count);
    if (cube_count <= kMaxReflectionCubes) return Ok{};
    return Error{ErrorCode::InvalidArgument, "probes", "",
                 str_cat(cube_count, " cubes, with those of the sky and of layers, are more than ",
                         kMaxReflectionCubes)};
}

Result<BakedReflections> bake_reflections(const Scene& scene,
                                          std::span<const ReflectionPlace> places,
                                          const BakeReflectionsSettings& settings,
                                          const BakeCallback& callback,
                                          const ReflectionSources& sources) {
    if (auto status = check_reflections(scene, places, settings, sources.lightmaps); !status)
        return status.error();
    const auto plan = plan_lighting(scene, {MixedLighting::Indirect, settings.layers});
    if (!plan) return plan.error();
    ReflectionBaker baker(scene, settings, sources, *plan);
    if (!places.empty()) {
        if (auto status = baker.add_places(places, callback); !status) return status.error();
    }
    if (settings.has_sky) baker.add_sky();
    return baker.finish();
}

}  // namespace tetralight
