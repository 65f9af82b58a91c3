// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/order.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

/// The name of a job's result in its folder.
std::string result_name(std::string_view extension) {
    return str_cat(kResults, "/result", extension);
}

std::string result_name(Kind kind) {
    return result_name(extension_of(kind));
}

/// An order and the table of its command. `kind` is the kind of the files that its members "volume"
/// and "blend" refer to, and of the file that it makes.
struct Task {
    const settings::Table& table;
    const Json& order;
    Kind kind = Kind::Volumes;
};

/// Links all files of an order into the folder of its job.
void link_files(Service& service, const Task& task, const WorkFolder& folder) {
    for (const auto& [file, name] : order_files(service.store, task.table, task.order, task.kind)) {
        service.store.link(file, folder.file(name));
    }
}

/// Runs the command that an order is for, in a folder with its files.
Json run_order(Service& service, const Request& request, const Task& task, const WorkFolder& folder,
               const std::string& output) {
    link_files(service, task, folder);
    Job job{.command = std::string(task.table.command),
            .settings = job_settings(task.table, task.order),
            .folder = folder.path()};
    job.settings["output"] = output;
    return run_tool(service, request, task.order, std::move(job));
}

/// A file that a job wrote, as a body that outlives the folder.
Body file_body(const std::string& path) {
    auto mapping = MappedFile::open(path);
    if (!mapping) throw storage_problem(mapping.error());
    const auto kept = std::make_shared<const MappedFile>(std::move(*mapping));
    return {kept->bytes(), kept};
}

/// Stores the result of a job and describes it.
Response store_result(Service& service, Kind kind, const std::string& path, const std::string& name,
                      const Json& facts, const Json& report) {
    const auto added = service.store.add(kind, path, name, facts);
    Json json = to_json(added.file);
    json["report"] = report;
    Response response = json_response(json, added.is_new ? 201 : 200);
    response.headers.emplace_back("Location", str_cat("/v1/", name_of(kind), "/", added.file.id));
    return response;
}

Json result_facts(Service& service, const Request& request, const Task& task,
                  const WorkFolder& folder) {
    return run_tool(service, request, task.order,
                    {.command = "info",
                     .settings = {{"volume", result_name(task.kind)}},
                     .folder = folder.path()});
}

/// Reads and checks the name of the result.
std::string name_of_result(const Json& order) {
    const std::string name = Fields(order).text("name");
    check_name(name);
    return name;
}

Response grid(Service& service, const Request& request) {
    Json order = parse_object(request.body);
    const std::string name = name_of_result(order);
    if (name.empty()) order.erase("name");
    check_order(settings::kGrid, order);
    const WorkFolder folder = service.store.make_work_folder();
    const std::string output = result_name(Kind::Groups);
    const Json report = run_order(service, request, {settings::kGrid, order}, folder, output);
    return store_result(service, Kind::Groups, folder.file(output), name,
                        {{"probes", report.value("probes", 0u)}}, report);
}

/// Stores the volume or the lightmaps that a command makes from an order.
Response make_stored(Service& service, const Request& request, const Task& task) {
    check_order(task.table, task.order, "name");
    const std::string name = name_of_result(task.order);
    const WorkFolder folder = service.store.make_work_folder();
    const std::string output = result_name(task.kind);
    const Json report = run_order(service, request, task, folder, output);
    return store_result(service, task.kind, folder.file(output), name,
                        result_facts(service, request, task, folder), report);
}

Response tetrahedralize(Service& service, const Request& request) {
    return make_stored(service, request, {settings::kTetrahedralize, parse_object(request.body)});
}

Response relight(Service& service, const Request& request) {
    return make_stored(service, request, {settings::kRelight, parse_object(request.body)});
}

/// Lightmaps have layers to weigh, and no sky and sun to replace.
Response relight_lightmaps(Service& service, const Request& request) {
    constexpr std::array<std::string_view, 4> kMembers{"weights", "blend", "blend_share", "name"};
    Json order = parse_object(request.body);
    for (const auto& [member, value] : order.items()) {
        if (std::ranges::find(kMembers, member) != kMembers.end()) continue;
        throw Problem{400, "unknown_member", "\"" + member + "\" is not a member of this order",
                      member, shown(value)};
    }
    order["volume"] = request.captures[0];
    return make_stored(service, request, {settings::kRelight, order, Kind::Lightmaps});
}

/// The scene with the lightmaps, or their pages as one texture.
Response export_lightmaps(Service& service, const Request& request) {
    Json order = parse_object(request.body);
    Fields fields(order);
    const std::string format = fields.text("as", "glb");
    if (format != "glb" && format != "ktx2") refuse("as", format, "glb or ktx2");
    if (order.contains("volume") || order.contains("mark")) {
        const char* member = order.contains("mark") ? "mark" : "volume";
        throw Problem{400, "unknown_member",
                      str_cat("\"", member, "\" is not a member of this order"), member,
                      shown(order[member])};
    }
    order["as"] = format;
    order["volume"] = request.captures[0];
    check_order(settings::kExport, order);
    const WorkFolder folder = service.store.make_work_folder();
    const std::string output = result_name("." + format);
    Json report =
        run_order(service, request, {settings::kExport, order, Kind::Lightmaps}, folder, output);
    for (const char* member : {"files", "warnings"}) report.erase(member);
    return {.content_type = format == "glb" ? "model/gltf-binary" : "image/ktx2",
            .headers = {{"X-Tetralight-Report", dump(report)}},
            .body = file_body(folder.file(output))};
}

/// Damage is an answer, not a problem.
Response validate_file(Service& service, const Request& request, Kind kind) {
    const Json order{{"volume", request.captures[0]}};
    const WorkFolder folder = service.store.make_work_folder();
    link_files(service, {settings::kValidate, order, kind}, folder);
    JobResult result = try_tool(service, request,
                                {.command = "validate",
                                 .settings = job_settings(settings::kValidate, order),
                                 .folder = folder.path()});
    if (!result.report.contains("is_valid")) {
        throw job_problem(service.settings, result, request, order);
    }
    return json_response(result.report);
}

Response validate(Service& service, const Request& request) {
    return validate_file(service, request, Kind::Volumes);
}

Response validate_lightmaps(Service& service, const Request& request) {
    return validate_file(service, request, Kind::Lightmaps);
}

Response validate_reflections(Service& service, const Request& request) {
    return validate_file(service, request, Kind::Reflections);
}

Response lppv(Service& service, const Request& request) {
    constexpr const char* kFormats[] = {"vdb", "nvdb", "exr", "dds", "ktx2"};
    const Json order = parse_object(request.body);
    check_order(settings::kLppv, order, "format");
    const std::string format = Fields(order).text("format", "vdb");
    if (std::ranges::find(kFormats, format) == std::end(kFormats)) {
        refuse("format", format, "vdb, nvdb, exr, dds or ktx2");
    }
    const WorkFolder folder = service.store.make_work_folder();
    const std::string output = result_name("." + format);
    Json report = run_order(service, request, {settings::kLppv, order}, folder, output);
    report.erase("warnings");
    return {.content_type = "application/octet-stream",
            .headers = {{"X-Tetralight-Report", dump(report)}},
            .body = file_body(folder.file(output))};
}

/// The report says how much light comes through walls; nothing is stored.
Response check_leaks(Service& service, const Request& request) {
    const Json order = parse_object(request.body);
    check_order(settings::kCheckLeaks, order);
    const WorkFolder folder = service.store.make_work_folder();
    const Task task{settings::kCheckLeaks, order};
    link_files(service, task, folder);
    Json report = run_tool(service, request, order,
                           {.command = std::string(task.table.command),
                            .settings = job_settings(task.table, order),
                            .folder = folder.path()});
    for (const char* member : {"file", "files"}) report.erase(member);
    return json_response(report);
}

Response render(Service& service, const Request& request) {
    const Json order = parse_object(request.body);
    check_order(settings::kRender, order);
    const WorkFolder folder = service.store.make_work_folder();
    const std::string output = result_name(".png");
    (void)run_order(service, request, {settings::kRender, order}, folder, output);
    return {.content_type = "image/png", .body = file_body(folder.file(output))};
}

}  // namespace

JobResult try_tool(Service& service, const Request& request, Job job) {
    job.limit_seconds = service.settings.tool_seconds;
    job.is_cancelled = [&] { return service.is_over || request.is_abandoned; };
    return run_job(service.settings, job);
}

Json run_tool(Service& service, const Request& request, const Json& order, Job job) {
    JobResult result = try_tool(service, request, std::move(job));
    if (result.end == JobResult::End::Done) return std::move(result.report);
    throw job_problem(service.settings, result, request, order);
}

std::vector<Route> tool_routes(Service& service) {
    const auto route = [&](const char* pattern, bool stores,
                           Response (*handle)(Service&, const Request&)) {
        return Route{
            .method = "POST",
            .pattern = pattern,
            .access = Access::Writes,
            .stores = stores,
            .handle = [&service, handle](Request& request) { return handle(service, request); },
            .body_limit = service.settings.max_body_bytes,
            .run_on = Plan::RunOn::Tools};
    };
    return {route("/v1/grid", true, grid),
            route("/v1/tetrahedralize", true, tetrahedralize),
            route("/v1/volumes/{volume}/validate", false, validate),
            route("/v1/lightmaps/{lightmaps}/validate", false, validate_lightmaps),
            route("/v1/lightmaps/{lightmaps}/relight", true, relight_lightmaps),
            route("/v1/lightmaps/{lightmaps}/export", false, export_lightmaps),
            route("/v1/reflections/{reflections}/validate", false, validate_reflections),
            route("/v1/relight", true, relight),
            route("/v1/check-leaks", false, check_leaks),
            route("/v1/lppv", false, lppv),
            route("/v1/render", false, render)};
}

}  // namespace tetralight::server
