// SPDX-License-Identifier: Apache-2.0
// The HTTP service against a plain Beast server that answers with the same precomputed bytes.
#include <tetralight/bench/server.h>

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/beast_baseline.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/http_client.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/server/query_binary.h>

namespace tetralight::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using server::QueryHeader;
using Json = nlohmann::json;

constexpr size_t kClients = 2;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The `tetralight` program in the folder of this one.
std::string program() {
    return (fs::canonical("/proc/self/exe").parent_path() / "tetralight").string();
}

/// A temporary folder for a server, which the destructor removes.
struct DataFolder {
    std::string path =
        (fs::temp_directory_path() / str_cat("tetralight_bench_", ::getpid())).string();

    DataFolder() { fs::create_directories(path); }

    ~DataFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }

    DataFolder(const DataFolder&) = delete;
    DataFolder& operator=(const DataFolder&) = delete;
};

std::string binary_query(const std::string& volume, std::span<const glm::vec3> positions,
                         uint8_t sh, uint8_t wants) {
    QueryHeader header;
    header.count = static_cast<uint32_t>(positions.size());
    header.sh = sh;
    header.wants = wants;
    std::string body(reinterpret_cast<const char*>(&header), sizeof header);
    body.append(reinterpret_cast<const char*>(positions.data()), positions.size_bytes());
    return http_request("POST", "/v1/volumes/" + volume + "/query", "application/octet-stream",
                        body);
}

std::string upload(uint16_t port, const std::string& kind, std::span<const std::byte> bytes) {
    HttpClient client(port);
    const std::string_view body(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto answer =
        client.ask(http_request("POST", "/v1/" + kind, "application/octet-stream", body));
    require(answer.status == 200 || answer.status == 201, std::string(answer.body));
    return Json::parse(answer.body).at("id");
}

/// Requests a second over a few connections, each with one request at a time.
double rate(uint16_t port, const std::string& request, double duration) {
    std::vector<std::thread> threads;
    std::atomic<uint64_t> count = 0;
    const auto start = Clock::now();
    for (size_t i = 0; i < kClients; ++i) {
        threads.emplace_back([&] {
            HttpClient client(port);
            while (seconds_since(start) < duration) {
                require(client.ask(request).status == 200, "a request failed");
                ++count;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    return static_cast<double>(count) / seconds_since(start);
}

/// Both servers, alternating, and the processor time of our server and its clients.
void compare(const std::string& figure, const ServerProcess& ours, const std::string& request,
             const Options& options) {
    std::string answer;
    {
        HttpClient client(ours.port());
        const auto first = client.ask(request);
        require(first.status == 200, std::string(first.body));
        answer = first.body;
    }
    const ServerProcess baseline(
        [&](const auto& is_listening) { serve_precomputed(answer, is_listening); });
    const double duration = options.is_quick ? 0.3 : 1.0;
    std::vector<double> our_rates;
    std::vector<double> baseline_rates;
    double server_cpu = 0.0;
    double client_cpu = 0.0;
    for (int i = 0; i < options.repetitions; ++i) {
        const double server_before = ours.cpu_seconds();
        const double client_before = own_cpu_seconds();
        our_rates.push_back(rate(ours.port(), request, duration));
        server_cpu += ours.cpu_seconds() - server_before;
        client_cpu += own_cpu_seconds() - client_before;
        baseline_rates.push_back(rate(baseline.port(), request, duration));
    }
    report_contest(figure, median(our_rates), median(baseline_rates), "requests/s",
                   "a Beast server that sends the same answer, computed before");
    const double total = duration * options.repetitions;
    report(figure + ".server_cpu", server_cpu / total, "processors");
    report(figure + ".client_cpu", client_cpu / total, "processors");
}

void bench_in_process(Subject& subject, std::span<const glm::vec3> positions,
                      const Options& options) {
    const ProbeVolumeView volume = subject.volume.view().without_compact();
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

/// Latencies over many persistent connections, each with one request at a time.
void bench_keepalive(uint16_t port, const std::string& request, const Options& options) {
    constexpr size_t kConnections = 1000;
    const double duration = options.is_quick ? 1.0 : 5.0;
    std::vector<std::unique_ptr<HttpClient>> clients;
    std::vector<pollfd> ends;
    for (size_t i = 0; i < kConnections; ++i) {
        clients.push_back(std::make_unique<HttpClient>(port));
        ends.push_back({clients.back()->descriptor(), POLLIN, 0});
    }
    std::vector<Clock::time_point> sent(kConnections);
    std::vector<double> latencies;
    size_t failed = 0;
    const auto send = [&](size_t i) {
        sent[i] = Clock::now();
        clients[i]->send(request);
    };
    const auto start = Clock::now();
    for (size_t i = 0; i < kConnections; ++i) send(i);
    for (size_t waiting = kConnections; waiting > 0;) {
        ::poll(ends.data(), ends.size(), 1000);
        for (size_t i = 0; i < kConnections; ++i) {
            if (ends[i].revents == 0) continue;
            failed += clients[i]->receive().status != 200;
            latencies.push_back(seconds_since(sent[i]));
            if (seconds_since(start) < duration) {
                send(i);
            } else {
                ends[i].fd = -1;
                --waiting;
            }
        }
    }
    std::ranges::sort(latencies);
    const double p50 = latencies[latencies.size() / 2];
    const double p99 = latencies[latencies.size() * 99 / 100];
    report("server.keepalive_1000.failed", static_cast<double>(failed), "requests");
    report("server.keepalive_1000.p50", p50 * 1e3, "ms");
    report("server.keepalive_1000.p99_over_p50", p99 / p50, "ratio");
}

/// Sends requests at a fixed rate, without waiting for responses. Returns the 99th percentile of
/// the time from when a request was due to its response.
double open_loop_p99(uint16_t port, const std::string& request, double rate_per_second,
                     const std::function<bool(double elapsed)>& goes_on) {
    HttpClient client(port);
    std::vector<double> latencies;
    const auto start = Clock::now();
    for (uint64_t i = 0; goes_on(seconds_since(start)); ++i) {
        const auto due =
            start + std::chrono::duration_cast<Clock::duration>(
                        std::chrono::duration<double>(static_cast<double>(i) / rate_per_second));
        std::this_thread::sleep_until(due);
        require(client.ask(request).status == 200, "a request failed");
        latencies.push_back(seconds_since(due));
    }
    std::ranges::sort(latencies);
    return latencies[latencies.size() * 99 / 100];
}

Json get_json(HttpClient& client, const std::string& path) {
    return Json::parse(client.ask(http_request("GET", path)).body);
}

/// Seconds of a bake; `while_it_runs` is called once it has started.
double bake_rays_per_second(uint16_t port, const std::string& scene, uint64_t seed,
                            const std::function<void(HttpClient&, const std::string&)>& meanwhile) {
    HttpClient client(port);
    const Json order{{"scene", scene}, {"samples", 2048}, {"bounces", 4}, {"seed", seed}};
    const auto accepted =
        client.ask(http_request("POST", "/v1/bakes", "application/json", order.dump()));
    require(accepted.status == 202, std::string(accepted.body));
    const std::string path = "/v1/bakes/" + Json::parse(accepted.body).at("id").get<std::string>();
    while (get_json(client, path).at("state") == "queued") ::usleep(10'000);
    meanwhile(client, path);
    Json bake;
    while ((bake = get_json(client, path)).at("state") == "running") ::usleep(20'000);
    require(bake.at("state") == "done", bake.dump());
    const Json& report = bake.at("report");
    return report.at("rays").get<double>() / report.at("seconds").at("bake").get<double>();
}

void bench_during_bake(const ServerProcess& ours, const std::string& request) {
    const auto scene = read_file(str_cat(TETRALIGHT_SOURCE_DIR, "/examples/scenes/courtyard.glb"));
    require(bool(scene), "the courtyard's file is missing");
    const uint16_t port = ours.port();
    const std::string id = upload(port, "scenes", *scene);
    const double peak = rate(port, request, 1.0);
    const double idle =
        open_loop_p99(port, request, peak / 10, [](double elapsed) { return elapsed < 3.0; });
    const double alone = bake_rays_per_second(port, id, 1, [](auto&, auto&) {});
    double during = 0.0;
    const double shared =
        bake_rays_per_second(port, id, 2, [&](HttpClient& client, const std::string& path) {
            // Polling the bake must not delay the queries.
            std::atomic<bool> is_running = true;
            std::thread watcher([&] {
                while (get_json(client, path).at("state") == "running") ::usleep(100'000);
                is_running = false;
            });
            during =
                open_loop_p99(port, request, peak / 10, [&](double) { return is_running.load(); });
            watcher.join();
        });
    report("server.query_p99_idle", idle * 1e3, "ms at a tenth of the peak rate");
    report("server.query_during_bake", during / idle, "p99 over idle p99");
    report_contest("server.bake_during_query", shared, alone, "rays/s", "the bake alone");
}

/// A server with many volumes: seconds from its start to ready, and to the first response.
void bench_ready(const Subject& subject, const std::string& query_body) {
    constexpr int kVolumes = 1000;
    const DataFolder data;
    const std::string folder = data.path + "/many/volumes";
    fs::create_directories(folder);
    const std::string first = folder + "/" + std::string(32, '0') + ".probes";
    require(bool(write_probe_file(first, subject.volume.view())), "a volume is written");
    for (int i = 1; i < kVolumes; ++i) {
        std::string name = std::to_string(i);
        name.insert(0, 32 - name.size(), '0');
        fs::copy_file(first, folder + "/" + name + ".probes");
    }
    { const ServerProcess adopts(program(), data.path + "/many"); }
    std::vector<double> ready;
    std::vector<double> answered;
    for (int i = 0; i < 5; ++i) {
        const auto start = Clock::now();
        const ServerProcess again(program(), data.path + "/many");
        HttpClient client(again.port());
        require(client.ask(http_request("GET", "/readyz")).status == 200, "readyz");
        ready.push_back(seconds_since(start));
        const auto asked = Clock::now();
        const auto answer = client.ask(query_body);
        require(answer.status == 200, std::string(answer.body));
        answered.push_back(seconds_since(asked));
    }
    report("server.ready_1000", median(ready), "s");
    report("server.ready_1000.first_query", median(answered) * 1e3, "ms");
}

}  // namespace

void bench_server(const Options& options) {
    constexpr uint8_t kFloats = 1;
    Subject subject = make_random_subject("20k", 20'000);
    const auto positions = subject.sorted_positions(10'000);
    const DataFolder data;
    const std::string file = data.path + "/volume.probes";
    require(bool(write_probe_file(file, subject.volume.view())), "a volume is written");
    const ServerProcess ours(program(), data.path + "/data");
    const auto bytes = read_file(file);
    const std::string volume = upload(ours.port(), "volumes", *bytes);

    const std::string query_10k = binary_query(volume, positions, kFloats, 0);
    compare("server.query_10k", ours, query_10k, options);
    bench_in_process(subject, positions, options);
    const std::string small =
        binary_query(volume, std::span(positions).first(80), 0, QueryHeader::kOcclusion);
    compare("server.small", ours, small, options);
    bench_keepalive(ours.port(), small, options);
    bench_during_bake(ours, small);
    bench_ready(subject,
                binary_query(std::string(32, '0'), std::span(positions).first(80), kFloats, 0));
}

}  // namespace tetralight::bench
