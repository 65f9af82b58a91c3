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
#include <tetralight/bake/reflection/prefilter_cube.h>
#include <tetralight/bake/scene/environment.h>
#include <tetralight/bake/virtual_offset.h>
#include <tetralight/base/half.h>
#include <tetralight/base/hex.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_key.h>
#include <tetralight/pipeline/reflection_settings.h>
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
    if (settings.bake.sample_count > 0) return Ok{};
    return Error{ErrorCode::InvalidArgument, "samples", "0", "samples: must be at least 1"};
}

std::string metadata(const Scene& scene, const BakeReflectionsSettings& settings) {
    nlohmann::ordered_json json;
    json["generator"] = "tetralight " TETRALIGHT_VERSION;
    json["scene"] = hex(scene_key(scene));
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
    ReflectionBaker(const Scene& scene, const BakeReflectionsSettings& settings)
        : scene_(scene), settings_(settings) {
        baked_.reflections.size = settings.cube_size;
        baked_.reflections.metadata = metadata(scene, settings);
    }

    [[nodiscard]] Status add_places(std::span<const ReflectionPlace> places,
                                    const BakeCallback& callback) {
        const auto traced = TraceScene::make_static(scene_, settings_.bake.surfaces);
        if (!traced) return traced.error();
        std::vector<ReflectionProbe> probes;
        std::vector<CubePosition> positions;
        for (const ReflectionPlace& place : places) {
            probes.push_back(probe_at(place));
            move_out_of_geometry(*traced, place, probes.back());
            positions.push_back({probes.back().position, place.near_distance});
        }
        Stopwatch watch;
        auto cubes = bake_cubes(scene_, positions, settings_.cube_size, settings_.bake, callback);
        if (!cubes) return cubes.error();
        baked_.bake_seconds = watch.lap();
        for (size_t i = 0; i < places.size(); ++i) {
            BakedCube& cube = (*cubes)[i];
            probes[i].validity = cube.validity;
            baked_.ray_count += cube.ray_count;
            const float moved =
                static_cast<float>(glm::distance(probes[i].position, places[i].position));
            add({places[i].name, cube.validity, moved}, probes[i], std::move(cube.image));
        }
        baked_.prefilter_seconds = watch.lap();
        return Ok{};
    }

    void add_sky() {
        if (scene_.environment.radiance == glm::vec3(0.0f)) return;
        ReflectionProbe probe;
        probe.importance = std::numeric_limits<int32_t>::min();
        add({"sky"}, probe,
            bake_sky_cube(scene_.environment, settings_.cube_size, kSkySamples,
                          settings_.bake.thread_count));
    }

    [[nodiscard]] BakedReflections finish() { return std::move(baked_); }

  private:
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

    void add(ReflectionFacts facts, ReflectionProbe probe, CubeImage cube) {
        Reflections& all = baked_.reflections;
        probe.irradiance = irradiance_from_radiance(project_cube(cube));
        facts.clamped_share = clamped_share(cube);
        if (facts.clamped_share > 0.0) {
            baked_.warnings.push_back(
                str_cat("reflection probe \"", facts.name, "\": ", 100.0 * facts.clamped_share,
                        " % of its light is brighter than a half can be, and was clamped"));
        }
        add_cube(all, std::move(cube), settings_.bake.thread_count);
        all.probes.push_back(probe);
        all.names.push_back(facts.name);
        baked_.facts.push_back(std::move(facts));
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
    const BakeReflectionsSettings& settings_;
    BakedReflections baked_;
};

RadianceTexel texel_of(glm::vec3 light) {
    return {half_from_float_saturated(light.r), half_from_float_saturated(light.g),
            half_from_float_saturated(light.b), half_from_float(1.0f)};
}

}  // namespace

void add_cube(Reflections& reflections, CubeImage cube, uint32_t thread_count) {
    const auto levels = prefilter_levels(std::move(cube), thread_count);
    reflections.levels.resize(levels.size());
    for (size_t level = 0; level < levels.size(); ++level) {
        for (const glm::vec3& light : levels[level].texels)
            reflections.levels[level].push_back(texel_of(light));
    }
}

CubeImage bake_sky_cube(const Environment& environment, uint32_t size, uint32_t samples_per_texel,
                        uint32_t thread_count) {
    const SampleCube sample = [&](const glm::dvec3&, glm::vec3 direction, float, const Sampler&) {
        return CubeSample{environment_radiance(environment, direction)};
    };
    const CubePosition position;
    auto cubes =
        bake_cubes(std::span(&position, 1), {size, samples_per_texel, 0, thread_count}, sample);
    return std::move(cubes->front().image);
}

Result<BakedReflections> bake_reflections(const Scene& scene,
                                          std::span<const ReflectionPlace> places,
                                          const BakeReflectionsSettings& settings,
                                          const BakeCallback& callback) {
    if (auto status = check_settings(settings); !status) return status.error();
    ReflectionBaker baker(scene, settings);
    if (!places.empty()) {
        if (auto status = baker.add_places(places, callback); !status) return status.error();
    }
    if (settings.has_sky) baker.add_sky();
    BakedReflections baked = baker.finish();
    if (!baked.reflections.probes.empty()) return baked;
    return Error{ErrorCode::InvalidArgument, "scene", "",
                 "the scene has neither reflection probes nor a sky"};
}

}  // namespace tetralight
