// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/probes/probe_group.h>

// Each figure is a ratio against a baseline that is timed in the same process, alternating, because
// machines differ and are noisy. docs/performance.md explains the figures.

namespace tetralight::bench {

struct Options {
    /// A glTF scene for the benchmarks that can use one.
    std::optional<std::string> scene;
    int repetitions = 7;
    /// Skip the benchmarks that take minutes.
    bool is_quick = false;
    /// CSV file to which `bake` writes errors over rays instead of its figures.
    std::optional<std::string> convergence;
    /// The scene that `bake`, `grid` and `relight` run alone.
    std::optional<std::string> only;
    /// The figures that `bake` measures alone: the second part of their names.
    std::optional<std::string> figure;
    /// Folder into which `reflection` writes what the comparison with three.js reads, instead of
    /// its figures.
    std::optional<std::string> pmrem;
};

/// Two ways to do the same work. Each returns its seconds, so that preparation is not timed.
struct Contest {
    std::string figure;
    std::string unit;
    std::string baseline_is;
    /// Units of work in one run: rates are work / seconds.
    double work = 1.0;
    std::function<double()> ours;
    std::function<double()> baseline;
};

/// Runs both alternately and prints one JSON line with the medians of their rates.
void run(const Contest& contest, const Options& options);

/// Prints given rates as one JSON line.
void report_contest(const std::string& figure, double ours, double baseline,
                    const std::string& unit, const std::string& baseline_is);

/// Prints a figure that has no baseline.
void report(const std::string& figure, double value, const std::string& unit);

[[nodiscard]] double median(std::vector<double> values);

/// Seconds that `work` takes.
[[nodiscard]] double seconds(const std::function<void()>& work);

/// Seconds of processor time that `work` takes, on all threads together: other programs on the
/// machine change it less than `seconds`.
[[nodiscard]] double cpu_seconds(const std::function<void()>& work);

/// True if `--only` names this scene or is not given.
[[nodiscard]] bool is_selected(const Options& options, const std::string& scene);

/// The largest memory of a process that runs this program with these arguments, bytes.
[[nodiscard]] double peak_memory(const std::vector<std::string>& arguments);

/// Ends the program with exit code 1 if `is_right` is false: an answer differs from the baseline's.
void require(bool is_right, const std::string& what);

[[nodiscard]] std::vector<glm::dvec3> random_positions(size_t count, uint64_t seed, double extent);

/// `side` positions along each axis, `step` apart.
[[nodiscard]] std::vector<glm::dvec3> lattice_positions(int side, double step);

/// A direction that is uniform on the sphere for uniform numbers.
[[nodiscard]] glm::vec3 uniform_direction(glm::vec2 u);

/// A group whose positions are world positions.
[[nodiscard]] ProbeGroup make_group(std::string name, std::vector<glm::dvec3> positions);

void bench_bake(const Options& options);
/// Tetrahedra alone against CGAL's.
void bench_delaunay(const Options& options);
/// Direction sets against random directions.
void bench_direction_sets();
/// Exports for engines, and the npm package.
void bench_engines(const Options& options);
/// Bakes in tasks: expected rays and bytes, equal tasks, joining.
void bench_farm(const Options& options);
/// Adding and removing a group, as fractions of a full build.
void bench_groups(const Options& options);
void bench_grid(const Options& options);
/// Light that leaks through walls.
void bench_leaks(const Options& options);

/// Bakes at default settings, against a second path tracer.
void bench_verify(const Options& options);
/// Charts, texels, seams and samples of lightmaps.
void bench_lightmap(const Options& options);
/// Proxy volumes: filling, refreshing, accuracy, files.
void bench_lppv(const Options& options);
void bench_query(const Options& options);
/// Reflection probes: blurred levels, box projection, blending.
void bench_reflection(const Options& options);
void bench_relight(const Options& options);
void bench_runtime(const Options& options);
/// Reading scene files: time and memory.
void bench_scene(const Options& options);
void bench_tetrahedralize(const Options& options);
/// Worlds of tiles: answers and memory along a flight.
void bench_world(const Options& options);

}  // namespace tetralight::bench
