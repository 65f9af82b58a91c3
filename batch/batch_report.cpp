// SPDX-License-Identifier: Apache-2.0
#include <tetralight/batch/batch_report.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/batch/limits.h>

namespace tetralight {
namespace {

using settings::Json;

/// null if there is no such member.
Json member(const Json& json, const char* name) {
    return json.is_object() ? json.value(name, Json()) : Json();
}

double number_or_0(const Json& json) {
    return json.is_number() ? json.get<double>() : 0.0;
}

/// What a limit of one file is compared with; null: not known.
Json value_of(const std::string& limit, const BatchFile& file) {
    if (limit == "error") {
        const Json errors = member(file.report, "standard_error");
        return member(errors, file.kind == "probes" ? "p99" : "median");
    }
    if (limit == "leak") return member(member(file.leaks, "through_walls"), "mean");
    const Json dead = member(file.report, "dilated"), all = member(file.report, "probes");
    if (!dead.is_number() || !all.is_number()) return nullptr;
    return dead.get<double>() / std::max(all.get<double>(), 1.0);
}

Json check(const std::string& name, const Json& value, const Json& limit) {
    const bool is_kept = value.is_number() && value <= limit;
    return {{"name", name}, {"value", value}, {"limit", limit}, {"passed", is_kept}};
}

Json file_json(const BatchFile& file) {
    Json json{{"kind", file.kind},
              {"file", file.name},
              {"bytes", file.bytes},
              {"seconds", file.seconds},
              {"rays", member(file.report, "rays")},
              {"report", file.report}};
    if (!file.leaks.is_null()) json["leaks"] = file.leaks;
    return json;
}

Json scene_json(const BatchScene& scene) {
    Json files = Json::array(), checks = Json::array();
    double seconds = 0.0, rays = 0.0;
    for (const BatchFile& file : scene.files) {
        seconds += file.seconds;
        rays += number_or_0(member(file.report, "rays"));
        files.push_back(file_json(file));
        for (const auto& [name, limit] : scene.limits.items()) {
            if (!is_limited(name, file.kind)) continue;
            checks.push_back(check(str_cat(name, " of ", file.kind), value_of(name, file), limit));
        }
    }
    if (const auto limit = scene.limits.find("seconds"); limit != scene.limits.end())
        checks.push_back(check("seconds", seconds, *limit));
    const bool has_passed = scene.error.empty() && std::ranges::all_of(checks, [](const Json& one) {
                                return one["passed"].get<bool>();
                            });
    Json json{{"name", scene.name}, {"passed", has_passed}, {"seconds", seconds},
              {"rays", rays},       {"limits", checks},     {"files", files}};
    if (!scene.error.empty()) json["error"] = scene.error;
    return json;
}

/// Text of an XML attribute.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char character : without_controls(text)) {
        switch (character) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += character;
        }
    }
    return result + "\"";
}

std::string number_text(const Json& value) {
    if (!value.is_number()) return "not known";
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", value.get<double>());
    return buffer;
}

/// "error of probes is 0.023, more than 0.02".
std::string check_text(const Json& check) {
    return str_cat(check["name"].get<std::string>(), check["name"] == "seconds" ? " are " : " is ",
                   number_text(check["value"]),
                   check["value"].is_number() ? ", more than " : "; the limit is ",
                   number_text(check["limit"]));
}

/// Collects the tests of a scene.
class Suite {
  public:
    explicit Suite(const Json& scene) : name_(quoted(scene["name"].get<std::string>())) {
        for (const Json& file : scene["files"])
            add(file["kind"].get<std::string>(), "", number_text(file["seconds"]));
        for (const Json& check : scene["limits"]) {
            const bool has_passed = check["passed"].get<bool>();
            add(check["name"].get<std::string>(), has_passed ? "" : check_text(check), "0");
        }
        if (scene.contains("error")) add("bake", scene["error"].get<std::string>(), "0");
        seconds_ = number_text(scene["seconds"]);
    }

    [[nodiscard]] std::string text() const {
        return str_cat("  <testsuite name=", name_, " tests=\"", count_, "\" failures=\"",
                       failure_count_, "\" time=\"", seconds_, "\">\n", cases_, "  </testsuite>\n");
    }

  private:
    /// `failure`: empty if it has passed.
    void add(const std::string& test, const std::string& failure, const std::string& seconds) {
        ++count_;
        cases_ += str_cat("    <testcase classname=", name_, " name=", quoted(test), " time=\"",
                          seconds, "\"");
        if (failure.empty()) {
            cases_ += "/>\n";
            return;
        }
        ++failure_count_;
        cases_ += str_cat("><failure message=", quoted(failure), "/></testcase>\n");
    }

    std::string name_;
    std::string seconds_;
    std::string cases_;
    size_t count_ = 0;
    size_t failure_count_ = 0;
};

}  // namespace

Json batch_report(std::span<const BatchScene> scenes) {
    Json list = Json::array();
    bool has_passed = true;
    for (const BatchScene& scene : scenes) {
        list.push_back(scene_json(scene));
        has_passed = has_passed && list.back()["passed"].get<bool>();
    }
    return {{"passed", has_passed}, {"scenes", std::move(list)}};
}

std::string junit_text(const Json& report) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
    for (const Json& scene : report["scenes"]) text += Suite(scene).text();
    return text + "</testsuites>\n";
}

std::string failed_limits(const Json& report) {
    std::string text;
    const auto add = [&](const Json& scene, const std::string& what) {
        text += str_cat(text.empty() ? "" : "; ", scene["name"].get<std::string>(), ": ", what);
    };
    for (const Json& scene : report["scenes"]) {
        if (scene.contains("error")) add(scene, scene["error"].get<std::string>());
        for (const Json& check : scene["limits"])
            if (!check["passed"].get<bool>()) add(scene, check_text(check));
    }
    return text;
}

}  // namespace tetralight
