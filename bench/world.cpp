// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <tetralight/bench/harness.h>
#include <tetralight/pipeline/write_world.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/world_query.h>

// A level of 8 × 8 tiles as a world and as one volume: the same answers along a flight.

namespace tetralight::bench {
namespace {

constexpr int kTilesAlong = 8;
constexpr double kTileSide = 64.0;  // metres
constexpr double kRadius = 16.0;
constexpr double kHysteresis = 4.0;
constexpr int kSteps = 400;
constexpr size_t kQueriesAStep = 2'000;

/// Light that changes from place to place.
IrradianceSh analytic_light(const glm::dvec3& p) {
    IrradianceSh sh;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const double phase = 0.3 * i + 0.05 * p.x + 0.03 * p.y - 0.04 * p.z;
        sh.coefficients[static_cast<size_t>(i)] =
            glm::vec3(std::sin(phase), std::cos(phase), std::sin(2.0 * phase));
    }
    return sh;
}

ProbeVolume make_level(size_t probes_a_tile) {
    std::vector<glm::dvec3> positions =
        random_positions(probes_a_tile * kTilesAlong * kTilesAlong, 1, kTilesAlong * kTileSide);
    for (glm::dvec3& p : positions) p.y /= kTilesAlong;
    const ProbeGroup group = make_group("level", std::move(positions));
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    for (const glm::dvec3& p : volume.exact_positions) {
        volume.irradiance.push_back(analytic_light(p));
    }
    make_compact_probes(volume);
    return volume;
}

/// Bytes of files that are mapped and read, of this process.
double mapped_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (!line.starts_with("RssFile:")) continue;
        return std::stod(line.substr(std::strlen("RssFile:"))) * 1024.0;
    }
    return 0.0;
}

/// From one side to the opposite one, in curves, and always so far from the sides that the tile
/// outside stays closed.
glm::dvec3 camera_at(int step) {
    const double along = static_cast<double>(step) / kSteps;
    const double length = kTilesAlong * kTileSide;
    const double from_side = kRadius + 2.0 * kHysteresis;
    return {from_side + (length - 2.0 * from_side) * along, 0.5 * kTileSide,
            length * (0.5 + 0.4 * std::sin(9.0 * along))};
}

class Flight {
  public:
    Flight(const ProbeVolume& volume, World& world) : volume_(volume), world_(world) {}

    void run() {
        const double before = mapped_memory();
        for (int step = 0; step <= kSteps; ++step) {
            const glm::dvec3 camera = camera_at(step);
            WorldMove move;
            const double time = seconds([&] { move = world_.move_to(camera, kRadius); });
            require(move.failures.empty(), "opening a tile");
            longest_move = std::max(longest_move, time);
            ask_around(camera, static_cast<uint64_t>(step));
            const auto size = static_cast<double>(world_.tiles()->open_size());
            most_open = std::max(most_open, size);
            most_read = std::max(most_read, mapped_memory() - before);
        }
    }

    double most_open = 0.0;     ///< bytes of open files
    double most_read = 0.0;     ///< bytes of them in memory
    double longest_move = 0.0;  ///< seconds
    size_t answer_count = 0;

  private:
    /// Compares the answers in a ball around the camera with those of the volume.
    void ask_around(const glm::dvec3& camera, uint64_t seed) {
        std::vector<glm::vec3> positions;
        for (const glm::dvec3& p : random_positions(kQueriesAStep, seed, 2.0)) {
            const glm::dvec3 away = p - glm::dvec3(1.0);
            if (glm::dot(away, away) < 1.0) positions.emplace_back(camera + kRadius * away);
        }
        std::vector<IrradianceSh> light(positions.size()), expected(positions.size());
        const auto report =
            interpolate(*world_.tiles(), {.positions = positions, .irradiance = light});
        require(report && *report == WorldReport{}, "positions without an answer");
        require(bool(interpolate(volume_.view(), {.positions = positions, .irradiance = expected})),
                "a batch");
        require(light == expected, "the light of a world");
        answer_count += positions.size();
    }

    const ProbeVolume& volume_;
    World& world_;
};

/// Rates of one batch over the tiles that are open at the middle of the flight.
void bench_world_queries(const ProbeVolume& volume, World& world, const std::string& size,
                         const Options& options) {
    const glm::dvec3 camera = camera_at(kSteps / 2);
    world.move_to(camera, kRadius);
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : random_positions(20'000, 7, 2.0)) {
        positions.emplace_back(camera + 0.5 * kRadius * (p - glm::dvec3(1.0)));
    }
    std::vector<IrradianceSh> light(positions.size());
    Contest contest;
    contest.figure = "farm.world.query." + size;
    contest.unit = "Mq/s";
    contest.baseline_is = "interpolate in one volume";
    contest.work = static_cast<double>(positions.size()) * 1e-6;
    contest.ours = [&] {
        return seconds([&] {
            require(
                bool(interpolate(*world.tiles(), {.positions = positions, .irradiance = light})),
                "a batch of a world");
        });
    };
    contest.baseline = [&] {
        return seconds([&] {
            require(bool(interpolate(volume.view(), {.positions = positions, .irradiance = light})),
                    "a batch");
        });
    };
    run(contest, options);
}

void bench_size(size_t probes_a_tile, const std::string& size, const Options& options) {
    const ProbeVolume volume = make_level(probes_a_tile);
    const std::string folder =
        (std::filesystem::temp_directory_path() / ("tetralight_bench_world_" + size)).string();
    Result<WorldSummary> summary = Error{};
    const double time = seconds([&] {
        summary = write_world(folder, volume.view(), {.tile_size = glm::dvec3(kTileSide)});
    });
    require(bool(summary), "writing a world");
    require(summary->tile_count == kTilesAlong * kTilesAlong + 1, "the number of tiles");
    auto world = World::open(folder, {.hysteresis = kHysteresis});
    require(bool(world), "opening a world");
    const auto whole = static_cast<double>(summary->info.volume_size);
    Flight flight(volume, *world);
    flight.run();
    report("farm.world.memory." + size, flight.most_open / whole, "of the volume");
    report("farm.world.read_memory." + size, flight.most_read / whole, "of the volume");
    report("farm.world.outside_tile." + size,
           static_cast<double>(summary->outside_tile_size) / whole, "of the volume");
    report("farm.world.copies." + size,
           static_cast<double>(summary->probe_count) / summary->info.probe_count, "tiles a probe");
    report("farm.world.answers." + size, static_cast<double>(flight.answer_count), "equal answers");
    report("farm.world.longest_move." + size, 1e3 * flight.longest_move, "ms");
    report("farm.world.cut." + size, 1e-6 * static_cast<double>(summary->info.probe_count) / time,
           "Mprobes/s");
    bench_world_queries(volume, *world, size, options);
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
}

}  // namespace

void bench_world(const Options& options) {
    bench_size(1'000'000 / (kTilesAlong * kTilesAlong), "1m", options);
    if (!options.is_quick) bench_size(100'000, "64x100k", options);
}

}  // namespace tetralight::bench
