// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include <tetralight/server/http.h>

namespace tetralight::server {

/// Counters and durations of requests, in Prometheus' text format.
class Metrics {
  public:
    void add(const Exchange& exchange);

    std::atomic<uint64_t> positions = 0;
    std::atomic<uint64_t> quarantined = 0;
    std::atomic<uint64_t> damaged_indexes = 0;

    /// `gauges`: current values by their names.
    [[nodiscard]] std::string text(const std::map<std::string, double>& gauges) const;

  private:
    static constexpr std::array<double, 10> kBounds{0.001, 0.0025, 0.01, 0.025, 0.1,
                                                    0.25,  1.0,    2.5,  10.0,  60.0};

    /// Requests of one route and class of status.
    struct Series {
        uint64_t count = 0;
        double seconds = 0.0;
        std::array<uint64_t, kBounds.size()> below{};
    };

    mutable std::mutex mutex_;
    std::map<std::string, Series> series_;  ///< by labels
    uint64_t received_bytes_ = 0;
    uint64_t sent_bytes_ = 0;
};

}  // namespace tetralight::server
