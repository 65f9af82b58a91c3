// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/grid_rays.h>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {
namespace {

/// A bake takes long: rays are counted for one of this many probes.
constexpr size_t kStep = 20;

/// The rays of a bake of all probes.
double rays_of_bake(const GridSubject& subject, const ProbeGrid& grid) {
    std::vector<glm::dvec3> some;
    size_t count = 0;
    for (const ProbeGroup& group : grid.groups) {
        for (const glm::dvec3& position : group.positions) {
            if (count++ % kStep == 0) some.push_back(position);
        }
    }
    const auto baked = bake_probes(subject.scene, some, with_default_target({}));
    require(bool(baked), "bake");
    return static_cast<double>(baked->ray_count) * static_cast<double>(count) /
           static_cast<double>(some.size());
}

}  // namespace

void report_rays(const GridSubject& subject, const ProbeGrid& grid, uint64_t asked) {
    require(grid.adaptive.has_value(), "an adaptive grid");
    report(str_cat("grid.rays.", subject.name, ".", asked),
           static_cast<double>(grid.adaptive->ray_count) / rays_of_bake(subject, grid),
           str_cat("of the rays of a default bake, estimated from every ", kStep, "th probe"));
}

}  // namespace tetralight::bench
