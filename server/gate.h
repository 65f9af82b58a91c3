// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/server/http.h>
#include <tetralight/server/router.h>
#include <tetralight/server/settings.h>
#include <tetralight/server/tokens.h>

namespace tetralight::server {

/// Throws a `Problem` unless the token, the origin and the host of a request are allowed.
void check_gate(const Settings& settings, Tokens& tokens, const Request& request, Access access);

/// Lets pages of the allowed origins read a response.
void add_cors_headers(const Settings& settings, const Request& request, Response& response);

/// True for the request that a browser sends before a request to another origin.
[[nodiscard]] bool is_preflight(const Request& request);
[[nodiscard]] Response preflight_response();

/// True for addresses that only this machine can reach: "127.0.0.1", "::1".
[[nodiscard]] bool is_loopback(const std::string& address);

}  // namespace tetralight::server
