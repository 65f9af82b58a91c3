// SPDX-License-Identifier: Apache-2.0
// Two rooms beside each other, one with a lamp, the other dark.
#include <cmath>
#include <random>
#include <utility>

#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/grid_error.h>
#include <tetralight/bench/leak_scenes.h>
#include <tetralight/bench/leaks.h>

namespace tetralight::bench {
namespace {

constexpr int kPositions = 2500;
constexpr float kNear = 0.6f;

/// Which probes the rooms get.
struct Probes {
    double spacing = 1.0;
    uint64_t adaptive_count = 0;  ///< 0: a lattice

    [[nodiscard]] std::string name() const {
        return adaptive_count > 0 ? str_cat(adaptive_count) : str_cat(spacing, "m");
    }
};

ProbeGrid make_grid(const Scene& scene, float thickness, const Probes& probes) {
    ProbeGridSettings settings;
    settings.spacing = glm::dvec3(probes.spacing);
    const double x = 0.5 * double{kRoomWide} + 0.5 * double{thickness};
    settings.from = {{-x, 1.5, 2.0}, {x, 1.5, 2.0}};
    if (probes.adaptive_count > 0) {
        settings.mode = PlacementMode::Adaptive;
        settings.max_probes = probes.adaptive_count;
    }
    auto grid = make_probe_grid(scene, settings);
    require(bool(grid), grid ? "" : error_text(grid.error()));
    return std::move(*grid);
}

/// One scene with its positions and their true light.
struct Rooms {
    float thickness;
    Scene scene;
    RoomPositions positions;
    double true_near;

    explicit Rooms(float wall) : thickness(wall), scene(two_rooms(wall)), positions(wall) {
        const std::vector<glm::dvec3> near(positions.near.begin(), positions.near.end());
        true_near = mean_light(bake_reference(scene, near, 4096).light);
    }

    [[nodiscard]] std::string name() const {
        return str_cat(std::lround(100.0 * double{thickness}), "cm");
    }
};

/// Light in the lit room near the wall: by rays, and in truth.
void report_near(const LeakAnswers& near, double truth, const std::string& name) {
    const double rays = mean_light(near.rays);
    const double walls = mean_light(near.walls), plain = mean_light(near.plain);
    report_contest("leak.near_wall." + name, walls / rays, plain / rays, "of the light by rays",
                   "plain weights");
    report_contest("leak.near_truth." + name, walls / truth, plain / truth, "of the true light",
                   "plain weights");
    report("leak.near_truth_by_rays." + name, rays / truth, "of the true light");
}

void measure(const Rooms& rooms, const Probes& probes) {
    const ProbeGrid grid = make_grid(rooms.scene, rooms.thickness, probes);
    const LeakVolume volume(rooms.scene, grid.groups, 1024);
    const LeakAnswers lit = volume.answers(rooms.positions.lit);
    const LeakAnswers dark = volume.answers(rooms.positions.dark);
    const auto leak = [&](const auto& light) {
        return 100.0 * mean_light(dark.*light) / mean_light(lit.*light);
    };
    const std::string name = str_cat(rooms.name(), ".", probes.name());
    const std::string kind =
        probes.adaptive_count > 0 ? "leak.adaptive." : "leak.bright_into_dark.";
    report_contest(kind + name, leak(&LeakAnswers::walls), leak(&LeakAnswers::plain),
                   "% of the lit room", "plain weights");
    report("leak.by_rays." + name, leak(&LeakAnswers::rays), "% of the lit room");
    report_near(volume.answers(rooms.positions.near), rooms.true_near, name);
    volume.report_cost("leak", "." + name);
    if (probes.adaptive_count == 0 && probes.spacing == 1.0) {
        bench_leak_lppv(volume, rooms.positions, rooms.thickness, rooms.name());
    }
}

}  // namespace

RoomPositions::RoomPositions(float thickness) {
    const float half = 0.5f * thickness;
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<float> across(kLeakMargin, kRoomWide - kLeakMargin);
    std::uniform_real_distribution<float> up(kLeakMargin, kRoomHigh - kLeakMargin);
    for (int i = 0; i < kPositions; ++i) {
        const float x = across(engine), y = up(engine), z = across(engine);
        dark.emplace_back(half + x, y, z);
        lit.emplace_back(-half - x, y, z);
        if (x < kNear) near.push_back(lit.back());
    }
}

void bench_leak_rooms(const Options& options) {
    for (const float thickness : {0.2f, 0.05f, 0.0f}) {
        const Rooms rooms(thickness);
        for (const double spacing : {0.5, 1.0, 2.0}) measure(rooms, {spacing});
        for (const uint64_t count : {16, 96, 750}) {
            if (!options.is_quick) measure(rooms, {1.0, count});
        }
    }
}

}  // namespace tetralight::bench
