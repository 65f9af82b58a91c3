// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/problem.h>

#include <algorithm>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/json.h>

namespace tetralight::server {
namespace {

struct Answer {
    unsigned status;
    const char* code;
};

/// What holds for every endpoint, and else `otherwise`.
Answer answer_for(ErrorCode code, Answer otherwise) {
    switch (code) {
        case ErrorCode::DiskFull:
            return {507, "disk_full"};
        case ErrorCode::Unavailable:
            return {503, "unavailable"};
        case ErrorCode::OutOfResources:
            return {503, "out_of_resources"};
        default:
            return otherwise;
    }
}

Problem problem_for(const Error& error, Answer otherwise) {
    const auto [status, code] = answer_for(error.code, otherwise);
    // Without a field the value is the path of a file of the server.
    return {status, code, error_text(error), error.field, error.field.empty() ? "" : error.value};
}

/// A part of an order: "weights.sun", and its value.
struct Member {
    std::string name;
    Json value;
};

/// The member or element of an order that is this word, or has it as its name.
std::optional<Member> find_word(const Json& order, const std::string& word) {
    if (word.empty()) return std::nullopt;
    for (const auto& [name, value] : order.items()) {
        if (value == word) return Member{name, value};
        if (!value.is_structured()) continue;
        for (const auto& [key, element] : value.items()) {
            if (element != word && (value.is_array() || key != word)) continue;
            return Member{value.is_array() ? str_cat(name, "[", key, "]") : name + "." + key,
                          element};
        }
    }
    return std::nullopt;
}

/// The member of an order that an error is about: the one that it names, else the one whose value
/// it has.
std::optional<Member> find_member(const Json& order, const Error& error) {
    if (!order.is_object()) return std::nullopt;
    const auto found = order.find(error.field.substr(0, error.field.find_first_of(".[")));
    if (found == order.end()) return find_word(order, error.value);
    if (const auto part = find_word(Json{{found.key(), *found}}, error.value)) return part;
    const bool is_whole = error.field == found.key() || error.value.empty();
    return Member{error.field, is_whole ? *found : Json(error.value)};
}

/// Names the member of the request that is wrong, if an error is about one.
void name_member(const Error& error, const Json& order, Problem& problem) {
    const auto member = find_member(order, error);
    problem.field = member ? member->name : order.is_null() ? "body" : "";
    problem.value = member ? shown(member->value) : "";
}

}  // namespace

Problem storage_problem(const Error& error) {
    // The store never deletes what it still names: such a file is out of reach.
    const bool is_away = error.code == ErrorCode::NotFound;
    return problem_for(error, is_away ? Answer{503, "unavailable"} : Answer{500, "storage"});
}

Problem storage_problem(const std::string& what, const Error& error, const std::string& path) {
    Problem problem = storage_problem(error);
    problem.detail = str_cat("the ", what, " ", reason_without_path(error, path));
    return problem;
}

Problem setting_problem(const Error& error, const Json& order) {
    Problem problem = problem_for(error, {400, "invalid_value"});
    name_member(error, order, problem);
    if (problem.field.empty()) problem.field = error.field;  // a setting that is missing
    return problem;
}

Problem job_problem(const Settings& settings, const JobResult& result, const Request& request,
                    const Json& order) {
    using End = JobResult::End;
    switch (result.end) {
        case End::Done:
        case End::Failed:
            break;
        case End::TooSlow:
            return {504, "too_slow", str_cat("takes longer than ", settings.tool_seconds, " s")};
        case End::Cancelled:
            if (request.is_abandoned) return {499, "abandoned", "the client has disconnected"};
            return {503, "ending", "the server is stopping"};
        case End::Crashed:
            return problem_for(result.error, {500, "tool_failed"});
    }
    if (result.is_wrong_usage) return setting_problem(result.error, order);
    Problem problem = problem_for(result.error, {422, "bad_data"});
    name_member(result.error, order, problem);
    return problem;
}

void require_stored(const Status& status) {
    if (!status) throw storage_problem(status.error());
}

FileIds require_file_ids(const std::string& path) {
    auto ids = read_file_ids(path);
    if (!ids) throw storage_problem("file", ids.error(), path);
    return std::move(*ids);
}

std::string reason_without_path(const Error& error, const std::string& path) {
    const std::string& text = error_text(error);
    const std::string place = shown_path(path) + ": ";
    return text.starts_with(place) ? text.substr(place.size()) : text;
}

std::string detail_of(const Error& error) {
    return error_text(error);
}

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
