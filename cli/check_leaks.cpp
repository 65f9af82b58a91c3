// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/check_leaks.h>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/leak_report.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/render/leak_picture.h>

namespace tetralight::cli {
namespace {

struct CheckLeaks {
    std::string volume_path;
    SceneOptions scene_options;
    std::string picture;
    LeakSettings settings;
    bool lists_all_places = false;
    /// 0: none.
    double max_leak = 0.0;
    CommonOptions common;

    explicit CheckLeaks(const Values& values)
        : volume_path(values.text("volume")),
          scene_options(values),
          picture(values.text("picture")),
          lists_all_places(values.flag("all_places")),
          max_leak(values.is_given("max_leak") ? values.number("max_leak") : 0.0),
          common(values) {
        settings.place_count = values.integer32("places");
        settings.sample_count = values.integer32("samples");
        settings.clearance = values.number32("clearance");
        settings.seed = values.integer("seed");
        settings.thread_count = common.thread_count;
    }

    Status run() const {
        if (auto status = check_picture(); !status) return status;
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        if (auto status = check_scene(*scene, file->view()); !status) return status;
        const auto report = measure(*scene, file->view());
        if (!report) return located(report.error());
        warn_of_few_places(*report);
        if (!picture.empty()) {
            if (auto status = draw(*scene, file->view(), *report); !status) return status;
        }
        return judge(*report);
    }

    [[nodiscard]] Status check_picture() const {
        if (picture.empty()) return Ok{};
        std::vector<std::string> inputs = scene_options.inputs();
        inputs.push_back(volume_path);
        return check_output(picture, inputs, "picture");
    }

    /// A limit holds for the scene of the bake alone; without one, another scene is a warning.
    [[nodiscard]] Status check_scene(const Scene& scene, const ProbeVolumeView& volume) const {
        if (!is_of_another_scene(volume.metadata, scene)) return Ok{};
        const std::string message = str_cat(
            volume_path, ": was baked from another scene, sky or sun than ", scene_options.path);
        if (max_leak > 0.0) {
            return Error{ErrorCode::InvalidArgument, "scene", scene_options.path, message};
        }
        common.warn({message});
        return Ok{};
    }

    void warn_of_few_places(const LeakReport& report) const {
        if (report.places.size() == settings.place_count) return;
        common.warn({str_cat("only ", report.places.size(), " of ", settings.place_count,
                             " places were found in free space")});
    }

    [[nodiscard]] Result<LeakReport> measure(const Scene& scene,
                                             const ProbeVolumeView& volume) const {
        BakeProgressDisplay display(common.is_quiet, 0.0);
        return check_leaks(scene, volume, settings,
                           [&](const BakeProgress& progress) { return display.show(progress); });
    }

    /// With the path of the file that an error is about.
    [[nodiscard]] Error located(const Error& error) const {
        if (error.field == "volume") return error.in(volume_path);
        return error.code == ErrorCode::Corrupt ? error.in(volume_path)
                                                : error.in(scene_options.path);
    }

    [[nodiscard]] Status draw(const Scene& scene, const ProbeVolumeView& volume,
                              const LeakReport& report) const {
        const auto image = draw_leaks(scene, volume, report, common.thread_count);
        if (!image) return image.error();
        return write_png(picture, *image);
    }

    /// Reports, and fails if more light comes through walls than is allowed.
    [[nodiscard]] Status judge(const LeakReport& report) const {
        Json json{{"file", volume_path}};
        json.update(to_json(report));
        if (lists_all_places) json["all_places"] = all_places_json(report);
        const std::string text = str_cat(printable(volume_path), ": ", to_text(report));
        const bool is_good = max_leak == 0.0 || report.through_walls.mean <= max_leak;
        if (is_good || !common.is_json) common.report(picture, json, text);
        if (is_good) return Ok{};
        Error error{
            ErrorCode::InvalidArgument, "max_leak", str_cat(max_leak),
            str_cat(volume_path, ": light through walls is ", share_text(report.through_walls.mean),
                    " of the mean light, more than ", share_text(max_leak))};
        return with_report(std::move(error), json);
    }
};

}  // namespace

Status run_check_leaks(const Values& values) {
    return CheckLeaks(values).run();
}

}  // namespace tetralight::cli
