// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

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
#include <tetralight/cli/reflect_inputs.h>
#include <tetralight/cli/reflection_files.h>
#include <tetralight/cli/scene_parts_report.h>
#include <tetralight/pipeline/bake_reflections.h>
#include <tetralight/pipeline/lightmap_scene.h>
#include <tetralight/reflection/reflection_file.h>

namespace tetralight::cli {
namespace {

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
    ReflectInputs inputs;
    std::string output;
    BakeStoring storing;
    bool is_explained = false;
    CommonOptions common;

    explicit Reflect(const Values& values)
        : inputs(values),
          output(values.text("output")),
          storing(values),
          is_explained(values.flag("explain")),
          common(values) {
        if (output.empty() && !is_explained) require(values, "output");
    }

    Status run() { return is_explained ? run_explain() : run_bake(); }

    [[nodiscard]] Status run_explain() const {
        const auto scene = inputs.scene_options.read();
        if (!scene) return scene.error();
        common.warn(warnings_beside_parts(*scene));
        const auto places = inputs.places(*scene);
        if (!places) return places.error();
        const auto lightmaps = open_lightmaps(inputs.lightmaps_path);
        if (!lightmaps) return lightmaps.error();
        const LightmapsView maps = *lightmaps ? (*lightmaps)->view() : LightmapsView{};
        if (auto status = check_reflections(*scene, *places, inputs.settings, maps); !status)
            return inputs.in_file(status.error());
        if (*lightmaps) {
            if (auto status = check_lightmap_scene(maps, *scene); !status)
                return inputs.in_file(status.error());
        }
        return explain(*scene, {MixedLighting::Indirect, inputs.settings.layers}, common);
    }

    Status run_bake() {
        const std::vector<std::string> others = inputs.paths();
        if (auto status = check_output(output, others); !status) return status;
        if (auto status = storing.check_progress_file(others); !status) return status;
        if (auto status = storing.open(); !status) return status;
        const auto scene = inputs.scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto places = inputs.places(*scene);
        if (!places) return places.error();
        const auto lightmaps = open_lightmaps(inputs.lightmaps_path);
        if (!lightmaps) return lightmaps.error();
        ProgressFile file(storing.progress_file, kTexelRows);
        BakeProgressDisplay display(common.is_quiet, 0.0, &file);
        const auto baked = bake_reflections(
            *scene, *places, inputs.settings,
            [&](const BakeProgress& progress) { return display.show(progress); },
            {*lightmaps ? (*lightmaps)->view() : LightmapsView{}, storing.storage()});
        if (!baked && baked.error().code == ErrorCode::Cancelled) return storing.interrupted();
        if (!baked) return inputs.in_file(baked.error());
        common.warn(baked->warnings);
        storing.warn(baked->stored, common);
        if (places->empty()) warn_of_sky_alone();
        if (auto status = write_reflection_file(output, baked->reflections); !status) return status;
        report(*baked);
        storing.finish(baked->stored);
        return Ok{};
    }

    void warn_of_sky_alone() const {
        const std::string& path =
            inputs.places_path.empty() ? inputs.scene_options.path : inputs.places_path;
        common.warn({str_cat(shown_path(path),
                             ": has no reflection probes; the result holds the sky alone")});
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
