// SPDX-License-Identifier: Apache-2.0
// What must hold for every kind of probe set, at any size: no probe is lost, and every position is
// found where it is. TETRALIGHT_NIGHTLY=1 runs the sizes of a night.
#include <algorithm>
#include <iostream>
#include <set>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/adversarial_positions.h"
#include "tests/support/location_oracle.h"
#include "tests/support/property.h"
#include "tests/support/property_volume.h"
#include "tests/support/sized_families.h"

namespace tetralight {
namespace {

using Positions = std::vector<glm::dvec3>;

class Properties : public testing::TestWithParam<size_t> {
  protected:
    test::SizedFamily family = test::sized_families()[GetParam()];

    /// Calls `check(positions, seed)` for many small sets and one of `largest` probes.
    template <class Check>
    void for_sets(int case_count, size_t largest, Check check) {
        test::check_property(case_count, [&] {
            const auto count = *rc::gen::inRange<uint32_t>(1, 1000).as("probes");
            const auto seed = *rc::gen::arbitrary<uint64_t>().as("seed");
            check(family.make(count, seed), seed);
        });
        test::check_property(1,
                             [&] { check(family.make(std::min(largest, family.largest), 1), 1); });
    }
};

void check_sources(const ProbeVolume& volume, const std::vector<ProbeGroup>& groups) {
    size_t source = 0;
    std::vector<bool> has_source(volume.positions.size(), false);
    double extent = 0.0;
    for (const glm::dvec3& p : volume.exact_positions) {
        extent = std::max(extent, glm::distance(p, volume.exact_positions[0]));
    }
    for (uint32_t g = 0; g < groups.size(); ++g) {
        for (uint32_t i = 0; i < groups[g].positions.size(); ++i) {
            RC_ASSERT(source < volume.sources.size());
            const ProbeSource& found = volume.sources[source++];
            RC_ASSERT(found.group == g);
            RC_ASSERT(found.index == i);
            RC_ASSERT(found.probe < volume.positions.size());
            has_source[found.probe] = true;
            // Welded or snapped: by less than the tolerance of any spacing in the set.
            RC_ASSERT(glm::distance(volume.exact_positions[found.probe], groups[g].positions[i]) <=
                      1e-3 * extent);
        }
    }
    RC_ASSERT(source == volume.sources.size());
    RC_ASSERT(std::ranges::count(has_source, false) == 0);
}

TEST_P(Properties, NoProbeIsLostUnreported) {
    for_sets(20, test::is_nightly() ? 100'000 : 5'000, [](const Positions& positions, uint64_t) {
        const auto groups = test::in_three_groups(positions);
        const auto merged = merge(groups);
        RC_ASSERT(static_cast<bool>(merged));
        RC_ASSERT(merged->welded_count() == positions.size() - merged->positions.size());
        const ProbeVolume volume = make_probe_volume(*merged);
        check_sources(volume, groups);
        const auto status = verify(volume.view());
        if (!status) RC_FAIL(error_text(status.error()));
        for (const std::string& problem : validate(volume.view()).problems()) RC_FAIL(problem);
    });
}

/// Counts over the positions of many volumes.
struct Survey {
    int set_count = 0;
    uint64_t count = 0;
    uint64_t steps = 0;
    uint32_t most_steps = 0;
    uint64_t fallbacks = 0;
    double largest_miss = 0.0;  ///< as a share of the cell's size
};

void check_weights(const CellLocation& location) {
    const glm::vec4& w = location.weights;
    RC_ASSERT(location.ambient == 0.0f);
    RC_ASSERT(std::min({w.x, w.y, w.z, w.w}) >= 0.0f);
    RC_ASSERT(std::abs(w.x + w.y + w.z + w.w - 1.0f) <= 1e-5f);
}

void check_positions(const Positions& positions, uint64_t seed, size_t count, Survey& survey) {
    const ProbeVolume volume = test::make_random_volume(positions, seed);
    const ProbeVolumeView view = volume.view();
    const test::LocationOracle oracle(view);
    std::mt19937_64 engine(seed);
    test::AdversarialPositions places(volume, seed);
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 p = places.next();
        // No hint, or any cell.
        const auto any = static_cast<uint32_t>(engine() % volume.cells.size());
        const LocationTrace trace = trace_location(view, p, i % 2 == 0 ? kNoIndex : any);
        check_weights(trace.location);
        const test::Miss miss = oracle.measure(p, trace.location);
        if (!miss.is_rounding()) {
            RC_FAIL(str_cat("(", p.x, ", ", p.y, ", ", p.z, ") is not in cell ",
                            trace.location.cell, " of ", volume.cells.size(), " (",
                            volume.info.inner_cell_count, " inner), but beside it by ",
                            miss.distance, " m"));
        }
        survey.largest_miss = std::max(survey.largest_miss, miss.share());
        survey.steps += trace.step_count;
        survey.most_steps = std::max(survey.most_steps, trace.step_count);
        survey.fallbacks += trace.is_fallback;
    }
    survey.count += count;
}

void report(const std::string& name, const Survey& survey) {
    testing::Test::RecordProperty("positions", std::to_string(survey.count));
    testing::Test::RecordProperty("most_steps", std::to_string(survey.most_steps));
    testing::Test::RecordProperty("fallbacks", std::to_string(survey.fallbacks));
    std::cout << str_cat(name, ": ", survey.count, " positions, ",
                         static_cast<double>(survey.steps) / static_cast<double>(survey.count),
                         " steps, at most ", survey.most_steps, ", ", survey.fallbacks,
                         " fallbacks, largest miss ", survey.largest_miss, "\n");
}

TEST_P(Properties, EveryPositionIsFoundInItsCellWithConvexWeights) {
    constexpr int kCaseCount = 40;
    const size_t budget = test::is_nightly() ? 10'000'000 : 100'000;
    const size_t largest = test::is_nightly() ? 100'000 : 10'000;
    Survey survey;
    for_sets(kCaseCount, largest, [&](const Positions& positions, uint64_t seed) {
        const bool is_last = survey.set_count++ == kCaseCount;
        check_positions(positions, seed, is_last ? budget / 2 : budget / 2 / kCaseCount, survey);
    });
    report(family.name, survey);
}

INSTANTIATE_TEST_SUITE_P(All, Properties, testing::Range<size_t>(0, test::sized_families().size()),
                         [](const auto& instance) {
                             return test::sized_families()[instance.param].name;
                         });

/// The family at the largest size of normal runs.
void check_large(const char* name) {
    const auto families = test::sized_families();
    const auto family = std::ranges::find(families, std::string(name), &test::SizedFamily::name);
    Survey survey;
    test::check_property(1, [&] { check_positions(family->make(100'000, 3), 3, 100'000, survey); });
    report(family->name, survey);
}

TEST(LargeProperties, EveryPositionOfARandomSetIsFound) {
    check_large("random");
}

TEST(LargeProperties, EveryPositionOfALatticeIsFound) {
    check_large("turned_lattice");
}

}  // namespace
}  // namespace tetralight
