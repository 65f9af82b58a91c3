// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <charconv>

#include <tetralight/base/file.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/ktx2.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/server/page.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

const char* content_type_of(Kind kind) {
    constexpr const char* kTypes[] = {"model/gltf-binary",        "application/octet-stream",
                                      "application/json",         "application/octet-stream",
                                      "application/octet-stream", "image/ktx2"};
    return kTypes[static_cast<size_t>(kind)];
}

bool is_ktx2(std::string_view start) {
    const auto& identifier = kKtx2Identifier;
    return std::ranges::equal(start.substr(0, identifier.size()), identifier, {},
                              [](char c) { return static_cast<uint8_t>(c); });
}

/// Why a file that begins like this is not of the kind; nothing if it may be.
const char* fault_of_start(Kind kind, std::string_view start) {
    const bool has_lightmaps = is_lightmap_file(std::as_bytes(std::span(start)));
    switch (kind) {
        case Kind::Scenes:
            return start.starts_with("glTF") ? nullptr : "is not binary glTF (.glb)";
        case Kind::Skies:
            return start.starts_with("#?") || start.starts_with("\x76\x2f\x31\x01")
                       ? nullptr
                       : "is neither Radiance (.hdr) nor OpenEXR (.exr)";
        case Kind::Groups:
            return nullptr;
        case Kind::Volumes:
            if (has_lightmaps) return "contains lightmaps, which /v1/lightmaps stores";
            if (start.starts_with("glTF")) return "is a scene, which /v1/scenes stores";
            return is_ktx2(start) ? "is a KTX file; /v1/reflections stores reflection probes"
                                  : nullptr;
        case Kind::Lightmaps:
            return has_lightmaps ? nullptr : "is not a lightmap file (.lightmaps)";
        case Kind::Reflections:
            break;
    }
    return is_ktx2(start) ? nullptr : "is not a file of reflection probes (.ktx2)";
}

/// Throws if the first bytes are not those of the kind, before a program is run.
void check_magic(Kind kind, int file) {
    char bytes[kKtx2Identifier.size()] = {};
    const ssize_t count = ::pread(file, bytes, sizeof bytes, 0);
    const std::string_view start(bytes, static_cast<size_t>(std::max<ssize_t>(count, 0)));
    if (const char* fault = fault_of_start(kind, start)) {
        throw Problem{422, "bad_data", fault, "body"};
    }
}

/// A scene without nodes, to read a sky with.
void write_empty_scene(const std::string& path) {
    const std::string scene = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{}]})";
    require_stored(write_file(path, std::as_bytes(std::span(scene))));
}

/// The name of an upload in its folder; errors of commands then begin with it.
constexpr const char* kUpload = "body";

/// The job that reads an upload and reports what it holds.
Job reading_job(Kind kind, const WorkFolder& folder) {
    switch (kind) {
        case Kind::Scenes:
            return {.command = "bake", .settings = {{"scene", kUpload}, {"explain", true}}};
        case Kind::Skies:
            write_empty_scene(folder.file("empty.gltf"));
            return {.command = "bake",
                    .settings = {{"scene", "empty.gltf"}, {"sky", kUpload}, {"explain", true}}};
        case Kind::Groups:
            return {.command = "tetrahedralize",
                    .settings = {{"groups", Json::array({kUpload})},
                                 {"output", str_cat(kResults, "/check.probes")}}};
        case Kind::Volumes:
        case Kind::Lightmaps:
        case Kind::Reflections:
            break;
    }
    return {.command = "info", .settings = {{"volume", kUpload}}};
}

/// Reads an upload as a command would, and reports what it holds. Throws if it is not usable.
Json find_facts(Service& service, Kind kind, const Request& request, const WorkFolder& folder) {
    Job job = reading_job(kind, folder);
    job.folder = folder.path();
    Json facts = run_tool(service, request, nullptr, std::move(job));
    if (facts.contains("part")) {
        throw Problem{422, "bad_data", "is a part of a bake; merge its parts first", "body"};
    }
    if (kind == Kind::Skies) return {{"warnings", facts.value("warnings", Json::array())}};
    if (kind == Kind::Groups) facts.erase("backend");
    if (kind == Kind::Scenes &&
        facts.value("triangles", uint64_t{0}) > service.settings.max_triangles) {
        throw Problem{413, "too_large",
                      str_cat("a scene may have ", service.settings.max_triangles, " triangles"),
                      "triangles", dump(facts["triangles"])};
    }
    return facts;
}

/// Opens the file that receives an upload.
void prepare_upload(Service& service, Request& request) {
    service.store.check_quota(0);
    WorkFolder folder = service.store.make_work_folder();
    request.body_file = Descriptor(
        ::open(folder.file(kUpload).c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (!request.body_file) require_stored(system_error(folder.path(), "write"));
    request.work = std::make_shared<WorkFolder>(std::move(folder));
}

Response upload(Service& service, Kind kind, Request& request) {
    const auto folder = std::static_pointer_cast<WorkFolder>(request.work);
    if (request.body_size == 0) throw Problem{400, "missing_value", "the body is empty", "body"};
    const std::string* name = request.parameter("name");
    check_name(name == nullptr ? "" : *name);
    service.store.check_quota(request.body_size);
    check_magic(kind, request.body_file.value());
    const Json facts = find_facts(service, kind, request, *folder);
    const auto added =
        service.store.add(kind, folder->file(kUpload), name == nullptr ? "" : *name, facts);
    // An earlier file of this id may have been damaged.
    if (added.is_new && kind == Kind::Volumes) service.volumes.forget(added.file.id);
    Response response = json_response(to_json_with_facts(added.file), added.is_new ? 201 : 200);
    response.headers.emplace_back("Location", str_cat("/v1/", name_of(kind), "/", added.file.id));
    return response;
}

/// `?limit=` and `?after=` an id; `?name=` one name.
Response list(Service& service, Kind kind, const Request& request) {
    const Page page = page_of(request);
    if (!page.after.empty() && !is_id(page.after)) {
        throw Problem{400, "invalid_value", "after: must be an id", "after",
                      page.after.substr(0, 200)};
    }
    const std::string* name = request.parameter("name");
    Json files = Json::array();
    Json next = nullptr;
    for (const StoredFile& file : service.store.list(kind)) {
        if (file.id <= page.after) continue;
        if (name != nullptr && !file.names.contains(*name)) continue;
        if (files.size() == page.limit) {
            next = files.back()["id"];
            break;
        }
        files.push_back(to_json(file));
    }
    return json_response({{name_of(kind), files}, {"next", next}});
}

/// The entity tag of a file's description. It changes with the names of the file, the tag of its
/// bytes does not.
std::string tag_of(const StoredFile& file) {
    const std::string text = dump(to_json_with_facts(file));
    return "\"" + sha256_hex(std::as_bytes(std::span(text))).substr(0, 32) + "\"";
}

/// Refuses an edit by a client that has seen an earlier state (`If-Match`).
Store::Condition condition_of(const Request& request) {
    const std::string known(request.header("if-match"));
    if (known.empty() && !request.has_header("if-match")) return {};
    if (known.empty()) {
        throw Problem{400, "invalid_header", "If-Match: is empty", "if-match", ""};
    }
    return [known](const StoredFile& file) {
        if (has_tag(known, tag_of(file), TagComparison::Strong)) return;
        throw Problem{412, "changed", "the file has changed since this tag was given", "if-match",
                      known.substr(0, 200)};
    };
}

Response describe(Service& service, Kind kind, const Request& request) {
    const auto file = service.store.find(kind, request.captures[0]);
    if (!file) (void)service.store.get(kind, request.captures[0]);  // throws
    const std::string tag = tag_of(*file);
    Response response = json_response(to_json_with_facts(*file));
    if (has_tag(request.header("if-none-match"), tag, TagComparison::Weak)) {
        response.status = 304;
        response.body = {};
    }
    response.headers = {{"ETag", tag}, {"Cache-Control", "private, no-cache"}};
    return response;
}

Response rename(Service& service, Kind kind, const Request& request) {
    const Json json = parse_object(request.body);
    Fields fields(json);
    if (fields.find("name") == nullptr)
        throw Problem{400, "missing_value", "name: is not given", "name"};
    const std::string name = fields.text("name");
    fields.finish();
    const StoredFile file =
        service.store.rename(kind, request.captures[0], name, condition_of(request));
    Response response = json_response(to_json(file));
    response.headers.emplace_back("ETag", tag_of(file));
    return response;
}

Response remove(Service& service, Kind kind, const Request& request) {
    const auto file = service.store.find(kind, request.captures[0]);
    service.store.remove(kind, request.captures[0], condition_of(request));
    if (file && kind == Kind::Volumes) service.volumes.forget(file->id);
    return {.status = 204, .content_type = ""};
}

Response download(Service& service, Kind kind, const Request& request) {
    const StoredFile stored = service.store.get(kind, request.captures[0]);
    const auto file = service.files.open(kind, stored.id);
    Response response =
        bytes_response(request, {file->mapping.bytes(), file}, content_type_of(kind), stored.id);
    response.is_intact = [file] { return file->is_intact(); };
    response.headers.emplace_back(
        "Content-Disposition",
        str_cat("attachment; filename=\"", stored.id, extension_of(kind), "\""));
    return response;
}

void add_routes(Service& service, Kind kind, std::vector<Route>& routes) {
    const std::string all = std::string("/v1/") + name_of(kind);
    const std::string one = all + "/{" + noun_of(kind) + "}";
    constexpr auto kStorage = Plan::RunOn::Storage;
    const uint64_t small = 65536;
    routes.push_back({.method = "POST",
                      .pattern = all,
                      .access = Access::Writes,
                      .handle = [&, kind](Request& r) { return upload(service, kind, r); },
                      .parameters = {"name"},
                      .body_limit = service.settings.max_upload_bytes,
                      .body_to = Plan::BodyTo::File,
                      .run_on = kStorage,
                      .prepare = [&](Request& r) { prepare_upload(service, r); }});
    routes.push_back({.method = "GET",
                      .pattern = all,
                      .handle = [&, kind](Request& r) { return list(service, kind, r); },
                      .parameters = {"after", "limit", "name"}});
    routes.push_back({.method = "GET", .pattern = one, .handle = [&, kind](Request& r) {
                          return describe(service, kind, r);
                      }});
    routes.push_back({.method = "PATCH",
                      .pattern = one,
                      .access = Access::Writes,
                      .handle = [&, kind](Request& r) { return rename(service, kind, r); },
                      .body_limit = small,
                      .run_on = kStorage});
    routes.push_back({.method = "DELETE",
                      .pattern = one,
                      .access = Access::Writes,
                      .handle = [&, kind](Request& r) { return remove(service, kind, r); },
                      .run_on = kStorage});
    routes.push_back({.method = "GET",
                      .pattern = one + "/file",
                      .handle = [&, kind](Request& r) { return download(service, kind, r); },
                      .run_on = Plan::RunOn::Compute});
}

}  // namespace

std::vector<Route> file_routes(Service& service) {
    std::vector<Route> routes;
    for (const Kind kind : kKinds) add_routes(service, kind, routes);
    return routes;
}

}  // namespace tetralight::server
