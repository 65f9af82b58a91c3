// SPDX-License-Identifier: Apache-2.0
// The HTTP service against plain Beast servers, and under load.
#include <tetralight/bench/server.h>

#include <unistd.h>

#include <filesystem>
#include <random>

#include <tetralight/base/file.h>
#include <tetralight/base/hash/sha256.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/bench/server_contests.h>
#include <tetralight/bench/server_load.h>
#include <tetralight/bench/server_requests.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/server/query_binary.h>

namespace tetralight::bench {
namespace {

namespace fs = std::filesystem;

constexpr uint8_t kFloats = 1;

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

/// Probes whose light has no zeros: they are shorter than other numbers in JSON.
Subject make_subject() {
    Subject subject = make_random_subject("20k", 20'000);
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> light(-1.0f, 1.0f);
    for (IrradianceSh& irradiance : subject.volume.irradiance) {
        for (glm::vec3& c : irradiance.coefficients)
            c = {light(engine), light(engine), light(engine)};
    }
    make_compact_probes(subject.volume);
    return subject;
}

/// Writes a volume to a folder under the name that a server gives it. Returns its id.
std::string store(const ProbeVolumeView& volume, const std::string& folder) {
    const std::string file = folder + "/new";
    require(bool(write_probe_file(file, volume)), "a volume is written");
    const std::string id = sha256_hex(*read_file(file));
    fs::rename(file, folder + "/" + id + ".probes");
    return id;
}

/// A server with many volumes: seconds from its start to ready, and to the first response, from a
/// volume of 20 000 probes.
void bench_ready(const Subject& subject, std::span<const glm::vec3> positions) {
    constexpr int kVolumes = 1000;
    const DataFolder data;
    const std::string folder = data.path + "/many/volumes";
    fs::create_directories(folder);
    const std::string id = store(subject.volume.view(), folder);
    Subject others = make_random_subject("100", 100);
    for (int i = 1; i < kVolumes; ++i) {
        others.volume.info.ambient.coefficients[0].x = static_cast<float>(i);
        store(others.volume.view(), folder);
    }
    const std::string query = binary_query(id, positions, kFloats, 0);
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
        const auto answer = client.ask(query);
        require(answer.status == 200, std::string(answer.body));
        answered.push_back(seconds_since(asked));
    }
    report("server.ready_1000", median(ready), "s");
    report("server.ready_1000.first_query", median(answered) * 1e3, "ms");
}

}  // namespace

void bench_server(const Options& options) {
    Subject subject = make_subject();
    const DataFolder data;
    const std::string file = data.path + "/volume.probes";
    require(bool(write_probe_file(file, subject.volume.view())), "a volume is written");
    const ServerProcess ours(program(), data.path + "/data");
    const std::string volume = upload(ours.port(), "volumes", *read_file(file));
    const auto court = read_file(str_cat(TETRALIGHT_SOURCE_DIR, "/examples/scenes/courtyard.glb"));
    require(bool(court), "the courtyard's file is missing");
    const std::string scene = upload(ours.port(), "scenes", *court);

    bench_queries_over_http(subject, ours, volume, options);
    const auto positions = subject.sorted_positions(80);
    const std::string small = binary_query(volume, positions, 0, server::QueryHeader::kOcclusion);
    bench_keepalive(ours.port(), small, options);
    bench_healthz_under_load(subject, ours, volume, scene, options);
    bench_during_bake(ours, scene, small);
    bench_ready(subject, positions);
}

}  // namespace tetralight::bench
