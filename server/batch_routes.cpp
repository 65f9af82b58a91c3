// SPDX-License-Identifier: Apache-2.0
// Bakes that were ordered with the same `batch`, and one report of them.
#include <map>

#include <tetralight/base/str_cat.h>
#include <tetralight/batch/batch_report.h>
#include <tetralight/batch/limits.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

std::string batch_of(const Json& bake) {
    const Json& request = bake["request"];
    return request.is_object() ? request.value("batch", "") : "";
}

/// "probes" where a route has "volumes".
std::string kind_of_light(const std::string& kind) {
    return kind == name_of(Kind::Volumes) ? "probes" : kind;
}

/// All times that the report of a bake has.
double seconds_of(const Json& report) {
    double sum = 0.0;
    const Json seconds = report.value("seconds", Json());
    if (seconds.is_number()) return seconds.get<double>();
    for (const Json& part : seconds)
        if (part.is_number()) sum += part.get<double>();
    return sum;
}

/// Why a bake has no light.
std::string error_of(const Json& bake) {
    const auto state = bake["state"].get<std::string>();
    if (state == "done") return "";
    if (state == "failed") return bake.value("error", "it failed");
    return state == "cancelled" ? "it was cancelled" : str_cat("it is ", state);
}

BatchScene scene_of(Service& service, const Json& bake) {
    const Json limits = bake["request"].value("limits", Json::object());
    const auto read = read_limits(limits);
    const auto name = bake.value("name", ""), id = bake["id"].get<std::string>();
    BatchScene scene{name.empty() ? id : name, read ? *read : Json::object(), {}, error_of(bake)};
    if (!scene.error.empty()) return scene;
    const auto kind_name = bake["kind"].get<std::string>();
    const Kind kind = find_kind(kind_name).value_or(Kind::Volumes);
    const auto result = bake.value(noun_of(kind), "");
    const auto file = service.store.find(kind, result);
    const Json report = bake.value("report", Json::object());
    scene.files.push_back({kind_of_light(kind_name), result, file ? file->bytes : 0,
                           seconds_of(report), report, report.value("leaks", Json())});
    return scene;
}

/// The report, and how many bakes are in which state. Throws 404 if no bake is of this batch.
Json report_of(Service& service, const std::string& batch) {
    std::vector<BatchScene> scenes;
    std::map<std::string, size_t> states;
    const Json bakes = service.bakes.list();
    for (auto bake = bakes.rbegin(); bake != bakes.rend(); ++bake) {
        if (batch_of(*bake) != batch) continue;
        scenes.push_back(scene_of(service, *bake));
        ++states[(*bake)["state"].get<std::string>()];
    }
    if (scenes.empty())
        throw Problem{404, "not_found", "there is no such batch", "batch", batch.substr(0, 200)};
    Json report{{"batch", batch}, {"states", states}};
    report.update(batch_report(scenes));
    return report;
}

Response junit_of(Service& service, const std::string& batch) {
    return {.content_type = "application/xml", .body = junit_text(report_of(service, batch))};
}

/// Cancels what is queued or runs.
Response cancel(Service& service, const std::string& batch) {
    (void)report_of(service, batch);
    for (const Json& bake : service.bakes.list()) {
        if (batch_of(bake) != batch || is_final(bake["state"].get<std::string>())) continue;
        try {
            (void)service.bakes.cancel(bake["id"].get<std::string>());
        } catch (const Problem& problem) {
            // It has ended or was deleted since.
            if (problem.status != 409 && problem.status != 404) throw;
        }
    }
    return json_response(report_of(service, batch));
}

}  // namespace

std::vector<Route> batch_routes(Service& service) {
    return {
        {.method = "GET",
         .pattern = "/v1/batches/{batch}",
         .handle = [&](Request& r) { return json_response(report_of(service, r.captures[0])); }},
        {.method = "GET",
         .pattern = "/v1/batches/{batch}/junit",
         .handle = [&](Request& r) { return junit_of(service, r.captures[0]); }},
        {.method = "POST",
         .pattern = "/v1/batches/{batch}/cancel",
         .access = Access::Writes,
         .handle = [&](Request& r) { return cancel(service, r.captures[0]); },
         .run_on = Plan::RunOn::Storage}};
}

}  // namespace tetralight::server
