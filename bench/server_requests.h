// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include <tetralight/bench/http_client.h>

// What the benchmarks of the service share: requests, and clients that send them.

namespace tetralight::bench {

using Clock = std::chrono::steady_clock;

[[nodiscard]] double seconds_since(Clock::time_point start);

/// A query in binary form, in floats.
[[nodiscard]] std::string binary_query(const std::string& volume,
                                       std::span<const glm::vec3> positions, uint8_t sh,
                                       uint8_t wants);

/// The same query in JSON: `{"positions":[[x,y,z],...]}`, with the shortest digits.
[[nodiscard]] std::string json_query(const std::string& volume,
                                     std::span<const glm::vec3> positions);

/// Stores a file and returns its id.
[[nodiscard]] std::string upload(uint16_t port, const std::string& kind,
                                 std::span<const std::byte> bytes);

[[nodiscard]] nlohmann::json get_json(HttpClient& client, const std::string& path);

/// Orders a bake, waits until it is done, and returns its state. `when_running` is called with the
/// path of the bake once it has started.
nlohmann::json bake(uint16_t port, const nlohmann::json& order,
                    const std::function<void(HttpClient&, const std::string&)>& when_running = {});

/// Sends a request over two connections for some seconds, each with one request at a time. Returns
/// the number of responses and sets the elapsed seconds.
[[nodiscard]] uint64_t send_for(double duration, uint16_t port, const std::string& request,
                                double& elapsed);

/// Sends requests at a fixed rate, without waiting for responses. Returns the 99th percentile of
/// the time from when a request was due to its response.
[[nodiscard]] double open_loop_p99(uint16_t port, const std::string& request,
                                   double rate_per_second,
                                   const std::function<bool(double elapsed)>& goes_on);

}  // namespace tetralight::bench
