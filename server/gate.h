// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/server/http.h>
#include <tetralight/server/router.h>
#include <tetralight/server/settings.h>

namespace tetralight::server {

/// Throws a `Problem` unless a request may come in at all: by its token, by the page that sends it
/// and by the name that it calls this server.
void check_gate(const Settings& settings, const Request& request, Access access);

/// Lets pages of the origins of the settings read a response.
void add_cors_headers(const Settings& settings, const Request& request, Response& response);

/// What a browser asks before it sends a request of another origin.
[[nodiscard]] bool is_preflight(const Request& request);
[[nodiscard]] Response preflight_response();

/// In a time that does not depend on where two texts differ.
[[nodiscard]] bool is_same_secret(std::string_view a, std::string_view b) noexcept;

/// "127.0.0.1", "::1": reached from this machine alone.
[[nodiscard]] bool is_loopback(const std::string& address);

}  // namespace tetralight::server
