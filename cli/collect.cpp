// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/collect.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/submission.h>

namespace tetralight::cli {

namespace fs = std::filesystem;

Status collect_all(const PlanFile& plan, const std::string& folder, const CommonOptions& common) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return Error{ErrorCode::Unavailable, "output", folder,
                     str_cat(folder, ": cannot be made: ", error.message())};
    }
    std::vector<ResultRun> results;
    std::string text;
    for (const PlanResult& result : plan.results) {
        auto run = collect_result(plan, result, folder, common);
        if (!run) return run.error();
        text += str_cat(
            text.empty() ? "" : "\n", run->output, ": ", run->bytes / 1024, " KiB",
            run->was_done ? ", unchanged" : str_cat(", ", duration(run->seconds), " of tasks"));
        results.push_back(std::move(*run));
    }
    const auto report = write_job_report(plan, results, folder);
    if (!report) return report.error();
    Json json{{"output", folder}};
    json.update(*report);
    common.print(json, text);
    return Ok{};
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
