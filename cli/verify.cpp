// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/progress.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/cli/verify_page_file.h>
#include <tetralight/cli/verify_text.h>
#include <tetralight/pipeline/bake_metadata.h>
#include <tetralight/pipeline/verify_volume.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

/// In quotes of a shell where they are needed.
std::string shell_word(const std::string& text) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,:=+%-";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

/// A value that is not a text as an option has it: "0.5", "1,2,3".
std::string option_text(const settings::Json& value) {
    if (!value.is_array()) return value.is_string() ? value.get<std::string>() : value.dump();
    std::string text;
    for (const settings::Json& part : value) text += (text.empty() ? "" : ",") + option_text(part);
    return text;
}

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

/// The command line for a shell, with all settings that were given.
std::string command_line(const Values& values) {
    std::string line = str_cat("tetralight verify ", shell_word(values.text("scene")), " ",
                               shell_word(values.text("volume")));
    values.table().for_each([&](const settings::Setting& setting) {
        if (setting.is_positional || !values.is_given(setting.name)) return;
        line += str_cat(" ", settings::shown_name(setting, settings::Form::Options));
        if (setting.type == settings::Type::Flag) return;
        const settings::Json& value = *values.find(setting.name);
        line += " " + shell_word(value.is_string() ? value.get<std::string>() : option_text(value));
    });
    return line;
}

struct Verify {
    std::string volume_path;
    std::string page_path;
    bool is_by_cycles = false;
    std::string blender;
    std::string command;
    SceneOptions scene_options;
    VerifySettings settings;
    CommonOptions common;

    explicit Verify(const Values& values)
        : volume_path(values.text("volume")),
          page_path(values.text("html")),
          is_by_cycles(values.choice("referee") == 1),
          blender(values.is_given("blender") ? values.text("blender") : "blender"),
          command(command_line(values)),
          scene_options(values),
          settings(verify_settings(values)),
          common(values) {
        settings.thread_count = common.thread_count;
        if (settings.probe_count == 0 && settings.place_count == 0)
            refuse(values, "probes", "probes and places are both 0: there is nothing to compare");
    }

    Status run() const {
        if (auto status = check_page(); !status) return status;
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
        const auto report = compare(*scene, file->view(), [&](const BakeProgress& progress) {
            return display.show(progress);
        });
        if (!report) return located(report.error());
        if (!page_path.empty()) {
            if (auto status = write_page(*scene, file->view(), *report); !status) return status;
        }
        return judge(*report);
    }

    [[nodiscard]] Result<VerifyReport> compare(const Scene& scene, const ProbeVolumeView& volume,
                                               const BakeCallback& callback) const {
        if (!is_by_cycles) return verify_volume(scene, volume, settings, callback);
        auto report = prepare_verify(scene, volume, settings);
        if (!report) return report.error();
        const CyclesProgram program{blender, scene_options.path};
        auto status = trace_report_by_cycles(scene, volume, settings, program, *report, callback);
        if (!status) return status.error();
        finish_verify(settings, *report);
        return report;
    }

    [[nodiscard]] Status check_page() const {
        if (page_path.empty()) return Ok{};
        std::vector<std::string> inputs = scene_options.inputs();
        inputs.push_back(volume_path);
        return check_output(page_path, inputs, "html");
    }

    [[nodiscard]] Status write_page(const Scene& scene, const ProbeVolumeView& volume,
                                    const VerifyReport& report) const {
        VerifyPageFacts facts{.scene_path = scene_options.path,
                              .volume_path = volume_path,
                              .version = "tetralight " TETRALIGHT_VERSION,
                              .command = command,
                              .limits = settings.limits,
                              .settings = {},
                              .pictures = {}};
        const Json baked = made_with(volume);
        for (const auto& [name, value] : baked.items()) {
            if (value.is_primitive()) {
                facts.settings.emplace_back(
                    "bake: " + name, value.is_string() ? value.get<std::string>() : dump(value));
            }
        }
        return write_verify_page(page_path, scene, volume, report, std::move(facts),
                                 common.thread_count);
    }

    /// With the path of the file that an error is about, if it is not about a setting.
    [[nodiscard]] Error located(const Error& error) const {
        if (error.field == "time_limit" || error.field == "probes") return error;
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
