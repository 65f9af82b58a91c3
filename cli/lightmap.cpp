// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/bake_settings.h>
#include <tetralight/cli/bake_storing.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/lightmap_settings.h>

namespace tetralight::cli {
namespace {

/// Samples are as many as were asked for, or as many as the default error takes.
BakeLightmapsSettings lightmap_settings(const Values& values) {
    BakeLightmapsSettings settings;
    for_each_lightmap_setting(settings, [&](const char* name, auto& member, Recorded) {
        read_if_any(values, name, member);
    });
    BakeSettings& bake = settings.bake;
    if (takes_default_target(bake, values)) bake = with_default_texel_target(bake);
    settings.layout.thread_count = settings.texels.thread_count = bake.thread_count;
    return settings;
}

struct Lightmap {
    SceneOptions scene_options;
    std::string output;
    BakeLightmapsSettings settings;
    BakeStoring storing;
    CommonOptions common;

    explicit Lightmap(const Values& values)
        : scene_options(values),
          output(values.text("output")),
          settings(lightmap_settings(values)),
          storing(values),
          common(values) {}

    Status run() {
        if (auto status = check_output(output, scene_options.inputs()); !status) return status;
        if (auto status = storing.check_progress_file(scene_options.inputs()); !status)
            return status;
        if (auto status = storing.open(); !status) return status;
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        auto prepared = prepare_lightmaps(*scene, settings);
        if (!prepared) return prepared.error();
        const auto start = std::chrono::steady_clock::now();
        const auto bake = bake_with_progress(*scene, *prepared);
        if (!bake && bake.error().code == ErrorCode::Cancelled) return storing.interrupted();
        if (!bake) return bake.error();
        storing.warn(bake->stored, common);
        prepared->report.bake_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return write(*scene, std::move(*prepared), *bake);
    }

    [[nodiscard]] Result<TexelBake> bake_with_progress(const Scene& scene,
                                                       const PreparedLightmaps& prepared) {
        BakeProgressDisplay display(common.is_quiet, settings.bake.time_budget_seconds,
                                    storing.progress_file, "texels");
        return bake_texels(scene, prepared, storing.storage(),
                           [&](const BakeProgress& progress) { return display.show(progress); });
    }

    Status write(const Scene& scene, PreparedLightmaps prepared, const TexelBake& bake) {
        const BakedLightmaps result = finish_lightmaps(scene, std::move(prepared), bake);
        common.warn(result.report.warnings);
        const LightmapsView maps = result.lightmaps.view();
        if (auto status = write_lightmap_file(output, maps); !status) return status;
        report(maps, result.report);
        storing.finish(bake.stored);
        return Ok{};
    }

    void report(const LightmapsView& maps, const LightmapReport& report) const {
        const Json json{
            {"output", output},
            {"pages", maps.info.page_count},
            {"page_size", maps.info.page_size},
            {"charts", report.chart_count},
            {"texels", report.texel_count},
            {"invalid", report.invalid_count},
            {"baked", report.baked_count},
            {"standard_error", {{"median", report.median_error}, {"worst", report.worst_error}}},
            {"over_target", report.over_target_count},
            {"seams", report.seam_count},
            {"seam_difference",
             {{"baked", report.seam_difference_baked}, {"stitched", report.seam_difference}}},
            {"rays", report.ray_count},
            {"seconds",
             {{"layout", report.layout_seconds},
              {"texels", report.texel_seconds},
              {"bake", report.bake_seconds}}}};
        common.report(
            output, json,
            str_cat(output, ": ", counted(maps.info.page_count, "page"), " of ",
                    maps.info.page_size, " x ", maps.info.page_size, ", ",
                    counted(report.chart_count, "chart"), ", ",
                    counted(report.texel_count, "texel"), " (", grouped(report.invalid_count),
                    " inside geometry)\n  layout ", duration(report.layout_seconds), ", texels ",
                    duration(report.texel_seconds), ", bake ", duration(report.bake_seconds), " (",
                    magnitude(static_cast<double>(report.ray_count)), "rays)\n  ",
                    counted(report.seam_count, "seam"), ", 99 % differ by less than ",
                    percent(report.seam_difference), " (", percent(report.seam_difference_baked),
                    " before they were stitched)", "\n  standard error: median ",
                    percent(report.median_error), ", worst ", percent(report.worst_error)));
    }
};

}  // namespace

Status run_lightmap(const Values& values) {
    return Lightmap(values).run();
}

}  // namespace tetralight::cli
