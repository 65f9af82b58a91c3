// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/server_requests.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/bench/harness.h>
#include <tetralight/server/query_binary.h>

namespace tetralight::bench {

using Json = nlohmann::json;
using server::QueryHeader;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

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

std::string json_query(const std::string& volume, std::span<const glm::vec3> positions) {
    std::string body = R"({"positions":[)";
    for (const glm::vec3& position : positions) {
        if (body.back() != '[') body += ',';
        body += str_cat("[", position.x, ",", position.y, ",", position.z, "]");
    }
    return http_request("POST", "/v1/volumes/" + volume + "/query", "application/json",
                        body + "]}");
}

std::string upload(uint16_t port, const std::string& kind, std::span<const std::byte> bytes) {
    HttpClient client(port);
    const std::string_view body(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto answer =
        client.ask(http_request("POST", "/v1/" + kind, "application/octet-stream", body));
    require(answer.status == 200 || answer.status == 201, std::string(answer.body));
    return Json::parse(answer.body).at("id");
}

Json get_json(HttpClient& client, const std::string& path) {
    return Json::parse(client.ask(http_request("GET", path)).body);
}

Json bake(uint16_t port, const Json& order,
          const std::function<void(HttpClient&, const std::string&)>& when_running) {
    HttpClient client(port);
    const auto accepted =
        client.ask(http_request("POST", "/v1/bakes", "application/json", order.dump()));
    require(accepted.status == 202, std::string(accepted.body));
    const std::string path = "/v1/bakes/" + Json::parse(accepted.body).at("id").get<std::string>();
    while (get_json(client, path).at("state") == "queued") ::usleep(10'000);
    if (when_running) when_running(client, path);
    Json state;
    while ((state = get_json(client, path)).at("state") == "running") ::usleep(20'000);
    require(state.at("state") == "done", state.dump());
    return state;
}

uint64_t send_for(double duration, uint16_t port, const std::string& request, double& elapsed) {
    constexpr size_t kClients = 2;
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
    elapsed = seconds_since(start);
    return count;
}

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

}  // namespace tetralight::bench
