// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_comparison.h>
#include <tetralight/bench/grid_inside.h>
#include <tetralight/bench/grid_scenes.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {

void bench_grid(const Options& options) {
    std::vector<double> ratios, fractions;
    double inside_count = 0.0;
    for (const GridSubject& subject : grid_subjects(options)) {
        if (options.only.value_or(subject.name) != subject.name) continue;
        inside_count += measure_inside(subject, options);
        const GridComparison comparison = compare_grids(subject, options);
        inside_count += comparison.inside_count;
        ratios.insert(ratios.end(), comparison.ratios.begin(), comparison.ratios.end());
        if (comparison.probes_for_error) fractions.push_back(*comparison.probes_for_error);
    }
    require(!ratios.empty(), "a scene with the name that --only gives");
    report("grid.inside", inside_count, "probes and candidates of all");
    report("grid.adaptive_over_regular", median(ratios),
           "error of adaptive probes / error of as many regular ones, median");
    if (!fractions.empty()) {
        report("grid.probes_for_error", median(fractions), "of about 3000 regular probes, median");
    }
    require(inside_count == 0.0, "no probe inside geometry");
}

}  // namespace tetralight::bench
