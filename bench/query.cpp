// SPDX-License-Identifier: Apache-2.0
#include "bench/harness.h"
#include "probes/build/make_probe_volume.h"
#include "probes/interpolate.h"

namespace tetralight::bench {
namespace {

constexpr size_t kQueryCount = 100'000;

ProbeVolume make_volume(size_t probe_count) {
    ProbeGroup group;
    group.name = "bench";
    group.positions = random_positions(probe_count, 1, 100.0);
    ProbeVolume volume = make_probe_volume(*merge(std::span(&group, 1)));
    for (const glm::vec3& p : volume.positions) {
        volume.irradiance.push_back(irradiance_from_radiance(constant_radiance(p)));
    }
    return volume;
}

/// Objects that stay near the cell of their last query, against the blend alone.
void moving(const std::string& name, size_t probe_count, const Options& options) {
    const ProbeVolume volume = make_volume(probe_count);
    const ProbeVolumeView view = volume.view();
    std::vector<glm::vec3> positions;
    std::vector<CellLocation> locations;
    std::vector<uint32_t> hints;
    for (const glm::dvec3& p : random_positions(kQueryCount, 2, 100.0)) {
        positions.emplace_back(p);
        locations.push_back(locate(view, positions.back(), hints.empty() ? 0 : hints.back()));
        hints.push_back(locations.back().cell);
    }
    std::vector<IrradianceSh> answers(kQueryCount);
    std::vector<IrradianceSh> expected(kQueryCount);

    Contest contest;
    contest.figure = "query.moving." + name;
    contest.unit = "Mq/s";
    contest.baseline_is = "gather only";
    contest.work = kQueryCount * 1e-6;
    contest.ours = [&] {
        return seconds([&] {
            require(bool(interpolate(view, {positions, hints, answers, {}})), "batch query");
        });
    };
    contest.baseline = [&] {
        return seconds([&] {
            for (size_t i = 0; i < kQueryCount; ++i) {
                expected[i] = interpolate(view, locations[i]).irradiance;
            }
        });
    };
    run(contest, options);
    require(answers == expected, contest.figure + ": answers differ from the gathered ones");
}

}  // namespace

void bench_query(const Options& options) {
    moving("2k", 2'000, options);
    moving("20k", 20'000, options);
}

}  // namespace tetralight::bench
