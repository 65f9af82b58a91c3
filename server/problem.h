// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/error.h>
#include <tetralight/base/result.h>
#include <tetralight/server/file_ids.h>
#include <tetralight/server/http.h>
#include <tetralight/server/job.h>

namespace tetralight::server {

/// Why a request failed (RFC 9457). Handlers throw nothing else; the dispatcher turns it into a
/// response.
struct Problem {
    unsigned status = 400;
    /// For programs: "too_large". Does not change between versions.
    std::string code;
    /// For people.
    std::string detail;
    /// The member of the request that is wrong, and its value; may be empty.
    std::string field = {};
    std::string value = {};
    /// Headers of the response.
    std::vector<std::pair<std::string, std::string>> headers = {};
};

// The only places that turn an Error into a Problem. All of them answer full disks with 507
// "disk_full", files that are out of reach with 503 "unavailable", and a lack of memory,
// descriptors or processes with 503 "out_of_resources".

/// The folder of the server could not be read or written: 503 "unavailable" if a file is not there,
/// otherwise 500 "storage".
[[nodiscard]] Problem storage_problem(const Error& error);

/// The same about a file whose path clients must not see: "the volume cannot be read (...)".
[[nodiscard]] Problem storage_problem(const std::string& what, const Error& error,
                                      const std::string& path);

/// A setting of an order is wrong: otherwise 400 "invalid_value".
[[nodiscard]] Problem setting_problem(const Error& error, const Json& order);

/// A job for a request did not do what `order` asks: with the member of the order that is wrong, or
/// "body" if the order is null, because the request is an uploaded file. Precondition: its end is
/// not `Done`.
[[nodiscard]] Problem job_problem(const Settings& settings, const JobResult& result,
                                  const Request& request, const Json& order);

/// Throws a `storage_problem` for an error.
void require_stored(const Status& status);

/// The ids of a file of the server. Throws a `storage_problem` if it cannot be read.
[[nodiscard]] FileIds require_file_ids(const std::string& path);

/// The text of an error about a file of the server, without the file's path.
[[nodiscard]] std::string reason_without_path(const Error& error, const std::string& path);

/// An error as a problem's detail shows it.
[[nodiscard]] std::string detail_of(const Error& error);

/// `application/problem+json`.
[[nodiscard]] Response problem_response(const Problem& problem, const std::string& request_id);

}  // namespace tetralight::server
