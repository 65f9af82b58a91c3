// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>

#include <tetralight/server/http.h>

namespace tetralight::server {

/// A value that is read when metrics are asked for.
struct Figure {
    const char* name;
    const char* help;
    double value = 0.0;
    /// "gauge" or "counter".
    const char* type = "gauge";
    /// `version="0.1.0"`; may be empty.
    std::string labels = {};
};

/// Counters and durations of requests, in Prometheus' text format.
class Metrics {
  public:
    void add(const Exchange& exchange);

    std::atomic<uint64_t> positions = 0;
    std::atomic<uint64_t> quarantined = 0;
    std::atomic<uint64_t> damaged_indexes = 0;

    /// All metrics. Figures of one name follow each other.
    [[nodiscard]] std::string text(std::span<const Figure> figures) const;

  private:
    static constexpr std::array<double, 10> kBounds{0.001, 0.0025, 0.01, 0.025, 0.1,
                                                    0.25,  1.0,    2.5,  10.0,  60.0};

    /// Durations of one kind.
    struct Histogram {
        uint64_t count = 0;
        double seconds = 0.0;
        std::array<uint64_t, kBounds.size()> below{};

        void add(double duration);
    };

    using Histograms = std::map<std::string, Histogram>;  ///< by labels

    static void append(std::string& all, const char* name, const char* help,
                       const Histograms& histograms);

    mutable std::mutex mutex_;
    Histograms durations_;
    Histograms waits_;
    std::map<std::string, uint64_t> request_counts_;  ///< by labels
    uint64_t received_bytes_ = 0;
    uint64_t sent_bytes_ = 0;
};

}  // namespace tetralight::server
