// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/gate.h>

#include <algorithm>

#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

bool is_allowed_origin(const Settings& settings, std::string_view origin) {
    return std::ranges::any_of(settings.cors_origins, [&](const std::string& allowed) {
        return allowed == "*" || allowed == origin;
    });
}

/// "localhost" of "localhost:8080", "::1" of "[::1]:8080".
std::string_view host_name(std::string_view host) {
    if (host.starts_with('[')) return host.substr(1, std::min(host.find(']'), host.size()) - 1);
    return host.substr(0, host.find(':'));
}

bool is_same_name(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, {}, to_lower, to_lower);
}

bool is_own_host(const Settings& settings, std::string_view host) {
    const std::string name(host_name(host));
    return is_loopback(name) || is_same_name(name, "localhost") ||
           std::ranges::any_of(settings.allowed_hosts, [&](const std::string& allowed) {
               return is_same_name(allowed, name);
           });
}

/// What the client sent as `Authorization: Bearer`; empty if it sent none.
std::string_view token_of(const Request& request) {
    constexpr std::string_view kScheme = "Bearer ";
    const std::string_view credentials = request.header("authorization");
    const bool is_bearer = is_same_name(credentials.substr(0, kScheme.size()), kScheme);
    return is_bearer ? credentials.substr(kScheme.size()) : std::string_view();
}

}  // namespace

bool is_loopback(const std::string& address) {
    const bool is_number = address.find_first_not_of("0123456789.") == std::string::npos;
    return (address.starts_with("127.") && is_number) || address == "::1" || address == "localhost";
}

void check_gate(const Settings& settings, Tokens& tokens, const Request& request, Access access) {
    const std::string_view origin = request.header("origin");
    const std::string_view host = request.header("host");
    // A page of another site can send simple requests without a preflight.
    const bool is_own =
        origin == "http://" + std::string(host) || origin == "https://" + std::string(host);
    if (!origin.empty() && !is_own && !is_allowed_origin(settings, origin)) {
        throw Problem{403, "wrong_origin", "pages of this origin may not call", "origin",
                      std::string(origin.substr(0, 200))};
    }
    if (access == Access::Writes && settings.is_read_only) {
        throw Problem{403, "read_only", "this server is read-only"};
    }
    if (access == Access::Open) return;
    if (!tokens.are_needed()) {
        // Without a token, an unknown name may be an attack by DNS rebinding.
        if (is_own_host(settings, host)) return;
        throw Problem{403, "wrong_host", "the host must be localhost or one of --allowed-host",
                      "host", std::string(host.substr(0, 200))};
    }
    const Right right = tokens.right_of(token_of(request));
    if (right == Right::Admin || (right == Right::Read && access == Access::Reads)) return;
    if (right == Right::Read) {
        throw Problem{403, "read_only_token", "this token may only read", "authorization"};
    }
    throw Problem{401, "unauthorized", "the bearer token is missing or wrong", "authorization"};
}

void add_cors_headers(const Settings& settings, const Request& request, Response& response) {
    const std::string_view origin = request.header("origin");
    if (origin.empty() || !is_allowed_origin(settings, origin)) return;
    response.headers.emplace_back("Access-Control-Allow-Origin", origin);
    response.headers.emplace_back("Vary", "Origin");
    response.headers.emplace_back("Access-Control-Expose-Headers",
                                  "ETag, Location, X-Request-Id, X-Tetralight-Report");
}

bool is_preflight(const Request& request) {
    return request.method == "OPTIONS" && !request.header("origin").empty() &&
           !request.header("access-control-request-method").empty();
}

Response preflight_response() {
    return {
        .status = 204,
        .content_type = "",
        .headers = {{"Access-Control-Allow-Methods", "GET, POST, PATCH, DELETE"},
                    {"Access-Control-Allow-Headers",
                     "Authorization, Content-Type, If-Match, If-None-Match, Range, X-Request-Id"},
                    {"Access-Control-Max-Age", "600"}}};
}

}  // namespace tetralight::server
