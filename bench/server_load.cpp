// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/server_load.h>

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include <tetralight/bench/beast_baseline.h>
#include <tetralight/bench/server_requests.h>

namespace tetralight::bench {

using Json = nlohmann::json;

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

namespace {

/// Rays a second of a bake; `when_running` is called once it has started.
double bake_rays_per_second(
    uint16_t port, const std::string& scene, uint64_t seed,
    const std::function<void(HttpClient&, const std::string&)>& when_running) {
    const Json order{{"scene", scene}, {"samples", 2048}, {"bounces", 4}, {"seed", seed}};
    const Json report = bake(port, order, when_running).at("report");
    return report.at("rays").get<double>() / report.at("seconds").at("bake").get<double>();
}

}  // namespace

void bench_during_bake(const ServerProcess& ours, const std::string& scene,
                       const std::string& request) {
    const uint16_t port = ours.port();
    double sending = 0.0;
    const auto count = static_cast<double>(send_for(1.0, port, request, sending));
    const double peak = count / sending;
    const double idle =
        open_loop_p99(port, request, peak / 10, [](double elapsed) { return elapsed < 3.0; });
    const double alone = bake_rays_per_second(port, scene, 1, {});
    double during = 0.0;
    const double shared =
        bake_rays_per_second(port, scene, 2, [&](HttpClient& client, const std::string& path) {
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

namespace {

/// Four clients that send long queries and four that order large pictures, until it is destroyed.
/// They are a process of their own, as are clients elsewhere.
class Load {
  public:
    Load(uint16_t port, const std::string& query, const std::string& picture)
        : process_([&](const auto& is_listening) {
              std::vector<std::thread> clients;
              for (const std::string* request : {&query, &picture}) {
                  for (int i = 0; i < 4; ++i) {
                      clients.emplace_back([request, port] {
                          for (HttpClient client(port);;) client.ask(*request);
                      });
                  }
              }
              is_listening(port);
              for (std::thread& client : clients) client.join();
          }) {}

  private:
    ServerProcess process_;
};

}  // namespace

void bench_healthz_under_load(Subject& subject, const ServerProcess& ours,
                              const std::string& volume, const std::string& scene,
                              const Options& options) {
    const uint16_t port = ours.port();
    const Json baked = bake(port, {{"scene", scene}, {"samples", 16}, {"bounces", 1}});
    const Json picture{{"scene", scene},
                       {"volume", baked.at("volume")},
                       {"camera", "camera"},
                       {"width", 4000},
                       {"height", 3000}};
    const ServerProcess baseline(
        [](const auto& is_listening) { serve_plainly(same_answer("ok\n"), is_listening); });
    const Load load(port, json_query(volume, subject.positions(40'000)),
                    http_request("POST", "/v1/render", "application/json", picture.dump()));
    ::sleep(2);  // until the queues are full
    constexpr double kRate = 50.0;
    const double duration = options.is_quick ? 5.0 : 30.0;
    const std::string request = http_request("GET", "/healthz");
    const auto p99 = [&](uint16_t asked) {
        return open_loop_p99(asked, request, kRate,
                             [&](double elapsed) { return elapsed < duration; });
    };
    double plain = 0.0;
    std::thread other([&] { plain = p99(baseline.port()); });
    const double own = p99(port);
    other.join();
    report("server.healthz_under_load", own * 1e3, "ms, p99");
    report("server.healthz_under_load.beast", plain * 1e3, "ms, p99 of a bare Beast server");
    report("server.healthz_under_load.ratio", own / plain, "p99 over that of the bare server");
}

}  // namespace tetralight::bench
