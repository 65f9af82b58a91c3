// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/server/http.h>

namespace tetralight::server {

/// Why a request is not answered as asked (RFC 9457). The one thing that handlers throw: whoever
/// called them turns it into a response.
struct Problem {
    unsigned status = 400;
    /// For programs: "too_large". Stays as it is from version to version.
    std::string code;
    /// For people.
    std::string detail;
    /// The part of the request that is at fault, and its value; may be empty.
    std::string field = {};
    std::string value = {};
    /// Of the response.
    std::vector<std::pair<std::string, std::string>> headers = {};
};

/// `application/problem+json`.
[[nodiscard]] Response problem_response(const Problem& problem, const std::string& request_id);

}  // namespace tetralight::server
