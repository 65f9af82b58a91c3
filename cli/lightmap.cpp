// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/bake_storing.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/explain.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/lightmap_report.h>
#include <tetralight/cli/lightmap_settings.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/preview_files.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/cli/scene_parts_report.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/lightmap_part.h>
#include <tetralight/pipeline/preview_lightmaps.h>
#include <tetralight/pipeline/write_lightmap_glb.h>

namespace tetralight::cli {
namespace {

struct Lightmap {
    SceneOptions scene_options;
    std::string output;
    BakeLightmapsSettings settings;
    BakeStoring storing;
    ProgressFile progress;
    PreviewFiles preview;
    std::string unwrapped;
    bool is_explained = false;
    CommonOptions common;

    explicit Lightmap(const Values& values)
        : scene_options(values),
          output(values.text("output")),
          settings(lightmap_settings(values)),
          storing(values),
          progress(storing.progress_file, kTexels),
          preview(values),
          unwrapped(values.text("unwrapped")),
          is_explained(values.flag("explain")),
          common(values) {
        if (output.empty() && !is_explained) require(values, "output");
        if (!unwrapped.empty() && !unwrapped.ends_with(".glb"))
            refuse(values, "unwrapped", "expected a .glb file, not \"" + unwrapped + "\"");
    }

    Status run() { return is_explained ? run_explain() : run_bake(); }

    [[nodiscard]] Status run_explain() const {
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(warnings_beside_parts(*scene));
        if (auto status = check_lightmaps(*scene, settings); !status)
            return status.error().in(scene_options.path);
        return explain(*scene, settings.lighting, common);
    }

    Status run_bake() {
        if (auto status = check_output(output, scene_options.inputs()); !status) return status;
        if (auto status = storing.check_progress_file(scene_options.inputs()); !status)
            return status;
        if (auto status = check_preview(0); !status) return status;
        if (auto status = check_unwrapped(); !status) return status;
        if (auto status = storing.open(); !status) return status;
        const auto scene =
            scene_options.read(settings.has_normal_maps ? NormalMaps::Read : NormalMaps::Skip);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        auto prepared = prepare_lightmaps(*scene, settings);
        if (!prepared) return with_size_hint(prepared.error(), *scene).in(scene_options.path);
        if (auto status = check_preview(prepared->layout.page_count); !status) return status;
        if (auto status = write_unwrapped(*prepared); !status) return status;
        const auto start = std::chrono::steady_clock::now();
        const auto range = storing.range_of(prepared->baked.size());
        if (!range) return range.error().in(scene_options.path);
        const auto bake = bake_with_progress(*scene, *prepared, *range);
        if (!bake && bake.error().code == ErrorCode::Cancelled) return storing.interrupted();
        if (!bake) return bake.error();
        storing.warn(bake->stored, common);
        record_samples(*prepared, *bake);
        prepared->report.bake_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return storing.range ? write_range(*prepared, *bake) : write(std::move(*prepared), *bake);
    }

    [[nodiscard]] std::vector<std::string> other_files() const {
        std::vector<std::string> others = scene_options.inputs();
        others.insert(others.end(), {output, storing.progress_file});
        return others;
    }

    [[nodiscard]] Status check_unwrapped() const {
        if (unwrapped.empty()) return Ok{};
        return check_side_file(unwrapped, other_files(), "unwrapped");
    }

    [[nodiscard]] Status write_unwrapped(const PreparedLightmaps& prepared) const {
        if (unwrapped.empty()) return Ok{};
        return write_unwrapped_glb(unwrapped, scene_options.path, prepared.layout,
                                   scene_options.reading);
    }

    /// `page_count` 0: not known yet.
    [[nodiscard]] Status check_preview(uint32_t page_count) const {
        std::vector<std::string> others = other_files();
        others.push_back(unwrapped);
        return preview.check(others, page_count);
    }

    [[nodiscard]] Result<TexelBake> bake_with_progress(const Scene& scene,
                                                       const PreparedLightmaps& prepared,
                                                       PlaceRange range) {
        BakeProgressDisplay display(common.is_quiet, settings.bake.time_budget_seconds, &progress);
        LightmapPreview shown;
        if (!preview.is_empty()) {
            shown.show = [&](const LightmapsView& maps) {
                preview.write(maps);
                progress.set_preview(preview.revision());
            };
        }
        const auto bake = bake_texel_range(
            scene, prepared, range, storing.storage(),
            [&](const BakeProgress& made) { return display.show(made); }, shown);
        // Texels of a range are all that its preview ever has.
        if (bake && storing.range && !preview.is_empty())
            preview.write(preview_lightmaps(scene, prepared, *bake, nullptr).view());
        return bake;
    }

    Status write(PreparedLightmaps prepared, const TexelBake& bake) {
        const BakedLightmaps result = finish_lightmaps(std::move(prepared), bake);
        if (settings.bake.target_error > 0.0)
            progress.set_at_target(result.report.baked_count - result.report.over_target_count);
        common.warn(result.report.warnings);
        const LightmapsView maps = result.lightmaps.view();
        if (auto status = write_lightmap_file(output, maps); !status) return status;
        preview.write(maps);
        preview.warn(common);
        report_lightmaps(common, output, maps, result.report);
        storing.finish(bake.stored);
        return Ok{};
    }

    Status write_range(const PreparedLightmaps& prepared, const TexelBake& bake) {
        common.warn(prepared.report.warnings);
        if (auto status = write_lightmap_part(output, prepared, bake); !status) return status;
        preview.warn(common);
        LightmapReport light = prepared.report;
        report_texels(bake, settings.bake.target_error, light);
        Json json{{"output", output},
                  {"range", {bake.range.begin, bake.range.end}},
                  {"step", bake.range.step},
                  {"texels", bake.range.count()},
                  {"all_texels", prepared.baked.size()}};
        json.update(light_json(light));
        common.report(output, json,
                      str_cat(output, ": texels ", name_of(bake.range), " of ",
                              grouped(prepared.baked.size()), "\n  ", times_text(light), "\n  ",
                              to_text(errors_of(light))));
        storing.finish(bake.stored);
        return Ok{};
    }
};

}  // namespace

Status run_lightmap(const Values& values) {
    return Lightmap(values).run();
}

}  // namespace tetralight::cli
