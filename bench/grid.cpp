// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/bench/grid_error.h>
#include <tetralight/bench/grid_inside.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {
namespace {

constexpr uint64_t kRegularCount = 4000;

/// A point of a curve of error over probes.
struct ErrorAt {
    double probe_count = 0.0;
    double error = 0.0;
};

/// The number of probes at which the curve reaches an error, interpolated on logarithmic axes; the
/// end of the curve if it does not.
double count_for(const std::vector<ErrorAt>& curve, double error) {
    if (curve.front().error <= error) return curve.front().probe_count;
    for (size_t i = 1; i < curve.size(); ++i) {
        if (curve[i].error > error) continue;
        const auto& [n0, e0] = curve[i - 1];
        const auto& [n1, e1] = curve[i];
        const double t = std::log(e0 / error) / std::log(e0 / e1);
        return n0 * std::pow(n1 / n0, t);
    }
    return curve.back().probe_count;
}

struct Outcome {
    /// Probes that adaptive grids need for the error of a lattice of 4000, over 4000.
    double fraction = 0.0;
    /// Probes inside of closed meshes, of all grids.
    double inside_count = 0.0;
};

Outcome probes_for_error(const GridSubject& subject, const Options& options) {
    const size_t position_count = options.is_quick ? 4000 : 20'000;
    const uint32_t reference_samples = options.is_quick ? 512 : 2048;
    constexpr uint32_t kProbeSamples = 1024;
    const LightReference reference = make_reference(subject, position_count, reference_samples);
    Outcome outcome;
    const auto error_of = [&](const char* kind, uint64_t wanted, const ProbeGrid& grid) {
        outcome.inside_count += count_inside(subject, grid);
        const double error = light_error(subject, grid, reference, kProbeSamples);
        report(str_cat("grid.error.", subject.name, ".", kind, ".", wanted), 100.0 * error,
               str_cat("% with ", grid.probe_count(), " probes"));
        return ErrorAt{static_cast<double>(grid.probe_count()), error};
    };
    std::vector<uint64_t> counts{250, 500, 1000, 2000, 4000};
    if (options.is_quick) counts = {500, 1000, 2000};
    const double goal =
        error_of("regular", kRegularCount, regular_grid(subject, kRegularCount)).error;
    std::vector<ErrorAt> curve;
    for (const uint64_t count : counts) {
        curve.push_back(error_of("adaptive", count, adaptive_grid(subject, count)));
        if (options.is_quick && curve.back().error <= goal) break;
    }
    for (const uint64_t count : counts) {
        if (options.is_quick || count == kRegularCount) continue;
        error_of("regular", count, regular_grid(subject, count));
    }
    outcome.fraction = count_for(curve, goal) / static_cast<double>(kRegularCount);
    report("grid.probes_for_error." + subject.name, outcome.fraction, "of 4000 regular probes");
    return outcome;
}

}  // namespace

void bench_grid(const Options& options) {
    std::vector<double> fractions;
    double inside_count = 0.0;
    for (const GridSubject& subject : grid_subjects(options)) {
        inside_count += measure_inside(subject, options);
        const Outcome outcome = probes_for_error(subject, options);
        inside_count += outcome.inside_count;
        fractions.push_back(outcome.fraction);
    }
    report("grid.inside", inside_count, "probes and candidates of all");
    report("grid.probes_for_error", median(fractions), "of 4000 regular probes, median");
    require(inside_count == 0.0, "no probe inside geometry");
}

}  // namespace tetralight::bench
