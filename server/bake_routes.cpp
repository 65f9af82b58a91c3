// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/server/arguments.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

constexpr OptionRule kBakeRules[] = {
    {"samples", ValueKind::Integer},       {"target_error", ValueKind::Number},
    {"max_samples", ValueKind::Integer},   {"bounces", ValueKind::Integer},
    {"clamp", ValueKind::Number},          {"albedo_boost", ValueKind::Number},
    {"max_albedo", ValueKind::Number},     {"seed", ValueKind::Integer},
    {"weld", ValueKind::Number},           {"min_validity", ValueKind::Number},
    {"virtual_offset", ValueKind::Number}, {"invalid_probes", ValueKind::Text},
    {"dering", ValueKind::Flag},           {"dering_window", ValueKind::Text},
    {"mixed_lighting", ValueKind::Text},   {"layers", ValueKind::List},
    {"only_given_groups", ValueKind::Flag}};

int64_t read_priority(Fields& fields) {
    constexpr int64_t kMost = 100;
    const Json* priority = fields.find("priority");
    if (priority == nullptr) return 0;
    const bool is_right =
        priority->is_number_integer() && *priority <= kMost && *priority >= -kMost;
    if (!is_right) refuse("priority", *priority, "a whole number from -100 to 100");
    return priority->get<int64_t>();
}

BakeOrder read_order(Service& service, const Json& json) {
    Fields fields(json);
    BakeOrder order;
    order.request = json;
    SceneInputs scene = read_scene(service, fields);
    order.inputs = std::move(scene.files);
    order.arguments = std::move(scene.arguments);
    const std::vector<std::string> groups = fields.texts("groups");
    for (size_t i = 0; i < groups.size(); ++i) {
        const std::string name = str_cat("groups_", i, ".json");
        order.inputs.emplace_back(
            file_for(service, Kind::Groups, str_cat("groups[", i, "]"), groups[i]), name);
        order.arguments.push_back("--groups=" + name);
    }
    const std::string reuse = fields.text("reuse");
    if (!reuse.empty()) {
        order.inputs.emplace_back(file_for(service, Kind::Volumes, "reuse", reuse), "reuse.probes");
        order.arguments.push_back("--reuse=reuse.probes");
    }
    const auto options = make_arguments(fields, kBakeRules);
    order.arguments.insert(order.arguments.end(), options.begin(), options.end());
    order.name = fields.text("name");
    check_name(order.name);
    order.priority = read_priority(fields);
    fields.finish();
    return order;
}

/// Has the command read options and scene, so that what is wrong is said now and not later.
void check(Service& service, const Request& request, const BakeOrder& order) {
    const WorkFolder folder = service.store.make_work_folder();
    for (const auto& [file, name] : order.inputs) service.store.link(file, folder.file(name));
    std::vector<std::string> arguments{"bake", "scene.glb", "--explain", "--json"};
    arguments.insert(arguments.end(), order.arguments.begin(), order.arguments.end());
    (void)run_tool(service, request, folder.path(), arguments);
}

Response submit(Service& service, const Request& request) {
    const BakeOrder order = read_order(service, parse_object(request.body));
    check(service, request, order);
    const Json bake = service.bakes.submit(order);
    Response response = json_response(bake, 202);
    response.headers.emplace_back("Location", "/v1/bakes/" + bake["id"].get<std::string>());
    return response;
}

/// The bake whenever it changed, and at last its end.
Response events(Service& service, const Request& request) {
    const std::string id = request.captures[0];
    (void)service.bakes.get(id);  // throws when it is not there
    Response response{.content_type = "text/event-stream",
                      .headers = {{"Cache-Control", "no-store"}}};
    response.events = [&service, id, last = std::string()](std::string& out) mutable {
        const bool is_over = service.bakes.is_over(id);
        try {
            Json bake = service.bakes.get(id);
            bake.erase("request");
            const std::string now = dump(bake);
            if (now != last) out += "event: progress\ndata: " + now + "\n\n";
            last = now;
            if (is_over) out += "event: end\ndata: " + now + "\n\n";
        } catch (const Problem&) {
            out += "event: end\ndata: {\"state\":\"deleted\"}\n\n";
            return false;
        }
        return !is_over;
    };
    return response;
}

}  // namespace

std::vector<Route> bake_routes(Service& service) {
    constexpr auto kWorkers = Plan::RunOn::Workers;
    return {
        {.method = "POST",
         .pattern = "/v1/bakes",
         .access = Access::Writes,
         .handle = [&](Request& r) { return submit(service, r); },
         .body_limit = service.settings.max_body_bytes,
         .run_on = kWorkers},
        {.method = "GET",
         .pattern = "/v1/bakes",
         .handle =
             [&](Request&) {
                 return json_response({{"bakes", service.bakes.list()}});
             }},
        {.method = "GET",
         .pattern = "/v1/bakes/{bake}",
         .handle = [&](Request& r) { return json_response(service.bakes.get(r.captures[0])); }},
        {.method = "GET",
         .pattern = "/v1/bakes/{bake}/events",
         .handle = [&](Request& r) { return events(service, r); }},
        {.method = "POST",
         .pattern = "/v1/bakes/{bake}/cancel",
         .access = Access::Writes,
         .handle = [&](Request& r) { return json_response(service.bakes.cancel(r.captures[0])); },
         .run_on = kWorkers},
        {.method = "DELETE",
         .pattern = "/v1/bakes/{bake}",
         .access = Access::Writes,
         .handle =
             [&](Request& r) {
                 service.bakes.remove(r.captures[0]);
                 return Response{.status = 204, .content_type = ""};
             },
         .run_on = kWorkers}};
}

}  // namespace tetralight::server
