// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/server/detail/session.h>
#include <tetralight/server/http.h>

namespace tetralight::server {

/// How much of an answer was sent.
struct Sent {
    uint64_t bytes = 0;  ///< of its body
    bool is_whole = false;
};

struct SendRule {
    /// Time limit of each slice of the body.
    double seconds = 0.0;
    /// True if the connection stays open for another request.
    bool keeps_open = false;
    /// Events end once it is true.
    const std::atomic<bool>& is_ending;
};

net::awaitable<Sent> send_response(Session& session, const Request& request,
                                   const Response& response, SendRule rule);

}  // namespace tetralight::server
