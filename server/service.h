// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include <tetralight/server/bakes.h>
#include <tetralight/server/job.h>
#include <tetralight/server/log.h>
#include <tetralight/server/metrics.h>
#include <tetralight/server/open_volumes.h>
#include <tetralight/server/readiness.h>
#include <tetralight/server/router.h>
#include <tetralight/server/settings.h>
#include <tetralight/server/store.h>
#include <tetralight/server/tokens.h>
#include <tetralight/server/verified_files.h>

namespace tetralight::server {

/// What handlers use.
struct Service {
    const Settings& settings;
    Log& log;
    Metrics& metrics;
    Store& store;
    OpenVolumes& volumes;
    Bakes& bakes;
    const Readiness& readiness;
    Tokens& tokens;
    VerifiedFiles& files;
    /// True once no more requests are accepted.
    std::atomic<bool> is_ending = false;
    /// True once jobs of requests must end.
    std::atomic<bool> is_over = false;
    std::function<uint32_t()> connection_count = [] { return 0u; };
    /// Requests that wait for a thread.
    std::function<size_t(Plan::RunOn)> waiting_count = [](Plan::RunOn) { return size_t{0}; };
};

// The routes by subject.
[[nodiscard]] std::vector<Route> file_routes(Service& service);
[[nodiscard]] std::vector<Route> section_routes(Service& service);
[[nodiscard]] std::vector<Route> quarantine_routes(Service& service);
[[nodiscard]] std::vector<Route> query_routes(Service& service);
[[nodiscard]] std::vector<Route> bake_routes(Service& service);
[[nodiscard]] std::vector<Route> batch_routes(Service& service);
[[nodiscard]] std::vector<Route> preview_routes(Service& service);
[[nodiscard]] std::vector<Route> tool_routes(Service& service);
[[nodiscard]] std::vector<Route> system_routes(Service& service);

/// Runs a job for a request, for at most the time that the settings allow; it ends early if the
/// server ends or the client disconnects. Gives its report. Throws a `Problem`: about a member of
/// `order`, or about "body" where the request has no order but an uploaded file.
Json run_tool(Service& service, const Request& request, const Json& order, Job job);

/// The same without throwing if the job fails.
[[nodiscard]] JobResult try_tool(Service& service, const Request& request, Job job);

/// Bytes of a file as a response, whole or by the ranges that the request asks for.
[[nodiscard]] Response bytes_response(const Request& request, const Body& body,
                                      const std::string& content_type, const std::string& tag);

}  // namespace tetralight::server
