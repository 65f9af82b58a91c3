// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bench/harness.h>
#include <tetralight/bench/http_client.h>
#include <tetralight/bench/query_subject.h>

namespace tetralight::bench {

/// Requests of each form against plain Beast servers that call the same batch, by processor time,
/// and the forms against each other. `volume` is the id of the subject on the server.
void bench_queries_over_http(Subject& subject, const ServerProcess& ours, const std::string& volume,
                             const Options& options);

}  // namespace tetralight::bench
