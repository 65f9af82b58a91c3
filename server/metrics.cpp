// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/metrics.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <tetralight/base/str_cat.h>

namespace tetralight::server {
namespace {

std::string line(std::string_view name, std::string_view labels, auto value) {
    return str_cat("tetralight_", name, labels.empty() ? "" : "{", labels,
                   labels.empty() ? "" : "}", " ", value, "\n");
}

std::string head(const char* name, const char* type, const char* help) {
    return str_cat("# HELP tetralight_", name, " ", help, "\n# TYPE tetralight_", name, " ", type,
                   "\n");
}

/// Clients choose methods freely; a label may have few values only.
std::string_view method_label(std::string_view method) {
    constexpr std::string_view kMethods[] = {"GET",   "HEAD",   "POST",   "PUT",
                                             "PATCH", "DELETE", "OPTIONS"};
    const auto* found = std::ranges::find(kMethods, method);
    return found == std::end(kMethods) ? "other" : *found;
}

/// Whole numbers without an exponent, as they may be bytes or seconds since 1970.
std::string number(double value) {
    constexpr double kMostExact = 9e15;
    const bool is_whole = std::abs(value) < kMostExact && value == std::floor(value);
    return is_whole ? str_cat(static_cast<int64_t>(value)) : str_cat(value);
}

}  // namespace

void Metrics::Histogram::add(double duration) {
    ++count;
    seconds += duration;
    for (size_t i = 0; i < kBounds.size(); ++i) below[i] += duration <= kBounds[i];
}

void Metrics::add(const Exchange& exchange) {
    const std::string route =
        str_cat("route=\"", exchange.route.empty() ? "none" : exchange.route, "\"");
    const std::string counted = str_cat(route, ",method=\"", method_label(exchange.request.method),
                                        "\",status=\"", exchange.status, "\"");
    const std::lock_guard lock(mutex_);
    durations_[str_cat(route, ",status=\"", exchange.status / 100, "xx\"")].add(exchange.seconds);
    if (exchange.wait_seconds) waits_[route].add(*exchange.wait_seconds);
    ++request_counts_[counted];
    received_bytes_ += exchange.request.body_size;
    sent_bytes_ += exchange.sent_bytes;
}

void Metrics::append(std::string& all, const char* name, const char* help,
                     const Histograms& histograms) {
    all += head(name, "histogram", help);
    const std::string base = name;
    for (const auto& [labels, histogram] : histograms) {
        for (size_t i = 0; i < kBounds.size(); ++i) {
            all += line(base + "_bucket", str_cat(labels, ",le=\"", kBounds[i], "\""),
                        histogram.below[i]);
        }
        all += line(base + "_bucket", labels + ",le=\"+Inf\"", histogram.count);
        all += line(base + "_sum", labels, histogram.seconds);
        all += line(base + "_count", labels, histogram.count);
    }
}

std::string Metrics::text(std::span<const Figure> figures) const {
    const std::lock_guard lock(mutex_);
    std::string all;
    append(all, "request_duration_seconds",
           "Time from the head of a request to the end of its answer.", durations_);
    append(all, "queue_wait_seconds", "Time for which a request waited for a thread.", waits_);
    all += head("requests_total", "counter", "Answered requests.");
    for (const auto& [labels, count] : request_counts_)
        all += line("requests_total", labels, count);
    const auto counter = [&](const char* name, const char* help, uint64_t value) {
        all += head(name, "counter", help) + line(name, "", value);
    };
    counter("received_bytes_total", "Bodies of requests.", received_bytes_);
    counter("sent_bytes_total", "Bodies of answers.", sent_bytes_);
    counter("positions_total", "Positions of answered queries.", positions);
    counter("quarantined_total", "Damaged files that were found.", quarantined);
    counter("damaged_indexes_total", "Times that a reader found index.json damaged.",
            damaged_indexes);
    const char* last = "";
    for (const Figure& figure : figures) {
        if (std::strcmp(figure.name, last) != 0) all += head(figure.name, figure.type, figure.help);
        last = figure.name;
        all += line(figure.name, figure.labels, number(figure.value));
    }
    return all;
}

}  // namespace tetralight::server
