// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/metrics.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

std::string line(const std::string& name, const std::string& labels, auto value) {
    return str_cat("tetralight_", name, labels.empty() ? "" : "{" + labels + "}", " ", value, "\n");
}

std::string head(const std::string& name, const char* type, const char* help) {
    return str_cat("# HELP tetralight_", name, " ", help, "\n# TYPE tetralight_", name, " ", type,
                   "\n");
}

}  // namespace

void Metrics::add(const Exchange& exchange) {
    const std::string labels = str_cat("route=\"", exchange.route.empty() ? "none" : exchange.route,
                                       "\",status=\"", exchange.status / 100, "xx\"");
    const std::lock_guard lock(mutex_);
    Series& series = series_[labels];
    ++series.count;
    series.seconds += exchange.seconds;
    for (size_t i = 0; i < kBounds.size(); ++i) series.below[i] += exchange.seconds <= kBounds[i];
    received_bytes_ += exchange.request.body_size;
    sent_bytes_ += exchange.sent_bytes;
}

std::string Metrics::text(const std::map<std::string, double>& gauges) const {
    const std::lock_guard lock(mutex_);
    const std::string duration = "request_duration_seconds";
    std::string all =
        head(duration, "histogram", "Time from the head of a request to the end of its answer.");
    for (const auto& [labels, series] : series_) {
        for (size_t i = 0; i < kBounds.size(); ++i) {
            all += line(duration + "_bucket", str_cat(labels, ",le=\"", kBounds[i], "\""),
                        series.below[i]);
        }
        all += line(duration + "_bucket", labels + ",le=\"+Inf\"", series.count);
        all += line(duration + "_sum", labels, series.seconds);
        all += line(duration + "_count", labels, series.count);
    }
    const auto counter = [&](const char* name, const char* help, uint64_t value) {
        all += head(name, "counter", help) + line(name, "", value);
    };
    counter("received_bytes_total", "Bodies of requests.", received_bytes_);
    counter("sent_bytes_total", "Bodies of answers.", sent_bytes_);
    counter("positions_total", "Positions of answered queries.", positions);
    counter("quarantined_total", "Damaged files that were found.", quarantined);
    counter("damaged_indexes_total", "Times that a reader found index.json damaged.",
            damaged_indexes);
    for (const auto& [name, value] : gauges) {
        all += head(name, "gauge", "Current value.") + line(name, "", value);
    }
    return all;
}

}  // namespace tetralight::server
