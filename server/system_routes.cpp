// SPDX-License-Identifier: Apache-2.0
#include <dirent.h>
#include <sys/resource.h>

#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/openapi.h>
#include <tetralight/server/service.h>

namespace tetralight::server {
namespace {

Response plain(unsigned status, const std::string& words) {
    Response response{
        .status = status, .content_type = "text/plain; charset=utf-8", .body = words + "\n"};
    if (status == 503) response.headers.emplace_back("Retry-After", "2");
    return response;
}

/// Not ready while the server is stopping, or if its folder or database is not usable.
Response ready(const Service& service) {
    if (service.is_ending) return plain(503, "ending");
    const auto fault = service.readiness.fault();
    return fault ? plain(503, *fault) : plain(200, "ready");
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

void add_queues(const Service& service, std::vector<Figure>& figures) {
    const auto add = [&](Plan::RunOn place, const char* label) {
        figures.push_back({"waiting_requests", "Requests that wait for a thread.",
                           static_cast<double>(service.waiting_count(place)), "gauge", label});
    };
    add(Plan::RunOn::Compute, "queue=\"compute\"");
    add(Plan::RunOn::Storage, "queue=\"storage\"");
    add(Plan::RunOn::Tools, "queue=\"tools\"");
}

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

void add_process(std::vector<Figure>& figures) {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    figures.push_back({"process_cpu_seconds", "Processor time of the server without its programs.",
                       seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)});
    figures.push_back({"process_resident_bytes", "Memory in use.", resident_bytes()});
    figures.push_back({"process_open_descriptors", "Open descriptors.", open_descriptors()});
}

/// Nothing if the disk does not answer.
void add_disk(const Service& service, std::vector<Figure>& figures) {
    const auto disk = service.readiness.disk();
    if (!disk) return;
    figures.push_back({"disk_free_bytes",
                       "Space of the data folder's disk that the server may use.",
                       static_cast<double>(disk->free_bytes)});
    figures.push_back(
        {"disk_size_bytes", "Size of the data folder's disk.", static_cast<double>(disk->bytes)});
}

void add_store(const Service& service, std::vector<Figure>& figures) {
    figures.push_back({"stored_bytes", "Size of all stored files.",
                       static_cast<double>(service.store.total_bytes())});
    figures.push_back({"open_volumes", "Volumes in memory for queries.",
                       static_cast<double>(service.volumes.count())});
    for (const Kind kind : kKinds) {
        figures.push_back(
            {name_of(kind), "Stored files.", static_cast<double>(service.store.list(kind).size())});
    }
}

void add_bakes(const Service& service, std::vector<Figure>& figures) {
    const auto count = [&](const char* state) {
        return static_cast<double>(service.bakes.count(state));
    };
    figures.push_back({"bakes_queued", "Bakes that wait.", count("queued")});
    figures.push_back({"bakes_running", "Bakes that run.", count("running")});
    figures.push_back({"bakes_done", "Bakes that have ended well.", count("done")});
    figures.push_back({"bakes_failed", "Bakes that have failed.", count("failed")});
    figures.push_back({"last_bake_timestamp_seconds",
                       "When a bake last ended well, in seconds since 1970; 0 = never.",
                       service.bakes.last_done()});
}

Response metrics(Service& service) {
    std::vector<Figure> figures{
        {"build_info", "Always 1; the labels say what runs.", 1.0, "gauge",
         "version=\"" TETRALIGHT_VERSION "\",compiler=\"" __VERSION__ "\""},
        {"ready", "1 if /readyz answers 200.",
         service.is_ending || service.readiness.fault() ? 0.0 : 1.0},
        {"connections", "Open connections.", static_cast<double>(service.connection_count())},
        {"log_dropped_lines_total", "Lines of the log that stderr did not take.",
         static_cast<double>(service.log.dropped_count()), "counter"}};
    add_queues(service, figures);
    add_store(service, figures);
    add_bakes(service, figures);
    add_disk(service, figures);
    add_process(figures);
    return {.content_type = "text/plain; version=0.0.4", .body = service.metrics.text(figures)};
}

}  // namespace

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
