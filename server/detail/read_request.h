// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <optional>

#include <tetralight/server/detail/session.h>
#include <tetralight/server/http.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/settings.h>

namespace tetralight::server {

using Parser = beast::http::request_parser<beast::http::buffer_body>;

/// The result of reading a request.
struct Reading {
    bool is_whole = false;
    /// Why it is not whole; empty if the client has disconnected.
    std::optional<Problem> refused;
};

/// Reads the head of a request into a plain value. Precondition: the request has an id; an id that
/// the client sent replaces it.
net::awaitable<Reading> read_head(Session& session, Parser& parser, const Settings& settings,
                                  Request& request);

/// Reads the body into memory or a file, as the plan says.
net::awaitable<Reading> read_body(Session& session, Parser& parser, const Settings& settings,
                                  const Plan& plan, Request& request);

}  // namespace tetralight::server
