// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/batch/batch_report.h>
#include <tetralight/cli/collect.h>
#include <tetralight/cli/collect_result.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/json_file.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/submission.h>

namespace tetralight::cli {

namespace fs = std::filesystem;

namespace {

/// `results`: one for each of the plan's, in its order.
std::vector<BatchScene> batch_scenes(const PlanFile& plan,
                                     const std::vector<Result<CollectedResult>>& results) {
    std::vector<BatchScene> scenes;
    for (const PlanScene& scene : plan.scenes) {
        scenes.push_back({scene.name, scene.limits, {}});
        for (size_t i = 0; i < results.size(); ++i) {
            const PlanResult& result = plan.results[i];
            if (result.scene != scene.name) continue;
            if (results[i]) {
                scenes.back().files.push_back({result.kind, result.file, results[i]->bytes,
                                               results[i]->seconds, results[i]->report,
                                               results[i]->leaks});
            } else if (scenes.back().error.empty()) {
                scenes.back().error = error_json(results[i].error())["message"].get<std::string>();
            }
        }
    }
    return scenes;
}

Status write_report(const fs::path& folder, const Json& report) {
    if (auto status = write_json(folder / "report.json", report); !status) return status;
    const std::string text = junit_text(report);
    return write_file((folder / "report.xml").string(), std::as_bytes(std::span(text)));
}

}  // namespace

Status collect_all(const PlanFile& plan, const std::string& folder, const CommonOptions& common) {
    if (auto status = make_folder(folder, "output"); !status) return status;
    std::vector<Result<CollectedResult>> results;
    std::string text;
    std::optional<Error> failure;
    for (const PlanResult& result : plan.results) {
        results.push_back(collect_result(plan, result, folder, common));
        const auto& run = results.back();
        if (!run && run.error().code == ErrorCode::Cancelled) return run.error();
        if (!run) {
            if (!failure) failure = run.error();
            continue;
        }
        text += str_cat(
            text.empty() ? "" : "\n", run->output, ": ", run->bytes / 1024, " KiB",
            run->was_done ? ", unchanged" : str_cat(", ", duration(run->seconds), " of tasks"));
    }
    const Json report = batch_report(batch_scenes(plan, results));
    if (auto status = write_report(folder, report); !status) return status;
    Json json{{"output", folder}};
    json.update(report);
    const bool has_passed = report["passed"].get<bool>();
    if (has_passed || (!common.is_json && !text.empty())) common.print(json, text);
    if (failure) return with_report(*failure, json);
    if (has_passed) return Ok{};
    return with_report(Error{ErrorCode::InvalidArgument, "limits", "", failed_limits(report)},
                       json);
}

Status run_collect(const Values& values) {
    const std::string job = values.text("job");
    const CommonOptions common(values);
    const auto plan = read_plan(job);
    if (!plan) return plan.error();
    std::string folder = values.text("output");
    if (folder.empty()) {
        auto usual = output_of_job(job);
        if (!usual) return usual.error();
        folder = std::move(*usual);
    }
    const std::string output = fs::absolute(folder).lexically_normal().string();
    if (auto status = enter_folder(job); !status) return status;
    return collect_all(*plan, output, common);
}

}  // namespace tetralight::cli
