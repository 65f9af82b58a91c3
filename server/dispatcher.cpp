// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/dispatcher.h>

#include <algorithm>
#include <new>

#include <tetralight/server/gate.h>

namespace tetralight::server {
namespace {

/// True if an encoded slash is part of a segment. Files of the viewer have no such names.
bool has_encoded_slash(const Request& request) {
    return std::ranges::any_of(request.segments, [](const PathSegment& segment) {
        return segment.decoded.find('/') != std::string::npos;
    });
}

/// Bodies must not be compressed.
void check_encoding(const Request& request) {
    const std::string_view encoding = request.header("content-encoding");
    if (encoding.empty() || encoding == "identity") return;
    throw Problem{415, "wrong_encoding", "bodies must not have a Content-Encoding",
                  "content-encoding", std::string(encoding.substr(0, 200))};
}

std::vector<Route> all_routes(Service& service) {
    std::vector<Route> all;
    for (auto* make : {system_routes, file_routes, section_routes, quarantine_routes, query_routes,
                       bake_routes, batch_routes, preview_routes, tool_routes}) {
        for (Route& route : make(service)) all.push_back(std::move(route));
    }
    return all;
}

}  // namespace

Dispatcher::Dispatcher(Service& service)
    : service_(service), router_(all_routes(service)), viewer_(service.settings.viewer) {}

Plan Dispatcher::plan(Request& request) const {
    Plan plan;
    plan.ignores_body = true;
    try {
        if (is_preflight(request)) {
            plan.handle = [this](Request& r) { return finish(r, preflight_response()); };
            return plan;
        }
        plan_route(request, plan);
    } catch (const Problem& problem) {
        plan.ignores_body = true;
        plan.run_on = Plan::RunOn::Network;
        plan.handle = [this, problem](Request& r) { return refuse(problem, r); };
    }
    return plan;
}

Response Dispatcher::refuse(const Problem& problem, const Request& request) const {
    return finish(request, problem_response(problem, request.id));
}

void Dispatcher::plan_route(Request& request, Plan& plan) const {
    const bool can_be_page = !service_.settings.viewer.empty() || request.path == "/";
    const bool is_reading = request.method == "GET" || request.method == "HEAD";
    const bool is_page = can_be_page && is_reading && !request.path.starts_with("/v1/") &&
                         !has_encoded_slash(request) && !is_known(request);
    if (is_page) {
        check_gate(service_.settings, service_.tokens, request, Access::Open);
        plan.route = std::string("/");
        plan.handle = [this](Request& r) { return guarded(r, [&] { return viewer_.respond(r); }); };
        return;
    }
    const Route& route = find(request);
    check_gate(service_.settings, service_.tokens, request, route.access);
    check_parameters(route, request);
    check_encoding(request);
    if (route.prepare) route.prepare(request);
    plan.ignores_body = false;
    plan.route = route.pattern;
    plan.body_limit = route.body_limit;
    plan.body_to = route.body_to;
    plan.run_on = route.run_on;
    plan.handle = [this, &route](Request& r) {
        return guarded(r, [&] { return handle(route, r); });
    };
}

/// Success means that what was written will be found: not if the database is gone.
Response Dispatcher::handle(const Route& route, Request& request) const {
    constexpr unsigned kFailed = 400;
    const bool writes = route.access == Access::Writes && route.stores;
    if (writes) service_.readiness.require_database();
    Response response = route.handle(request);
    if (writes && response.status < kFailed) service_.readiness.require_database();
    return response;
}

/// A client without the token does not learn which paths exist.
const Route& Dispatcher::find(Request& request) const {
    try {
        return router_.find(request);
    } catch (const Problem&) {
        check_gate(service_.settings, service_.tokens, request, Access::Reads);
        throw;
    }
}

bool Dispatcher::is_known(Request& request) const {
    try {
        (void)router_.find(request);
        return true;
    } catch (const Problem& problem) {
        return problem.status != 404;
    }
}

/// Turns every exception into a response.
Response Dispatcher::guarded(Request& request, const std::function<Response()>& handle) const {
    try {
        return finish(request, handle());
    } catch (const Problem& problem) {
        return refuse(problem, request);
    } catch (const std::bad_alloc&) {
        return refuse({503, "no_memory", "not enough memory"}, request);
    } catch (const std::exception& exception) {
        service_.log.write(Log::Level::Error, "a handler failed",
                           {{"request_id", request.id}, {"what", exception.what()}});
        return refuse({500, "internal", "internal error; the log has the reason"}, request);
    }
}

Response Dispatcher::finish(const Request& request, Response response) const {
    add_cors_headers(service_.settings, request, response);
    response.headers.emplace_back("X-Content-Type-Options", "nosniff");
    return response;
}

}  // namespace tetralight::server
