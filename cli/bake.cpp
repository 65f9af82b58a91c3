// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/bake_inputs.h>
#include <tetralight/cli/bake_report.h>
#include <tetralight/cli/bake_storing.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/explain.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_parts_report.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/preview_volume.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

struct Bake {
    BakeInputs inputs;
    std::string output;
    BakeStoring storing;
    bool is_explained = false;
    bool checks_leaks = false;
    std::string preview_path;
    Status preview_status = Ok{};
    CommonOptions common;
    GroupFiles group_files;

    explicit Bake(const Values& values)
        : inputs(values),
          output(values.text("output")),
          storing(values),
          is_explained(values.flag("explain")),
          checks_leaks(values.flag("check_leaks")),
          preview_path(values.text("preview")),
          common(values) {
        if (output.empty() && !is_explained) require(values, "output");
    }

    Status run() { return is_explained ? run_explain() : run_bake(); }

    [[nodiscard]] Status run_explain() const {
        const auto scene = inputs.scene_options.read();
        if (!scene) return scene.error();
        common.warn(warnings_beside_parts(*scene));
        return explain(*scene, inputs.settings.lighting, common);
    }

    Status run_bake() {
        if (auto status = check_output(output, inputs.paths()); !status) return status;
        if (auto status = storing.check_progress_file(inputs.paths()); !status) return status;
        if (auto status = check_preview(); !status) return status;
        if (auto status = storing.open(); !status) return status;
        auto scene = inputs.scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        auto prepared = inputs.prepare(*scene, group_files);
        if (!prepared) return prepared.error();
        common.warn(group_files.warnings());
        if (auto status = storing.reuse(*prepared, common); !status) return status;
        return bake(*scene, std::move(*prepared));
    }

    [[nodiscard]] Status check_preview() const {
        if (preview_path.empty()) return Ok{};
        std::vector<std::string> others = inputs.paths();
        others.insert(others.end(), {output, storing.progress_file});
        return check_side_file(preview_path, others, "preview");
    }

    /// Bakes, writes and reports, and then removes what was kept on the way.
    Status bake(const Scene& scene, PreparedBake prepared) {
        const auto start = std::chrono::steady_clock::now();
        const auto baked = bake_with_progress(scene, prepared);
        if (!baked) return baked.error();
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        storing.warn(baked->stored, common);
        const Status status =
            storing.range ? write_range(prepared, *baked, seconds.count())
                          : write_whole(scene, std::move(prepared), *baked, seconds.count());
        if (status) storing.finish(baked->stored);
        return status;
    }

    [[nodiscard]] Result<RangeBake> bake_with_progress(const Scene& scene,
                                                       const PreparedBake& prepared) {
        ProgressFile file(storing.progress_file);
        BakeProgressDisplay display(common.is_quiet, inputs.settings.bake.time_budget_seconds,
                                    &file);
        RangePreview preview;
        uint64_t preview_count = 0;
        if (!preview_path.empty()) {
            preview.show = [&](const PartialBake& so_far) {
                if (!preview_status) return;
                write_preview(preview_volume(prepared, so_far));
                if (preview_status) file.set_preview(++preview_count);
            };
        }
        return storing.bake(
            scene, prepared, [&](const BakeProgress& progress) { return display.show(progress); },
            preview);
    }

    /// The first failure is kept, and stops no bake; after it nothing is written.
    void write_preview(const ProbeVolume& volume) {
        if (preview_path.empty() || !preview_status) return;
        preview_status = write_probe_file(preview_path, volume.view());
        if (!preview_status)
            common.warn("the preview is not up to date: ", preview_status.error(), "");
    }

    Status write_range(const PreparedBake& prepared, const RangeBake& baked, double seconds) const {
        const auto write = inputs.prepared_path.empty() ? write_part : write_light_part;
        if (auto status = write(output, prepared, baked.partial); !status) return status;
        report_range(common,
                     {output, inputs.settings.bake, seconds, baked.stored.earlier_ray_count},
                     baked.partial, prepared.capture_positions.size());
        return Ok{};
    }

    Status write_whole(const Scene& scene, PreparedBake prepared, const RangeBake& baked,
                       double seconds) {
        const BakedVolume result =
            finish_bake(std::move(prepared), baked.partial.accumulators, baked.partial.split_rows);
        common.warn(group_files.locate(result.report.warnings));
        if (auto status = write_probe_file(output, result.volume.view()); !status) return status;
        write_preview(result.volume);
        const BakeRun run{output, inputs.settings.bake, seconds, baked.stored.earlier_ray_count};
        if (!checks_leaks) {
            report_volume(common, run, result);
            return Ok{};
        }
        const auto leaks = check_leaks(scene, result.volume.view(),
                                       {.thread_count = inputs.settings.bake.thread_count});
        if (!leaks) common.warn("light through walls could not be checked: ", leaks.error(), "");
        report_volume(common, run, result, leaks ? &*leaks : nullptr);
        return Ok{};
    }
};

}  // namespace

Status run_bake(const Values& values) {
    return Bake(values).run();
}

}  // namespace tetralight::cli
