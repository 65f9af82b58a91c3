// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/task_record.h>

#include <unistd.h>

#include <array>
#include <filesystem>
#include <set>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/json_file.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;

fs::path record_path(const std::string& job, const PlanTask& task) {
    return fs::path(job) / "done" / (task.key + ".json");
}

/// None without the file.
std::optional<uint64_t> size_of(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return std::nullopt;
    const uint64_t size = fs::file_size(path, error);
    return error ? std::nullopt : std::optional(size);
}

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

std::optional<TaskRecord> find_record(const std::string& job, const PlanFile& plan, size_t task) {
    const fs::path path = record_path(job, plan.tasks[task]);
    if (!size_of(path)) return std::nullopt;
    const Json json = read_object(path);
    const auto size = size_of(fs::path(job) / plan.tasks[task].output());
    if (!size || json.value("key", Json()) != plan.tasks[task].key ||
        json.value("bytes", Json()) != *size)
        return std::nullopt;
    const Json seconds = json.value("seconds", Json()), host = json.value("host", Json());
    return TaskRecord{
        plan.tasks[task].key, *size, seconds.is_number() ? seconds.get<double>() : 0.0,
        host.is_string() ? host.get<std::string>() : "", json.value("report", Json::object())};
}

std::string damage_of(const std::string& job, const PlanFile& plan, size_t task) {
    const PlanTask& done = plan.tasks[task];
    const Json bytes = read_object(record_path(job, done)).value("bytes", Json());
    const auto size = size_of(fs::path(job) / done.output());
    if (!bytes.is_number_unsigned() || bytes == size.value_or(0)) return "";
    return str_cat(done.output(), size ? str_cat(" has ", *size, " bytes") : " is not there",
                   ", and task ", task, " wrote ", bytes.dump(), " bytes");
}

Status write_record(const std::string& job, const PlanFile& plan, size_t task, double seconds,
                    const Json& report) {
    const PlanTask& done = plan.tasks[task];
    const Json json{
        {"name", done.name},       {"key", done.key},
        {"output", done.output()}, {"bytes", size_of(fs::path(job) / done.output()).value_or(0)},
        {"seconds", seconds},      {"host", host_name()},
        {"report", report}};
    return write_json(record_path(job, done), json);
}

std::vector<size_t> tasks_to_do(const std::string& job, const PlanFile& plan,
                                const std::vector<size_t>& tasks) {
    std::vector<size_t> missing;
    for (const size_t task : tasks)
        if (!find_record(job, plan, task)) missing.push_back(task);
    return missing;
}

void remove_other_results(const std::string& job, const PlanFile& plan) {
    std::set<std::string> names;
    for (const PlanResult& result : plan.results) names.insert(result.record_name());
    for (const PlanTask& task : plan.tasks) {
        const std::string part = fs::path(task.output()).filename().string();
        names.insert({part, part + ".store", task.key + ".json"});
    }
    for (const char* folder : {"parts", "done"}) {
        std::error_code error;
        std::vector<fs::path> others;
        for (const auto& entry : fs::directory_iterator(fs::path(job) / folder, error))
            if (!names.contains(entry.path().filename().string())) others.push_back(entry.path());
        for (const fs::path& other : others) fs::remove_all(other, error);
    }
}

}  // namespace tetralight::cli
