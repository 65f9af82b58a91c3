// SPDX-License-Identifier: Apache-2.0
// Bakes in tasks: what they are expected to cost, how equal they are, and joining them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/bake_scenes.h>
#include <tetralight/pipeline/bake_range.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/estimate_bytes.h>
#include <tetralight/pipeline/estimate_rays.h>
#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::bench {
namespace {

namespace fs = std::filesystem;

/// The value of `--only` that joins the parts that are there.
constexpr const char* kJoin = "join";

/// Rays of each probe of a whole bake.
std::vector<double> real_rays(const Scene& scene, const std::vector<glm::dvec3>& probes,
                              const BakeSettings& settings) {
    std::vector<ProbeAccumulator> accumulators(probes.size());
    require(bool(bake_accumulators(scene, {probes, {}}, settings, accumulators)), "bake");
    std::vector<double> rays;
    for (const ProbeAccumulator& one : accumulators)
        rays.push_back(static_cast<double>(one.ray_count));
    return rays;
}

double sum(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Places of probes in free space, in the order of a bake.
std::vector<glm::dvec3> places_in(const Scene& scene, size_t count) {
    const std::vector<ProbeGroup> groups{make_group("probes", free_positions(scene, count))};
    auto prepared = prepare_bake(scene, groups, {});
    require(bool(prepared), "prepare");
    return std::move(prepared->capture_positions);
}

/// Expected rays over those of the bake, by target error. Most places are not sampled.
void bench_rays(const BakeSubject& subject) {
    const std::vector<glm::dvec3> places = places_in(subject.scene, 1024);
    for (const double target : {0.05, 0.02, 0.01}) {
        BakeSettings settings;
        settings.target_error = target;
        const auto estimate = estimate_rays(subject.scene, {places, {}}, settings, {});
        require(bool(estimate), "estimate");
        const double rays = sum(real_rays(subject.scene, places, settings));
        report(str_cat("farm.cost_rays.", subject.name, ".", target), estimate->rays / rays,
               str_cat("of the ", std::llround(rays), " rays of the bake"));
    }
}

/// Expected bytes over those of the file.
void bench_bytes(const BakeSubject& subject) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 16;
    const std::vector<ProbeGroup> groups{make_group("probes", subject.probes)};
    const auto prepared = prepare_bake(subject.scene, groups, settings);
    require(bool(prepared), "prepare");
    const auto baked = bake_volume(subject.scene, groups, settings);
    require(bool(baked), "bake");
    report("farm.cost_bytes." + subject.name,
           static_cast<double>(estimate_bytes(*prepared)) /
               static_cast<double>(probe_file_bytes(baked->volume.view()).size()),
           "of the bytes of the file");
}

/// Most rays of a task over the mean of 64 tasks.
void bench_imbalance(const BakeSubject& subject) {
    constexpr size_t kTasks = 64;
    BakeSettings settings;
    settings.target_error = 0.05;
    const std::vector<double> rays =
        real_rays(subject.scene, places_in(subject.scene, 8192), settings);
    double most = 0.0;
    for (const PlaceRange& range : spread_ranges(rays.size(), kTasks))
        most = std::max(most, sum(take<double>(rays, range)));
    report("farm.imbalance." + subject.name, most * kTasks / sum(rays),
           "most over mean rays of a task");
}

/// A folder with the parts of one bake.
class Parts {
  public:
    /// Bakes them.
    Parts(int side, size_t count) {
        fs::remove_all(folder());
        fs::create_directories(folder());
        Scene scene;
        scene.environment.radiance = {1, 2, 3};
        BakeVolumeSettings settings;
        settings.bake.sample_count = 16;
        const std::vector<ProbeGroup> groups{make_group("probes", lattice_positions(side, 1.0))};
        const auto prepared = prepare_bake(scene, groups, settings);
        require(bool(prepared), "prepare");
        require(bool(write_prepared_bake(prepared_path(), *prepared)), "write");
        for (const PlaceRange& range : spread_ranges(prepared->volume.positions.size(), count)) {
            const auto baked = bake_range(scene, *prepared, range);
            require(bool(baked), "bake");
            const std::string path = (folder() / str_cat(range.begin, ".part")).string();
            require(bool(write_light_part(path, *prepared, baked->partial)), "write");
        }
    }

    ~Parts() { fs::remove_all(folder()); }

    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    [[nodiscard]] static std::string prepared_path() { return (folder() / "prepared").string(); }

    [[nodiscard]] static std::string output() { return (folder() / "joined.probes").string(); }

    /// Of the folder as it is.
    [[nodiscard]] static std::vector<std::string> paths() {
        std::vector<std::string> paths;
        for (const auto& entry : fs::directory_iterator(folder()))
            if (entry.path().extension() == ".part") paths.push_back(entry.path().string());
        return paths;
    }

  private:
    [[nodiscard]] static fs::path folder() {
        return fs::temp_directory_path() / "tetralight_bench_farm";
    }
};

void join_parts() {
    const auto merged = merge_light_parts(Parts::prepared_path(), Parts::paths());
    require(bool(merged), "merge");
    require(bool(write_probe_file(Parts::output(), merged->volume.view())), "write");
}

/// Reads all parts and drops them.
void read_parts() {
    const auto prepared = read_prepared_bake(Parts::prepared_path());
    require(bool(prepared), "read");
    for (const std::string& path : Parts::paths())
        require(bool(read_light_part(path, *prepared)), "read");
}

void bench_collect(const Options& options) {
    const Parts parts(options.is_quick ? 40 : 100, options.is_quick ? 100 : 1000);
    report("farm.collect_time", seconds(join_parts) / seconds(read_parts), "of reading the parts");
    const double memory = peak_memory({"farm", "--only", kJoin});
    report("farm.collect_memory",
           (memory - static_cast<double>(fs::file_size(Parts::output()))) / 1e6,
           "MB more than the result");
}

}  // namespace

void bench_farm(const Options& options) {
    if (options.only == kJoin) return join_parts();  // a process of peak_memory()
    std::vector<BakeSubject> subjects = bake_subjects(options);
    if (is_selected(options, rooms_name(RoomLight::Sun)))
        subjects.push_back(rooms_subject(RoomLight::Sun));
    for (const BakeSubject& subject : subjects) {
        bench_rays(subject);
        bench_bytes(subject);
        bench_imbalance(subject);
    }
    if (is_selected(options, "collect")) bench_collect(options);
}

}  // namespace tetralight::bench
