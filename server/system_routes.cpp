// SPDX-License-Identifier: Apache-2.0
#include <dirent.h>
#include <sys/resource.h>

#include <filesystem>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/openapi.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

Response plain(unsigned status, const std::string& words) {
    return {.status = status, .content_type = "text/plain; charset=utf-8", .body = words + "\n"};
}

/// Not ready while the server is stopping, or if its folder is missing.
Response ready(const Service& service) {
    if (service.is_ending) return plain(503, "ending");
    std::error_code error;
    const bool is_there = std::filesystem::is_directory(service.settings.data, error);
    return is_there ? plain(200, "ready") : plain(503, "the data folder is gone");
}

double open_descriptors() {
    double count = 0.0;
    std::error_code error;
    for ([[maybe_unused]] const auto& entry :
         std::filesystem::directory_iterator("/proc/self/fd", error)) {
        ++count;
    }
    return count;
}

double resident_bytes() {
    // The second number of the file, in pages. Files of /proc report size 0.
    double pages = 0.0;
    double resident = 0.0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
        if (std::fscanf(file, "%lf %lf", &pages, &resident) != 2) resident = 0.0;
        std::fclose(file);
    }
    return resident * 4096.0;
}

Response metrics(Service& service) {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
    };
    std::map<std::string, double> gauges{
        {"stored_bytes", static_cast<double>(service.store.total_bytes())},
        {"open_volumes", static_cast<double>(service.volumes.count())},
        {"bakes_queued", static_cast<double>(service.bakes.count("queued"))},
        {"bakes_running", static_cast<double>(service.bakes.count("running"))},
        {"bakes_done", static_cast<double>(service.bakes.count("done"))},
        {"bakes_failed", static_cast<double>(service.bakes.count("failed"))},
        {"connections", static_cast<double>(service.connection_count())},
        {"process_cpu_seconds", seconds(usage.ru_utime) + seconds(usage.ru_stime)},
        {"process_resident_bytes", resident_bytes()},
        {"process_open_descriptors", open_descriptors()}};
    for (const Kind kind : kKinds) {
        gauges[name_of(kind)] = static_cast<double>(service.store.list(kind).size());
    }
    return {.content_type = "text/plain; version=0.0.4", .body = service.metrics.text(gauges)};
}

const char* content_type_of(const std::string& extension) {
    static const std::map<std::string, const char*> kTypes{
        {".html", "text/html; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".mjs", "text/javascript; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".json", "application/json"},
        {".svg", "image/svg+xml"},
        {".png", "image/png"},
        {".ico", "image/x-icon"},
        {".wasm", "application/wasm"},
        {".woff2", "font/woff2"}};
    const auto found = kTypes.find(extension);
    return found == kTypes.end() ? "application/octet-stream" : found->second;
}

}  // namespace

Response viewer_response(const Service& service, const std::string& path) {
    namespace fs = std::filesystem;
    if (service.settings.viewer.empty()) {
        return plain(
            200,
            "This is tetralight serve. It answers requests (/openapi.json has all of them), "
            "but its viewer was not found:\nbuild it with `./run build viewer` and start the "
            "server again, or name its folder with --viewer DIR.");
    }
    std::error_code error;
    const fs::path root = fs::canonical(service.settings.viewer, error);
    const std::string relative = path == "/" ? "index.html" : path.substr(1);
    const fs::path file = error ? fs::path() : fs::canonical(root / relative, error);
    // Resolves links and `..`; the result must lie in the folder.
    const std::string prefix = root.string() + "/";
    if (error || !file.string().starts_with(prefix) || !fs::is_regular_file(file, error)) {
        throw Problem{404, "no_such_path", "there is nothing at this path", "path", path};
    }
    auto mapping = MappedFile::open(file.string());
    if (!mapping) throw Problem{404, "no_such_path", "there is nothing at this path"};
    const auto kept = std::make_shared<const MappedFile>(std::move(*mapping));
    return {
        .content_type = content_type_of(file.extension().string()),
        .headers = {{"Content-Security-Policy",
                     "default-src 'self'; img-src 'self' blob: data:; connect-src 'self' blob:; "
                     "style-src 'self'; script-src 'self' 'wasm-unsafe-eval'; "
                     "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; "
                     "form-action 'none'; frame-ancestors 'none'"},
                    {"Referrer-Policy", "no-referrer"},
                    {"Cache-Control", "no-cache"}},
        .body = {kept->bytes(), kept}};
}

std::vector<Route> system_routes(Service& service) {
    return {
        {.method = "GET",
         .pattern = "/healthz",
         .access = Access::Open,
         .handle = [](Request&) { return plain(200, "ok"); }},
        {.method = "GET",
         .pattern = "/readyz",
         .access = Access::Open,
         .handle = [&](Request&) { return ready(service); }},
        {.method = "GET",
         .pattern = "/version",
         .access = Access::Open,
         .handle =
             [](Request&) {
                 return json_response({{"name", "tetralight"}, {"version", TETRALIGHT_VERSION}});
             }},
        {.method = "GET",
         .pattern = "/openapi.json",
         .access = Access::Open,
         .handle = [document =
                        Body(openapi_document())](Request&) { return Response{.body = document}; }},
        {.method = "GET", .pattern = "/metrics", .handle = [&](Request&) {
             return metrics(service);
         }}};
}

}  // namespace tetralight::server
