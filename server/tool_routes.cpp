// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/arguments.h>
#include <tetralight/server/command.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>
#include <tetralight/server/tool_problem.h>

namespace tetralight::server {
namespace {

using enum ValueKind;

constexpr OptionRule kGridRules[] = {
    {"mode", Text},           {"spacing", Scale},   {"min", Vector},       {"max", Vector},
    {"bounds_of", Texts},     {"heights", Numbers}, {"clearance", Number}, {"unreachable", Text},
    {"target_error", Number}, {"bounces", Integer}, {"seed", Integer},     {"region_size", Number},
    {"max_probes", Integer}};

constexpr OptionRule kLppvRules[] = {
    {"object", Text},    {"bounds", Numbers}, {"axes", Text},         {"resolution", Numbers},
    {"density", Number}, {"placement", Text}, {"unity_limits", Flag}, {"mode", Text},
    {"precision", Text}, {"layout", Text},    {"sparse", Flag},       {"reach", Number}};

constexpr OptionRule kRenderRules[] = {
    {"camera", Text},     {"width", Integer},       {"height", Integer},   {"antialias", Integer},
    {"exposure", Number}, {"eye", Vector},          {"target", Vector},    {"fov", Number},
    {"wireframe", Flag},  {"probe_radius", Number}, {"probe_color", Text}, {"lppv_radius", Number},
    {"movers", Text}};

constexpr OptionRule kRelightRules[] = {{"sun_direction", Vector},
                                        {"sun_irradiance", Vector},
                                        {"sky_intensity", Number},
                                        {"sky_rotation", Number},
                                        {"blend_share", Number}};

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

std::string threads(const Service& service) {
    return str_cat("--threads=", service.settings.tool_thread_count);
}

/// Links a file that a member refers to.
void link(Service& service, Kind kind, const std::string& member, const std::string& reference,
          const std::string& path) {
    service.store.link(file_for(service, kind, member, reference), path);
}

void link_all(Service& service, const SceneInputs& inputs, const WorkFolder& folder) {
    for (const auto& [file, name] : inputs.files) service.store.link(file, folder.file(name));
}

/// A file that a command wrote, as a body; the folder may go then.
Body file_body(const std::string& path) {
    auto mapping = MappedFile::open(path);
    if (!mapping) throw storage_problem(mapping.error());
    const auto kept = std::make_shared<const MappedFile>(std::move(*mapping));
    return {kept->bytes(), kept};
}

/// Stores what a command made, and says what it is.
Response store_result(Service& service, Kind kind, const std::string& path, const std::string& name,
                      const Json& facts, const Json& report) {
    const auto added = service.store.add(kind, path, name, facts);
    Json json = to_json(added.file);
    json["report"] = report;
    Response response = json_response(json, added.is_new ? 201 : 200);
    response.headers.emplace_back("Location", str_cat("/v1/", name_of(kind), "/", added.file.id));
    return response;
}

Json volume_facts(Service& service, const Request& request, const WorkFolder& folder) {
    return run_tool(service, request, folder.path(), {"info", "out.probes", "--json"});
}

Response grid(Service& service, const Request& request) {
    const Json json = parse_object(request.body);
    Fields fields(json);
    const SceneInputs scene = read_scene(service, fields);
    std::vector<std::string> arguments{"grid", "scene.glb", "--output=out.json", "--json",
                                       threads(service)};
    append(arguments, scene.arguments);
    append(arguments, make_arguments(fields, kGridRules));
    if (const Json* seeds = fields.find("from")) {
        if (!seeds->is_array()) refuse("from", *seeds, "an array of positions");
        for (const Json& seed : *seeds) {
            const Json one{{"from", seed}};
            Fields field(one);
            constexpr OptionRule kRule[] = {{"from", Vector}};
            append(arguments, make_arguments(field, kRule));
        }
    }
    const std::string name = fields.text("name");
    check_name(name);
    if (!name.empty()) arguments.push_back("--name=" + name);
    fields.finish();
    const WorkFolder folder = service.store.make_work_folder();
    link_all(service, scene, folder);
    const Json report = run_tool(service, request, folder.path(), arguments);
    return store_result(service, Kind::Groups, folder.file("out.json"), name,
                        {{"probes", report.value("probes", 0u)}}, report);
}

Response tetrahedralize(Service& service, const Request& request) {
    const Json json = parse_object(request.body);
    Fields fields(json);
    const WorkFolder folder = service.store.make_work_folder();
    std::vector<std::string> arguments{"tetrahedralize", "--output=out.probes", "--json"};
    const auto groups = fields.texts("groups");
    if (groups.empty()) throw Problem{400, "missing_value", "groups: is not given", "groups"};
    for (size_t i = 0; i < groups.size(); ++i) {
        const std::string name = str_cat("groups_", i, ".json");
        link(service, Kind::Groups, str_cat("groups[", i, "]"), groups[i], folder.file(name));
        arguments.push_back(name);
    }
    constexpr OptionRule kRules[] = {{"weld", Number}, {"backend", Text}};
    append(arguments, make_arguments(fields, kRules));
    const std::string name = fields.text("name");
    fields.finish();
    const Json report = run_tool(service, request, folder.path(), arguments);
    return store_result(service, Kind::Volumes, folder.file("out.probes"), name,
                        volume_facts(service, request, folder), report);
}

CommandResult run_for(Service& service, const Request& request, const std::string& folder,
                      std::vector<std::string> arguments) {
    return run_command(service.settings,
                       {.arguments = std::move(arguments),
                        .folder = folder,
                        .limit_seconds = service.settings.tool_seconds,
                        .goes_on = [&] { return !service.is_over && !request.is_abandoned; }});
}

/// A volume that fails is an answer, not an error.
Response validate(Service& service, const Request& request) {
    const WorkFolder folder = service.store.make_work_folder();
    link(service, Kind::Volumes, "volume", request.captures[0], folder.file("volume.probes"));
    const CommandResult result =
        run_for(service, request, folder.path(), {"validate", "volume.probes", "--json"});
    if (!result.report.contains("is_valid")) {
        throw tool_problem(service.settings, result, request);
    }
    Json report = result.report;
    report.erase("file");
    return json_response(report);
}

std::vector<std::string> weights_arguments(Fields& fields) {
    const Json* weights = fields.find("weights");
    if (weights == nullptr) return {};
    if (!weights->is_object()) refuse("weights", *weights, "an object of numbers");
    std::vector<std::string> arguments;
    for (const auto& [layer, weight] : weights->items()) {
        if (!weight.is_number()) refuse("weights." + layer, weight, "a number");
        if (layer.find(',') != std::string::npos) refuse("weights", layer, "without commas");
        arguments.push_back(str_cat("--weights=", layer, "=", weight.get<double>()));
    }
    return arguments;
}

/// A stored sky, or a constant one.
std::vector<std::string> sky_arguments(Service& service, Fields& fields,
                                       std::vector<std::pair<StoredFile, std::string>>& files) {
    const Json* sky = fields.find("sky");
    if (sky == nullptr) return {};
    if (sky->is_string()) {
        files.emplace_back(file_for(service, Kind::Skies, "sky", sky->get<std::string>()),
                           "sky.hdr");
        return {"--sky=sky.hdr"};
    }
    const Json one{{"sky", *sky}};
    Fields field(one);
    constexpr OptionRule kRule[] = {{"sky", Scale}};
    return make_arguments(field, kRule);
}

Response relight(Service& service, const Request& request) {
    const Json json = parse_object(request.body);
    Fields fields(json);
    const WorkFolder folder = service.store.make_work_folder();
    link(service, Kind::Volumes, "volume", fields.required_text("volume"),
         folder.file("volume.probes"));
    std::vector<std::string> arguments{"relight", "volume.probes", "--output=out.probes", "--json",
                                       threads(service)};
    append(arguments, weights_arguments(fields));
    SceneInputs inputs;
    append(arguments, sky_arguments(service, fields, inputs.files));
    append(arguments, make_arguments(fields, kRelightRules));
    const std::string other = fields.text("blend");
    if (!other.empty()) {
        inputs.files.emplace_back(file_for(service, Kind::Volumes, "blend", other), "other.probes");
        arguments.push_back("--blend=other.probes");
    }
    const std::string name = fields.text("name");
    fields.finish();
    link_all(service, inputs, folder);
    const Json report = run_tool(service, request, folder.path(), arguments);
    return store_result(service, Kind::Volumes, folder.file("out.probes"), name,
                        volume_facts(service, request, folder), report);
}

Response lppv(Service& service, const Request& request) {
    constexpr const char* kFormats[] = {"vdb", "nvdb", "exr", "dds", "ktx2"};
    const Json json = parse_object(request.body);
    Fields fields(json);
    const std::string format = fields.text("format", "vdb");
    if (std::ranges::find(kFormats, format) == std::end(kFormats)) {
        refuse("format", format, "vdb, nvdb, exr, dds or ktx2");
    }
    const WorkFolder folder = service.store.make_work_folder();
    link(service, Kind::Volumes, "volume", fields.required_text("volume"),
         folder.file("volume.probes"));
    std::vector<std::string> arguments{"lppv", "volume.probes", "--output=out." + format, "--json",
                                       threads(service)};
    const std::string scene = fields.text("scene");
    if (!scene.empty()) {
        link(service, Kind::Scenes, "scene", scene, folder.file("scene.glb"));
        arguments.push_back("--scene=scene.glb");
    }
    append(arguments, make_arguments(fields, kLppvRules));
    fields.finish();
    Json report = run_tool(service, request, folder.path(), arguments);
    report.erase("warnings");
    return {.content_type = "application/octet-stream",
            .headers = {{"X-Tetralight-Report", dump(report)}},
            .body = file_body(folder.file("out." + format))};
}

Response render(Service& service, const Request& request) {
    const Json json = parse_object(request.body);
    Fields fields(json);
    const WorkFolder folder = service.store.make_work_folder();
    link(service, Kind::Scenes, "scene", fields.required_text("scene"), folder.file("scene.glb"));
    link(service, Kind::Volumes, "volume", fields.required_text("volume"),
         folder.file("volume.probes"));
    std::vector<std::string> arguments{"render",           "scene.glb", "volume.probes",
                                       "--output=out.png", "--json",    threads(service)};
    append(arguments, make_arguments(fields, kRenderRules));
    fields.finish();
    (void)run_tool(service, request, folder.path(), arguments);
    return {.content_type = "image/png", .body = file_body(folder.file("out.png"))};
}

}  // namespace

Json run_tool(Service& service, const Request& request, const std::string& folder,
              std::vector<std::string> arguments) {
    CommandResult result = run_for(service, request, folder, std::move(arguments));
    if (result.end != CommandResult::End::Fine) {
        throw tool_problem(service.settings, result, request);
    }
    const Json order = object_in(request.body);
    for (std::string& warning : result.warnings) warning = in_words_of(order, warning);
    return report_of(std::move(result));
}

StoredFile file_for(Service& service, Kind kind, const std::string& member,
                    const std::string& reference) {
    try {
        return service.store.get(kind, reference);
    } catch (Problem& problem) {
        problem.field = member;
        throw;
    }
}

SceneInputs read_scene(Service& service, Fields& fields) {
    constexpr OptionRule kRules[] = {{"sky_intensity", Number}, {"sky_rotation", Number},
                                     {"sun_direction", Vector}, {"sun_irradiance", Vector},
                                     {"sun_angle", Number},     {"sun_mode", Text}};
    SceneInputs inputs;
    inputs.files.emplace_back(
        file_for(service, Kind::Scenes, "scene", fields.required_text("scene")), "scene.glb");
    inputs.arguments = sky_arguments(service, fields, inputs.files);
    append(inputs.arguments, make_arguments(fields, kRules));
    return inputs;
}

std::vector<Route> tool_routes(Service& service) {
    const auto route = [&](const char* pattern, Access access,
                           Response (*handle)(Service&, const Request&)) {
        return Route{
            .method = "POST",
            .pattern = pattern,
            .access = access,
            .handle = [&service, handle](Request& request) { return handle(service, request); },
            .body_limit = service.settings.max_body_bytes,
            .run_on = Plan::RunOn::Workers};
    };
    return {route("/v1/grid", Access::Writes, grid),
            route("/v1/tetrahedralize", Access::Writes, tetrahedralize),
            route("/v1/volumes/{volume}/validate", Access::Writes, validate),
            route("/v1/relight", Access::Writes, relight),
            route("/v1/lppv", Access::Writes, lppv),
            route("/v1/render", Access::Writes, render)};
}

}  // namespace tetralight::server
