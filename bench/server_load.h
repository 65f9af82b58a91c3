// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <tetralight/bench/harness.h>
#include <tetralight/bench/http_client.h>
#include <tetralight/bench/query_subject.h>

namespace tetralight::bench {

/// Latencies over a thousand persistent connections, each with one request at a time.
void bench_keepalive(uint16_t port, const std::string& request, const Options& options);

/// Queries while a bake runs, and the bake while queries are answered.
void bench_during_bake(const ServerProcess& ours, const std::string& scene,
                       const std::string& request);

/// `/healthz` while four clients send 40 000 positions in JSON and four pictures are rendered,
/// against a plain Beast server on the same machine.
void bench_healthz_under_load(Subject& subject, const ServerProcess& ours,
                              const std::string& volume, const std::string& scene,
                              const Options& options);

}  // namespace tetralight::bench
