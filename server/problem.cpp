// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/problem.h>

#include <tetralight/server/json.h>

namespace tetralight::server {

Response problem_response(const Problem& problem, const std::string& request_id) {
    Json json{{"type", "about:blank"},
              {"title", reason_phrase(problem.status)},
              {"status", problem.status},
              {"code", problem.code},
              {"detail", problem.detail}};
    if (!problem.field.empty()) json["field"] = problem.field;
    if (!problem.value.empty()) json["value"] = problem.value;
    if (!request_id.empty()) json["request_id"] = request_id;
    Response response{.status = problem.status,
                      .content_type = "application/problem+json",
                      .headers = problem.headers,
                      .body = dump(json) + "\n"};
    if (problem.status == 401) response.headers.emplace_back("WWW-Authenticate", "Bearer");
    if (problem.status == 503) response.headers.emplace_back("Retry-After", "2");
    return response;
}

}  // namespace tetralight::server
