// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_comparison.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/bench/grid_covered.h>
#include <tetralight/bench/grid_inside.h>
#include <tetralight/bench/grid_rays.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kProbeSamples = 1024;
/// Defaults of the generator, metres.
constexpr double kRegularClearance = 0.1, kAdaptiveClearance = 0.05;

/// A regular grid is a baseline if it has at most this factor times the adaptive probes.
constexpr double kComparable = 1.1;

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

/// How many probes are asked for.
struct Counts {
    std::vector<uint64_t> all{100, 300, 1000, 3000};
    /// That of the figures about cover.
    uint64_t covered = 300;

    Counts(const GridSubject& subject, const Options& options) {
        if (subject.is_external()) {
            all = {300, 1000, 3000};
            covered = 1000;
        }
        if (options.is_quick) {
            covered = subject.is_external() ? 1000 : 300;
            all = {covered};
        }
    }
};

class Comparison {
  public:
    Comparison(const GridSubject& subject, const Options& options)
        : subject_(subject),
          counts_(subject, options),
          reference_(make_reference(subject, options.is_quick ? 1500 : 5000,
                                    options.is_quick ? 2048 : 8192)) {
        report("grid.noise." + subject.name, 100.0 * reference_.noise,
               str_cat("% of the light of ", reference_.light.size(), " places"));
    }

    GridComparison run() {
        if (!subject_.is_external()) measure_a_metre_apart();
        for (const uint64_t count : counts_.all) compare(count);
        if (adaptive_.size() > 1 && !regular_.empty()) {
            const auto& [regular_count, error] = regular_.back();
            result_.probes_for_error = count_for(adaptive_, error) / regular_count;
            report("grid.probes_for_error." + subject_.name, *result_.probes_for_error,
                   str_cat("of ", regular_count, " regular probes"));
        }
        return result_;
    }

  private:
    void measure_a_metre_apart() {
        const ProbeGrid grid = spaced_grid(subject_, 1.0);
        result_.inside_count += count_inside(subject_, grid);
        const BakedVolume baked = bake_grid(subject_, grid, kProbeSamples);
        report_places({subject_, "regular_1m", kRegularClearance, baked.volume.view()});
    }

    void report_places(const BakedGrid& grid) const {
        report_cover(grid, reference_);
        report_unlit(grid);
    }

    LightErrors errors_of(const char* kind, uint64_t asked, const ProbeGrid& grid) {
        result_.inside_count += count_inside(subject_, grid);
        const BakedVolume baked = bake_grid(subject_, grid, kProbeSamples);
        const LightErrors errors = light_errors(baked.volume.view(), reference_);
        report(str_cat("grid.error.", subject_.name, ".", kind, ".", asked), 100.0 * errors.rms,
               str_cat("% with ", grid.probe_count(), " probes"));
        if (grid.adaptive && asked == counts_.covered) {
            report_places(
                {subject_, str_cat(kind, "_", asked), kAdaptiveClearance, baked.volume.view()});
        }
        return errors;
    }

    void compare(uint64_t asked) {
        const ProbeGrid adaptive = adaptive_grid(subject_, asked);
        const auto made = static_cast<double>(adaptive.probe_count());
        report(str_cat("grid.asked_made.", subject_.name, ".", asked),
               made / static_cast<double>(asked), "probes made / asked for");
        if (subject_.is_external() && asked == counts_.covered) {
            report_rays(subject_, adaptive, asked);
        }
        const LightErrors ours = errors_of("adaptive", asked, adaptive);
        const ProbeGrid regular = regular_grid(subject_, adaptive.probe_count());
        const auto regular_count = static_cast<double>(regular.probe_count());
        adaptive_.push_back({made, ours.rms});
        if (regular_count > kComparable * made) {
            report(str_cat("grid.regular_needs.", subject_.name, ".", asked), regular_count,
                   "probes: no regular grid that covers the scene has fewer");
            return;
        }
        const LightErrors baseline = errors_of("regular", asked, regular);
        regular_.push_back({regular_count, baseline.rms});
        result_.ratios.push_back(ours.rms / baseline.rms);
        report_errors(asked, ours, baseline, str_cat(regular.probe_count(), " regular probes"));
    }

    void report_errors(uint64_t asked, const LightErrors& ours, const LightErrors& baseline,
                       const std::string& baseline_is) const {
        const std::string end = str_cat(".", subject_.name, ".", asked);
        const std::string unit = "% of the mean light", name = "grid.adaptive_over_regular" + end;
        report_contest(name + ".rms", 100.0 * ours.rms, 100.0 * baseline.rms, unit, baseline_is);
        report_contest(name + ".p95", 100.0 * ours.p95, 100.0 * baseline.p95, unit, baseline_is);
        report_contest(name + ".mean", 100.0 * ours.mean, 100.0 * baseline.mean, unit, baseline_is);
        report_contest("grid.relative" + end, 100.0 * ours.relative, 100.0 * baseline.relative,
                       "% of the light of a place, median", baseline_is);
    }

    const GridSubject& subject_;
    Counts counts_;
    LightReference reference_;
    std::vector<ErrorAt> adaptive_, regular_;
    GridComparison result_;
};

}  // namespace

GridComparison compare_grids(const GridSubject& subject, const Options& options) {
    return Comparison(subject, options).run();
}

}  // namespace tetralight::bench
