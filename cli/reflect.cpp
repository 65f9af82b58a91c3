// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/reflection_places_json.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/bake_storing.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/explain.h>
#include <tetralight/cli/lightmap_files.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/cli/scene_parts_report.h>
#include <tetralight/pipeline/bake_reflections.h>
#include <tetralight/pipeline/lightmap_scene.h>
#include <tetralight/pipeline/reflection_settings.h>
#include <tetralight/reflection/reflection_file.h>

namespace tetralight::cli {
namespace {

BakeReflectionsSettings reflection_settings(const Values& values) {
    BakeReflectionsSettings settings;
    for_each_reflection_setting(settings, [&](const char* name, auto& member, Recorded) {
        read_if_any(values, name, member);
    });
    constexpr uint32_t kRaysToLightmaps = 16;
    if (values.is_given("lightmaps") && !values.is_given("samples"))
        settings.bake.sample_count = kRaysToLightmaps;
    settings.has_sky = !values.flag("no_sky");
    const uint32_t size = settings.cube_size;
    if ((size & (size - 1)) != 0)
        refuse(values, "cube_size", str_cat(size, " is not a power of two"));
    return settings;
}

/// The place of --box; none if it was not given.
std::vector<ReflectionPlace> place_of_box(const Values& values) {
    if (!values.is_given("box")) return {};
    const std::vector<double> box = values.numbers("box");
    const glm::dvec3 min(box[0], box[1], box[2]), max(box[3], box[4], box[5]);
    for (int axis = 0; axis < 3; ++axis) {
        if (min[axis] < max[axis]) continue;
        refuse(values, "box",
               str_cat("the minimum ", min[axis], " is not below the maximum ", max[axis]));
    }
    ReflectionPlace place;
    const glm::dvec3 center = 0.5 * (min + max);
    place.name = "box";
    place.position = values.is_given("position") ? vec3(values, "position") : center;
    place.box_center = glm::vec3(center - place.position);
    place.half_size = glm::vec3(0.5 * (max - min));
    place.blend_distance = static_cast<float>(values.number("blend_distance"));
    return {place};
}

Json probes_json(const Reflections& reflections, const std::vector<ReflectionFacts>& facts) {
    Json probes = Json::array();
    for (size_t i = 0; i < facts.size(); ++i) {
        const ReflectionProbe& probe = reflections.probes[i];
        probes.push_back(
            {{"name", facts[i].name},
             {"position", to_json(probe.position)},
             {"half_size", probe.is_everywhere() ? Json() : to_json(glm::dvec3(probe.half_size))},
             {"importance", probe.importance},
             {"validity", facts[i].validity},
             {"virtual_offset", facts[i].virtual_offset},
             {"clamped_share", facts[i].clamped_share}});
    }
    return probes;
}

struct Reflect {
    SceneOptions scene_options;
    std::string output;
    BakeReflectionsSettings settings;
    std::vector<std::string> names;
    std::string places_path;
    std::string lightmaps_path;
    std::vector<ReflectionPlace> given_places;
    BakeStoring storing;
    bool is_explained = false;
    CommonOptions common;

    explicit Reflect(const Values& values)
        : scene_options(values),
          output(values.text("output")),
          settings(reflection_settings(values)),
          names(values.texts("probe")),
          places_path(values.text("places")),
          lightmaps_path(values.text("lightmaps")),
          given_places(place_of_box(values)),
          storing(values),
          is_explained(values.flag("explain")),
          common(values) {
        if (output.empty() && !is_explained) require(values, "output");
    }

    Status run() { return is_explained ? run_explain() : run_bake(); }

    [[nodiscard]] Status run_explain() const {
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(warnings_beside_parts(*scene));
        const auto places = places_of(*scene);
        if (!places) return places.error();
        const auto lightmaps = open_lightmaps(lightmaps_path);
        if (!lightmaps) return lightmaps.error();
        const LightmapsView maps = *lightmaps ? (*lightmaps)->view() : LightmapsView{};
        if (auto status = check_reflections(*scene, *places, settings, maps); !status)
            return in_file(status.error());
        if (*lightmaps) {
            if (auto status = check_lightmap_scene(maps, *scene); !status)
                return in_file(status.error());
        }
        return explain(*scene, {MixedLighting::Indirect, settings.layers}, common);
    }

    Status run_bake() {
        std::vector<std::string> others = scene_options.inputs();
        others.push_back(places_path);
        others.push_back(lightmaps_path);
        if (auto status = check_output(output, others); !status) return status;
        if (auto status = storing.check_progress_file(others); !status) return status;
        if (auto status = storing.open(); !status) return status;
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto places = places_of(*scene);
        if (!places) return places.error();
        const auto lightmaps = open_lightmaps(lightmaps_path);
        if (!lightmaps) return lightmaps.error();
        ProgressFile file(storing.progress_file, kTexelRows);
        BakeProgressDisplay display(common.is_quiet, 0.0, &file);
        const auto baked = bake_reflections(
            *scene, *places, settings,
            [&](const BakeProgress& progress) { return display.show(progress); },
            {*lightmaps ? (*lightmaps)->view() : LightmapsView{}, storing.storage()});
        if (!baked && baked.error().code == ErrorCode::Cancelled) return storing.interrupted();
        if (!baked) return in_file(baked.error());
        common.warn(baked->warnings);
        storing.warn(baked->stored, common);
        if (places->empty()) warn_of_sky_alone();
        if (auto status = write_reflection_file(output, baked->reflections); !status) return status;
        report(*baked);
        storing.finish(baked->stored);
        return Ok{};
    }

    /// With the name of the file that an error is about.
    [[nodiscard]] Error in_file(const Error& error) const {
        if (error.code != ErrorCode::InvalidArgument && error.code != ErrorCode::NotFound)
            return error;
        const bool is_of_lightmaps = error.field == "lightmaps" || error.field == "scene";
        const bool is_of_places = error.field == "probes" || error.field == "name";
        const std::string& path = is_of_lightmaps && !lightmaps_path.empty() ? lightmaps_path
                                  : is_of_places && !places_path.empty()     ? places_path
                                                                             : scene_options.path;
        return error.in(shown_path(path));
    }

    [[nodiscard]] Result<std::vector<ReflectionPlace>> places_of(const Scene& scene) const {
        if (!given_places.empty()) return given_places;
        const std::string& path = places_path.empty() ? scene_options.path : places_path;
        const auto all = places_path.empty() ? Result(scene.reflection_places) : read_places();
        if (!all || names.empty()) return all;
        std::vector<ReflectionPlace> places;
        for (const std::string& name : names) {
            const auto place = std::ranges::find(*all, name, &ReflectionPlace::name);
            if (place == all->end()) {
                return Error{
                    ErrorCode::NotFound, "probe", name,
                    str_cat(shown_path(path), ": no reflection probe \"", name, "\" is there")};
            }
            places.push_back(*place);
        }
        return places;
    }

    [[nodiscard]] Result<std::vector<ReflectionPlace>> read_places() const {
        if (places_path.ends_with(".json")) return read_reflection_places_json(places_path);
        auto scene = read_gltf(places_path);
        if (!scene) return scene.error();
        return std::move(scene->reflection_places);
    }

    void warn_of_sky_alone() const {
        const std::string& path = places_path.empty() ? scene_options.path : places_path;
        common.warn({str_cat(shown_path(path), ": has no reflection probes; ", shown_path(output),
                             " holds the sky alone")});
    }

    void report(const BakedReflections& baked) const {
        const Reflections& all = baked.reflections;
        const std::vector<std::string_view> all_names(all.names.begin(), all.names.end());
        common.report(
            output,
            {{"output", output},
             {"cube_size", all.size},
             {"levels", all.levels.size()},
             {"layers", split_names(all.layer_names)},
             {"probes", probes_json(all, baked.facts)},
             {"rays", baked.ray_count},
             {"seconds", {{"bake", baked.bake_seconds}, {"prefilter", baked.prefilter_seconds}}}},
            str_cat(output, ": ", counted(all.probes.size(), "reflection probe"), " of ", all.size,
                    " x ", all.size, ", ", counted(all.levels.size(), "level"), "; bake ",
                    duration(baked.bake_seconds), ", prefilter ", duration(baked.prefilter_seconds),
                    "\n", reflection_table(all.probes, all_names)));
    }
};

}  // namespace

Status run_reflect(const Values& values) {
    return Reflect(values).run();
}

}  // namespace tetralight::cli
