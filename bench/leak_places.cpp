// SPDX-License-Identifier: Apache-2.0
// Errors of light near walls, against path-traced light: what comes through walls, and what is
// missing because a corner that is seen was hidden.
#include <algorithm>
#include <optional>
#include <utility>

#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/grid_error.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/bench/leak_scenes.h>
#include <tetralight/bench/leaks.h>

namespace tetralight::bench {
namespace {

constexpr size_t kPlaces = 2500;
constexpr uint32_t kTrueSamples = 4096;

/// How answers differ from those by rays: sums where a ray reaches a corner.
struct Difference {
    double through = 0.0;  ///< more light than by rays
    double missing = 0.0;  ///< less
    double doubled = 0.0;  ///< places with more than twice the light by rays

    Difference(const LeakAnswers& all, const std::vector<IrradianceSh>& answers) {
        for (size_t i = 0; i < answers.size(); ++i) {
            if (!all.is_seen[i]) continue;
            const double rays = mean_irradiance(all.rays[i]);
            const double more = mean_irradiance(answers[i]) - rays;
            through += std::max(more, 0.0);
            missing += std::max(-more, 0.0);
            doubled += more > rays ? 1.0 : 0.0;
        }
    }
};

/// A scene whose answers are compared at some places.
struct Subject {
    std::string name;  ///< "leak.house"
    const Scene& scene;
    const LightReference& truth;
};

void report_differences(const Subject& subject, const std::string& probes,
                        const LeakAnswers& answers) {
    const double percent =
        100.0 / (mean_light(subject.truth.light) * static_cast<double>(subject.truth.light.size()));
    const Difference walls(answers, answers.walls), plain(answers, answers.plain);
    report_contest(str_cat(subject.name, ".through.", probes), percent * walls.through,
                   percent * plain.through, "% of the mean light", "plain weights");
    report(str_cat(subject.name, ".missing.", probes), percent * walls.missing,
           "% of the mean light");
    const auto places = static_cast<double>(answers.is_seen.size());
    report_contest(str_cat(subject.name, ".doubled.", probes), 100.0 * walls.doubled / places,
                   100.0 * plain.doubled / places,
                   "% of the places, with more than twice the light by rays", "plain weights");
    const auto unseen = static_cast<double>(std::ranges::count(answers.is_seen, false));
    report(str_cat(subject.name, ".unseen.", probes), 100.0 * unseen / places,
           "% of the places, from which no corner is seen");
}

void measure(const Subject& subject, const std::string& probes, const ProbeGrid& grid,
             uint32_t sample_count) {
    const LeakVolume volume(subject.scene, grid.groups, sample_count);
    const LeakAnswers answers = volume.answers(subject.truth.positions);
    const auto error = [&](const std::vector<IrradianceSh>& light) {
        return light_error(subject.truth, light);
    };
    const std::string unit = "RMSE / mean light";
    report_contest(str_cat(subject.name, ".", probes), error(answers.walls), error(answers.rays),
                   unit, "a true ray to each corner");
    report(str_cat(subject.name, ".plain.", probes), error(answers.plain), unit);
    report_differences(subject, probes, answers);
    volume.report_cost(subject.name, "." + probes);
}

ProbeGrid lattice(const Scene& scene, double spacing, std::optional<WorldBox> bounds = {}) {
    ProbeGridSettings settings;
    settings.spacing = glm::dvec3(spacing);
    settings.bounds = bounds;
    auto grid = make_probe_grid(scene, settings);
    require(bool(grid), grid ? "" : error_text(grid.error()));
    return std::move(*grid);
}

void measure_house(const Options& options) {
    const Scene scene = house_with_door();
    const LightReference truth =
        bake_reference(scene, free_places(scene, house_inside(), kPlaces), kTrueSamples);
    for (const double spacing : {2.0, 1.0, 0.5}) {
        if (options.is_quick && spacing < 1.0) continue;
        measure({"leak.house", scene, truth}, str_cat(spacing, "m"), lattice(scene, spacing),
                kTrueSamples);
    }
}

/// The room in the courtyard's house, with the default grid, whose highest probes are below the
/// ceiling, and with one that reaches above the roof.
void measure_courtyard(const Scene& scene) {
    const WorldBox room{{-3.75, 0.1, -2.75}, {3.75, 3.5, 2.75}};
    const LightReference truth =
        bake_reference(scene, free_places(scene, room, kPlaces), kTrueSamples);
    const WorldBox high{{-20.0, 0.0, -20.0}, {20.0, 5.5, 20.0}};
    for (const double spacing : {2.0, 1.0}) {
        const std::string name = str_cat(spacing, "m");
        measure({"leak.courtyard", scene, truth}, name, lattice(scene, spacing), 1024);
        measure({"leak.courtyard.high", scene, truth}, name, lattice(scene, spacing, high), 1024);
    }
}

}  // namespace

void bench_leak_places(const Options& options) {
    measure_house(options);
    if (options.is_quick) return;
    const std::vector<GridSubject> subjects = grid_subjects(options);
    measure_courtyard(subjects.front().scene);
    if (!options.scene) return;
    const GridSubject& subject = subjects.back();
    const LightReference truth = make_reference(subject, kPlaces, 1024);
    const ProbeGrid grid = regular_grid(subject, 1500);
    measure({"leak.scene", subject.scene, truth}, "1500", grid, 1024);
}

}  // namespace tetralight::bench
