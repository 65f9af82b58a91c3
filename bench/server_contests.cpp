// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/server_contests.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <tetralight/bench/plain_queries.h>
#include <tetralight/bench/server_requests.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/server/query_binary.h>

namespace tetralight::bench {
namespace {

using server::QueryHeader;

constexpr uint8_t kFloats = 1, kHalves = 3;
constexpr const char* kPrecomputed = "a Beast server that sends the same answer, computed before";

double duration_of(const Options& options) {
    return options.is_quick ? 0.3 : 1.0;
}

std::string answer_of(const ServerProcess& server, const std::string& request) {
    HttpClient client(server.port());
    const auto answer = client.ask(request);
    require(answer.status == 200, std::string(answer.body));
    return std::string(answer.body);
}

/// Processor time of a server a request, with two clients.
double cpu_per_request(const ServerProcess& server, const std::string& request, double duration) {
    double elapsed = 0.0;
    const double before = server.cpu_seconds();
    const uint64_t count = send_for(duration, server.port(), request, elapsed);
    return (server.cpu_seconds() - before) / static_cast<double>(count);
}

/// True if both have the same answers. JSON need not be the same text, as the plain server writes
/// floats as doubles.
bool are_equal(const std::string& ours, const std::string& theirs) {
    if (!ours.starts_with('{')) return ours == theirs;
    const auto values = [](const std::string& text) {
        std::vector<float> floats;
        for (const auto& value : nlohmann::json::parse(text).flatten()) {
            if (value.is_number()) floats.push_back(value.get<float>());
        }
        return floats;
    };
    return values(ours) == values(theirs);
}

/// Both servers alternate. The figure is requests a second of processor time, from the least time
/// that each needed: other programs on the machine can only add to it.
void contest(const std::string& figure, const ServerProcess& ours, const PlainHandler& handler,
             const std::string& request, const Options& options) {
    const ServerProcess baseline(
        [&](const auto& is_listening) { serve_plainly(handler, is_listening); });
    require(are_equal(answer_of(ours, request), answer_of(baseline, request)),
            figure + ": the answers differ");
    double our_cpu = cpu_per_request(ours, request, duration_of(options));
    double baseline_cpu = cpu_per_request(baseline, request, duration_of(options));
    for (int i = 1; i < options.repetitions; ++i) {
        our_cpu = std::min(our_cpu, cpu_per_request(ours, request, duration_of(options)));
        baseline_cpu =
            std::min(baseline_cpu, cpu_per_request(baseline, request, duration_of(options)));
    }
    report_contest(figure, 1.0 / our_cpu, 1.0 / baseline_cpu, "requests/s of processor time",
                   "a Beast server that calls the same batch");
}

/// The share of HTTP: a rate that no answer can exceed.
void ceiling(const std::string& figure, const ServerProcess& ours, const std::string& request,
             const Options& options) {
    const std::string answer = answer_of(ours, request);
    const ServerProcess baseline(
        [&](const auto& is_listening) { serve_plainly(same_answer(answer), is_listening); });
    std::vector<double> our_rates;
    std::vector<double> baseline_rates;
    const auto rate = [&](const ServerProcess& server) {
        double elapsed = 0.0;
        const uint64_t count = send_for(duration_of(options), server.port(), request, elapsed);
        return static_cast<double>(count) / elapsed;
    };
    for (int i = 0; i < options.repetitions; ++i) {
        our_rates.push_back(rate(ours));
        baseline_rates.push_back(rate(baseline));
    }
    report_contest(figure, median(our_rates), median(baseline_rates), "requests/s", kPrecomputed);
}

/// Processor time of requests over that of the same positions with SH alone, in binary.
void compare_forms(const ServerProcess& ours, const std::string& volume,
                   std::span<const glm::vec3> positions, const Options& options) {
    struct Form {
        std::string figure;
        std::string request;
        double cpu = std::numeric_limits<double>::infinity();  ///< of one request, the least
    };

    Form plain{"", binary_query(volume, positions, kFloats, 0)};
    Form forms[] = {{"query.cells", binary_query(volume, positions, kFloats, QueryHeader::kCells)},
                    {"query.half", binary_query(volume, positions, kHalves, 0)},
                    {"query.json", json_query(volume, positions)}};
    const auto time = [&](Form& form) {
        form.cpu = std::min(form.cpu, cpu_per_request(ours, form.request, duration_of(options)));
    };
    for (int i = 0; i < options.repetitions; ++i) {
        time(plain);
        for (Form& form : forms) time(form);
    }
    for (const Form& form : forms) {
        report(form.figure, form.cpu / plain.cpu, "processor time over that of SH alone in binary");
    }
}

void bench_in_process(const ProbeVolumeView& volume, std::span<const glm::vec3> positions,
                      const Options& options) {
    std::vector<IrradianceSh> answers(positions.size());
    std::vector<double> rates;
    for (int i = 0; i < options.repetitions; ++i) {
        constexpr int kCalls = 20;
        rates.push_back(kCalls / seconds([&] {
                            for (int call = 0; call < kCalls; ++call) {
                                require(bool(interpolate(volume, {.positions = positions,
                                                                  .irradiance = answers})),
                                        "interpolate");
                            }
                        }));
    }
    report("server.query_10k.in_process", median(rates), "batches/s on one thread");
}

}  // namespace

void bench_queries_over_http(Subject& subject, const ServerProcess& ours, const std::string& volume,
                             const Options& options) {
    constexpr size_t kMany = 10'000, kFew = 80;
    const ProbeVolumeView view = subject.volume.view().without_compact();
    const auto sorted = subject.sorted_positions(kMany);
    const auto positions = subject.positions(kMany);  // in no order
    const std::string query_10k = binary_query(volume, sorted, kFloats, 0);
    const std::string small =
        binary_query(volume, std::span(sorted).first(kFew), 0, QueryHeader::kOcclusion);
    const std::string cells = binary_query(volume, positions, kFloats, QueryHeader::kCells);

    contest("server.query_10k", ours, answers_binary(view), query_10k, options);
    ceiling("server.query_10k.precomputed", ours, query_10k, options);
    bench_in_process(view, sorted, options);
    contest("server.small", ours, answers_binary(view), small, options);
    ceiling("server.small.precomputed", ours, small, options);
    contest("server.cells", ours, answers_binary(view), cells, options);
    contest("server.json", ours, answers_json(view), json_query(volume, positions), options);
    compare_forms(ours, volume, positions, options);
}

}  // namespace tetralight::bench
