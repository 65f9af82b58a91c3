// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/collect_result.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/json_file.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

fs::path collected_path(const PlanResult& result) {
    return fs::path("done") / result.record_name();
}

/// When a file was written last, in ticks of the file system's clock.
int64_t written_at(const std::string& path) {
    std::error_code ignored;
    return fs::last_write_time(path, ignored).time_since_epoch().count();
}

/// What was collected before; an empty object if nothing was, or it was changed since.
Json collected_before(const PlanResult& result, const std::string& output) {
    std::error_code error;
    if (!fs::is_regular_file(output, error)) return Json::object();
    Json json = read_object(collected_path(result));
    const bool is_same = json.value("key", Json()) == result.key &&
                         json.value("output", Json()) == output &&
                         json.value("bytes", Json()) == fs::file_size(output, error) &&
                         json.value("written", Json()) == written_at(output) &&
                         json.value("report", Json()).is_object();
    return is_same ? json : Json::object();
}

/// Of the scene of these probes; an empty object: not asked for.
Json leak_check_of(const PlanFile& plan, const PlanResult& result) {
    if (result.kind != "probes") return Json::object();
    const auto scene = std::ranges::find(plan.scenes, result.scene, &PlanScene::name);
    return scene == plan.scenes.end() ? Json::object() : scene->leak_check;
}

Status join(const PlanResult& result, const std::string& output, const CommonOptions& common,
            Json& collected) {
    Json command = result.command;
    command["output"] = output;
    auto report = run_command(command, common);
    if (!report) {
        Error error = report.error();
        if (error.code == ErrorCode::Corrupt) {
            error.message =
                error.message.suffixed(" (delete a part that is damaged, and run its task again)");
        }
        return error.in(str_cat(result.scene, ": ", result.kind));
    }
    std::error_code ignored;
    collected = {{"key", result.key},
                 {"lamps", result.lamps},
                 {"output", output},
                 {"bytes", fs::file_size(output, ignored)},
                 {"written", written_at(output)},
                 {"report", std::move(*report)}};
    return write_json(collected_path(result), collected);
}

Status measure_leaks(const PlanResult& result, const std::string& output, const Json& check,
                     const CommonOptions& common, Json& collected) {
    Json command = check;
    command["volume"] = output;
    // A relit file has the light of the scene as it is now, but was baked from an earlier one.
    CommonOptions quiet = common;
    quiet.is_quiet = common.is_quiet || result.command.value("command", "") == "relight";
    auto report = run_command(command, quiet);
    if (!report) return report.error();
    collected["leak_check"] = check;
    collected["leaks"] = std::move(*report);
    return write_json(collected_path(result), collected);
}

}  // namespace

Result<CollectedResult> collect_result(const PlanFile& plan, const PlanResult& result,
                                       const std::string& folder, const CommonOptions& common) {
    std::vector<size_t> missing;
    double seconds = 0.0;
    for (const size_t task : result.tasks) {
        const auto record = find_record(".", plan, task);
        if (record)
            seconds += record->seconds;
        else
            missing.push_back(task);
    }
    if (!missing.empty()) {
        Error error = tasks_missing(missing, result.tasks.size());
        for (const size_t task : missing) {
            const std::string damage = damage_of(".", plan, task);
            if (damage.empty()) continue;
            error.message = error.message.suffixed("; " + damage);
            break;
        }
        return error.in(str_cat(result.scene, ": ", result.kind));
    }
    const std::string output = (fs::path(folder) / result.file).string();
    Json collected = collected_before(result, output);
    const bool was_done = !collected.empty();
    if (!was_done) {
        if (auto status = join(result, output, common, collected); !status) return status.error();
    }
    const Json check = leak_check_of(plan, result);
    if (!check.empty() && collected.value("leak_check", Json()) != check) {
        const auto status = measure_leaks(result, output, check, common, collected);
        if (!status) return status.error();
    }
    return CollectedResult{.output = output,
                           .was_done = was_done,
                           .bytes = collected["bytes"].get<uint64_t>(),
                           .seconds = seconds,
                           .report = collected["report"],
                           .leaks = check.empty() ? Json() : collected["leaks"]};
}

}  // namespace tetralight::cli
