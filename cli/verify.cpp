// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/cli/verify_text.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/verify_volume.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

VerifySettings verify_settings(const Values& values) {
    VerifySettings settings;
    settings.probe_count = values.integer32("probes");
    settings.place_count = values.integer32("places");
    settings.clearance = values.number32("clearance");
    settings.effort.target_error = values.number("target_error");
    settings.effort.sample_count = values.integer("samples");
    settings.effort.max_sample_count = values.integer("max_samples");
    settings.time_limit_seconds = values.number("time_limit");
    if (values.is_given("bounces")) settings.bounces = values.integer32("bounces");
    settings.seed = values.integer("seed");
    settings.rules.widest_bar = values.number("max_bar");
    settings.limits = {.min_within = values.number("min_within"),
                       .max_mean_z = values.number("max_mean_z"),
                       .max_undecided = values.number("max_undecided"),
                       .max_leak_share = values.number("max_leak_share"),
                       .max_unseen_share = values.number("max_unseen_share"),
                       .max_interpolation = values.number("max_interpolation")};
    return settings;
}

struct Verify {
    std::string volume_path;
    SceneOptions scene_options;
    VerifySettings settings;
    CommonOptions common;

    explicit Verify(const Values& values)
        : volume_path(values.text("volume")),
          scene_options(values),
          settings(verify_settings(values)),
          common(values) {
        settings.thread_count = common.thread_count;
    }

    Status run() const {
        const auto file = open_probe_file(volume_path);
        if (!file) return file.error();
        const auto scene = scene_options.read();
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        if (is_of_another_scene(file->view().metadata, *scene)) {
            return Error{ErrorCode::InvalidArgument, "scene", scene_options.path,
                         str_cat(volume_path, ": was baked from another scene, sky or sun than ",
                                 scene_options.path)};
        }
        BakeProgressDisplay display(common.is_quiet, settings.time_limit_seconds);
        const auto report =
            verify_volume(*scene, file->view(), settings,
                          [&](const BakeProgress& progress) { return display.show(progress); });
        if (!report) return located(report.error());
        return judge(*report);
    }

    /// With the path of the file that an error is about.
    [[nodiscard]] Error located(const Error& error) const {
        const bool is_of_volume = error.field == "volume" || error.code == ErrorCode::Corrupt;
        return error.in(is_of_volume ? volume_path : scene_options.path);
    }

    /// Reports, and fails if a limit is not kept.
    [[nodiscard]] Status judge(const VerifyReport& report) const {
        Json json{{"file", volume_path}};
        json.update(Json::parse(verify_report_json(report)));
        const bool is_good = report.failures.empty();
        if (is_good || !common.is_json) {
            common.print(json, str_cat(printable(volume_path), ": ", verify_text(report)));
        }
        if (is_good) return Ok{};
        const VerifyFailure& first = report.failures.front();
        std::string message = str_cat(volume_path, ": ", first.message);
        if (report.failures.size() > 1) {
            message += str_cat(" (and ", counted(report.failures.size() - 1, "other failure"), ")");
        }
        return with_report({ErrorCode::InvalidArgument, first.setting, "", message}, json);
    }
};

}  // namespace

Status run_verify(const Values& values) {
    return Verify(values).run();
}

}  // namespace tetralight::cli
