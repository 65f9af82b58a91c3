// SPDX-License-Identifier: Apache-2.0
// Errors of whole bakes at default settings. Bakes with different seeds are independent and all
// have the same mean, so that their spread is their error: no longer bake is needed.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bench/bake_errors.h>
#include <tetralight/bench/bake_scenes.h>

namespace tetralight::bench {
namespace {

/// The bakes of one probe.
struct ProbeBakes {
    double light = 0.0;      ///< mean irradiance
    double actual = 0.0;     ///< mean square of the relative error
    double predicted = 0.0;  ///< the same by the standard errors
    std::vector<double> errors;
};

ProbeBakes examine(const std::vector<BakedProbes>& bakes, size_t probe) {
    const auto count = static_cast<double>(bakes.size());
    RadianceSh mean;
    for (const BakedProbes& bake : bakes) {
        mean += static_cast<float>(1.0 / count) * bake.radiance[probe];
    }
    // The mean includes the bake that is compared with it.
    const double correction = std::sqrt(count / (count - 1.0));
    ProbeBakes result;
    result.light = mean_irradiance(mean);
    for (const BakedProbes& bake : bakes) {
        result.errors.push_back(correction * relative_rmse(bake.radiance[probe], mean));
        const double actual = correction * parseval_error(bake.radiance[probe], mean);
        const double predicted = bake.standard_error[probe];
        result.actual += actual * actual / count;
        result.predicted += predicted * predicted / count;
    }
    return result;
}

void report_error_bar(const std::string& figure, std::span<const ProbeBakes> probes) {
    std::vector<double> ratios;
    for (const ProbeBakes& probe : probes) {
        if (probe.actual > 0.0) ratios.push_back(std::sqrt(probe.predicted / probe.actual));
    }
    if (!ratios.empty()) report(figure, median(ratios), "predicted / actual");
}

}  // namespace

void bench_bake_noise(const BakeSubject& subject, const Options& options) {
    BakeSettings settings = with_default_target({});
    const std::vector<glm::dvec3> positions =
        options.is_quick ? some_probes(subject) : subject.probes;
    std::vector<BakedProbes> bakes;
    std::vector<double> bake_seconds;
    // A few bakes, and more of them where they are fast.
    const double budget = options.is_quick ? 5.0 : 20.0;
    double spent = 0.0;
    const uint64_t least = options.is_quick ? 2 : 3;
    for (; settings.seed < least || (settings.seed < 8 && spent < budget); ++settings.seed) {
        bake_seconds.push_back(seconds([&] {
            auto baked = bake_probes(subject.scene, positions, settings);
            require(bool(baked), "bake");
            bakes.push_back(std::move(*baked));
        }));
        spent += bake_seconds.back();
    }
    std::vector<ProbeBakes> probes;
    for (size_t i = 0; i < positions.size(); ++i) probes.push_back(examine(bakes, i));
    std::erase_if(probes, [](const ProbeBakes& probe) { return !(probe.light > 0.0); });
    require(!probes.empty(), "light at the probes of " + subject.name);
    std::ranges::stable_sort(probes, {}, &ProbeBakes::light);

    std::vector<double> errors;
    for (const ProbeBakes& probe : probes) {
        for (const double error : probe.errors) errors.push_back(100.0 * error);
    }
    std::ranges::sort(errors);
    report("bake.noise.median." + subject.name, median(errors), "%");
    report("bake.noise.p99." + subject.name, errors[(errors.size() - 1) * 99 / 100], "%");
    report("bake.noise.seconds." + subject.name, median(bake_seconds),
           options.is_quick ? "s a bake of 16 probes" : "s a bake");
    report_error_bar("bake.error_bar." + subject.name, probes);
    report_error_bar("bake.error_bar.darkest_tenth." + subject.name,
                     std::span(probes).first((probes.size() + 9) / 10));
}

}  // namespace tetralight::bench
