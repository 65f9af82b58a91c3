// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/plan_file.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/json_file.h>

namespace tetralight::cli {
namespace {

constexpr const char* kFormat = "tetralight-plan";
constexpr int kVersion = 1;

/// Takes members of JSON objects and keeps the name of the first that is missing or of another
/// type.
class Reader {
  public:
    template <class T>
    T take(const Json& object, const std::string& place, const char* name) {
        const auto found = object.find(name);
        if (found != object.end() && fits<T>(*found)) return found->get<T>();
        fail(place.empty() ? name : str_cat(place, ".", name));
        return {};
    }

    /// An array of objects; an empty one if it is none.
    const Json& objects(const Json& object, const char* name) {
        static const Json kNone = Json::array();
        const auto found = object.find(name);
        if (found == object.end() || !found->is_array()) {
            fail(name);
            return kNone;
        }
        for (size_t i = 0; i < found->size(); ++i) {
            if ((*found)[i].is_object()) continue;
            fail(str_cat(name, "[", i, "]"));
            return kNone;
        }
        return *found;
    }

    void fail(const std::string& member) {
        if (failed_.empty()) failed_ = member;
    }

    [[nodiscard]] const std::string& failed() const { return failed_; }

  private:
    template <class T>
    static bool fits(const Json& value) {
        if constexpr (std::is_same_v<T, std::string>) return value.is_string();
        if constexpr (std::is_same_v<T, Json>) return value.is_object();
        if constexpr (std::is_same_v<T, double>) return value.is_number() && value >= 0.0;
        if constexpr (std::is_same_v<T, size_t>) return value.is_number_unsigned();
        return false;
    }

    std::string failed_;
};

/// A name that stays in its folder.
bool is_file_name(const std::string& name) {
    return !name.empty() && name[0] != '.' && name.find_first_of("/\\") == std::string::npos;
}

/// A path that stays in the folder of the job.
bool is_in_job(const std::string& path) {
    const std::filesystem::path whole(path);
    return !path.empty() && whole.is_relative() &&
           std::ranges::none_of(whole, [](const auto& part) { return part == ".."; });
}

PlanTask task_from(const Json& json, const std::string& place, Reader& reader) {
    PlanTask task{
        reader.take<std::string>(json, place, "name"), reader.take<double>(json, place, "cost"),
        reader.take<double>(json, place, "rays"), reader.take<std::string>(json, place, "key"),
        reader.take<Json>(json, place, "command")};
    if (!is_file_name(task.key)) reader.fail(place + ".key");
    if (!task.command.is_object() ||
        !is_in_job(reader.take<std::string>(task.command, place + ".command", "output")))
        reader.fail(place + ".command.output");
    return task;
}

PlanResult result_from(const Json& json, const std::string& place, size_t task_count,
                       Reader& reader) {
    PlanResult result{reader.take<std::string>(json, place, "scene"),
                      reader.take<std::string>(json, place, "kind"),
                      reader.take<std::string>(json, place, "file"),
                      reader.take<std::string>(json, place, "key"),
                      reader.take<size_t>(json, place, "bytes"),
                      {},
                      reader.take<Json>(json, place, "command"),
                      reader.take<Json>(json, place, "lamps")};
    for (const auto& [member, name] : {std::pair("scene", &result.scene),
                                       {"kind", &result.kind},
                                       {"file", &result.file},
                                       {"key", &result.key}})
        if (!is_file_name(*name)) reader.fail(str_cat(place, ".", member));
    const auto tasks = json.find("tasks");
    const bool is_list = tasks != json.end() && tasks->is_array();
    if (!is_list) reader.fail(place + ".tasks");
    for (size_t i = 0; is_list && i < tasks->size(); ++i) {
        const Json& task = (*tasks)[i];
        if (task.is_number_unsigned() && task < task_count)
            result.tasks.push_back(task.get<size_t>());
        else
            reader.fail(str_cat(place, ".tasks[", i, "]"));
    }
    return result;
}

PlanScene scene_from(const Json& json, const std::string& place, Reader& reader) {
    PlanScene scene{reader.take<std::string>(json, place, "name"),
                    reader.take<Json>(json, place, "limits"),
                    reader.take<Json>(json, place, "leak_check")};
    for (const auto& [name, limit] : scene.limits.items())
        if (!limit.is_number()) reader.fail(str_cat(place, ".limits.", name));
    return scene;
}

/// Phases follow each other from the first task to the last.
void read_phases(const Json& json, PlanFile& plan, Reader& reader) {
    size_t next = 0;
    for (const Json& phase : reader.objects(json, "phases")) {
        const std::string place = str_cat("phases[", plan.phases.size(), "]");
        const PlanPhase range{reader.take<size_t>(phase, place, "begin"),
                              reader.take<size_t>(phase, place, "end")};
        if (range.begin != next || range.end < range.begin) reader.fail(place);
        next = range.end;
        plan.phases.push_back(range);
    }
    if (next != plan.tasks.size()) reader.fail("phases");
}

std::string path_of(const std::string& job) {
    return (std::filesystem::path(job) / "plan.json").string();
}

/// Returns unsupported for a file of another format or version.
Status check_version(const Json& json) {
    if (json.value("format", "") != kFormat) {
        return Error{ErrorCode::Unsupported, "format", "",
                     "is not a plan (`tetralight plan` writes them)"};
    }
    if (json.value("version", Json()) == kVersion) return Ok{};
    return Error{ErrorCode::Unsupported, "version", json.value("version", Json()).dump(),
                 str_cat("is of version ", json.value("version", Json()).dump(),
                         " of plans, and this program reads version ", kVersion)};
}

Result<PlanFile> plan_from(const Json& json) {
    if (auto status = check_version(json); !status) return status.error();
    PlanFile plan;
    Reader reader;
    for (const Json& task : reader.objects(json, "tasks"))
        plan.tasks.push_back(task_from(task, str_cat("tasks[", plan.tasks.size(), "]"), reader));
    read_phases(json, plan, reader);
    for (const Json& scene : reader.objects(json, "scenes")) {
        plan.scenes.push_back(
            scene_from(scene, str_cat("scenes[", plan.scenes.size(), "]"), reader));
    }
    for (const Json& result : reader.objects(json, "results")) {
        const std::string place = str_cat("results[", plan.results.size(), "]");
        plan.results.push_back(result_from(result, place, plan.tasks.size(), reader));
    }
    if (reader.failed().empty()) return plan;
    return Error{ErrorCode::Corrupt, reader.failed(), "",
                 str_cat(reader.failed(), " is missing or wrong")};
}

}  // namespace

std::string PlanTask::output() const {
    return command.at("output").get<std::string>();
}

std::string PlanResult::record_name() const {
    return str_cat(scene, ".", kind, ".json");
}

Result<PlanFile> read_plan(const std::string& job) {
    const std::string path = path_of(job);
    if (!std::filesystem::exists(path)) {
        return Error{ErrorCode::NotFound, "job", job,
                     str_cat(path, " is not there: ", job,
                             " is not a job (`tetralight plan` makes "
                             "them)")};
    }
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    // Lists of tasks are long, but no object has many members.
    if (!Json::accept(text)) return Error{ErrorCode::Corrupt, str_cat(path, ": is not JSON")};
    const Json json = Json::parse(text);
    auto plan = json.is_object()
                    ? plan_from(json)
                    : Result<PlanFile>(Error{ErrorCode::Corrupt, "is not a JSON object"});
    if (!plan) return plan.error().in(path);
    return plan;
}

Status write_plan(const std::string& job, const PlanFile& plan) {
    Json json{{"format", kFormat}, {"version", kVersion}, {"program", TETRALIGHT_VERSION}};
    json["scenes"] = Json::array();
    for (const PlanScene& scene : plan.scenes) {
        json["scenes"].push_back(
            {{"name", scene.name}, {"limits", scene.limits}, {"leak_check", scene.leak_check}});
    }
    json["phases"] = Json::array();
    for (const PlanPhase& phase : plan.phases)
        json["phases"].push_back({{"begin", phase.begin}, {"end", phase.end}});
    json["tasks"] = Json::array();
    for (const PlanTask& task : plan.tasks) {
        json["tasks"].push_back({{"name", task.name},
                                 {"cost", task.cost},
                                 {"rays", task.rays},
                                 {"key", task.key},
                                 {"command", task.command}});
    }
    json["results"] = Json::array();
    for (const PlanResult& result : plan.results) {
        json["results"].push_back({{"scene", result.scene},
                                   {"kind", result.kind},
                                   {"file", result.file},
                                   {"key", result.key},
                                   {"bytes", result.bytes},
                                   {"tasks", result.tasks},
                                   {"command", result.command},
                                   {"lamps", result.lamps}});
    }
    return write_json(path_of(job), json);
}

std::string task_digits(size_t task) {
    std::string digits = std::to_string(task);
    constexpr size_t kDigits = 5;
    return std::string(kDigits - std::min(kDigits, digits.size()), '0') + digits;
}

}  // namespace tetralight::cli
