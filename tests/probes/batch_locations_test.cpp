// SPDX-License-Identifier: Apache-2.0
// Cells and weights come from the same batch as light.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <thread>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

/// All outputs of a batch.
struct Answers {
    std::vector<IrradianceSh> irradiance;
    std::vector<glm::vec4> occlusion;
    std::vector<CellLocation> locations;

    explicit Answers(size_t count) : irradiance(count), occlusion(count), locations(count) {}

    bool operator==(const Answers&) const = default;
};

class BatchLocations : public testing::Test {
  protected:
    ProbeVolume volume = test::make_lit_volume(test::random_positions(2000, 1));
    std::vector<glm::vec3> positions = make_positions(5000);

    /// In the box of the probes and around it.
    static std::vector<glm::vec3> make_positions(size_t count) {
        std::vector<glm::vec3> result;
        for (const glm::dvec3& p : test::random_positions(count, 2)) result.emplace_back(1.5 * p);
        return result;
    }

    [[nodiscard]] Answers ask(std::span<const glm::vec3> asked,
                              const OutsideHull& outside = {}) const {
        Answers answers(asked.size());
        EXPECT_TRUE(interpolate(volume.view(), {.positions = asked,
                                                .irradiance = answers.irradiance,
                                                .occlusion = answers.occlusion,
                                                .outside = outside,
                                                .locations = answers.locations}));
        return answers;
    }
};

TEST_F(BatchLocations, AreThoseOfSingleQueries) {
    for (const OutsidePolicy policy :
         {OutsidePolicy::Extrapolate, OutsidePolicy::Clamp, OutsidePolicy::Ambient}) {
        const OutsideHull outside{policy, 3.0f};
        const Answers answers = ask(positions, outside);
        for (size_t i = 0; i < positions.size(); ++i) {
            const CellLocation expected = locate(volume.view(), positions[i], kNoIndex, outside);
            ASSERT_EQ(answers.locations[i], expected) << "answer " << i;
        }
    }
}

TEST_F(BatchLocations, ChangeNoBitOfTheLight) {
    const Answers expected = ask(positions);
    Answers without(positions.size());
    ASSERT_TRUE(interpolate(volume.view(), {.positions = positions,
                                            .irradiance = without.irradiance,
                                            .occlusion = without.occlusion}));
    EXPECT_TRUE(without.irradiance == expected.irradiance);
    EXPECT_TRUE(without.occlusion == expected.occlusion);
}

TEST_F(BatchLocations, MayBeTheOnlyOutput) {
    std::vector<CellLocation> locations(positions.size());
    ASSERT_TRUE(interpolate(volume.view(), {.positions = positions, .locations = locations}));
    EXPECT_EQ(locations, ask(positions).locations);
}

TEST_F(BatchLocations, DoNotDependOnTheOrderOfPositions) {
    std::vector<size_t> order(positions.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::shuffle(order, std::mt19937(3));
    std::vector<glm::vec3> shuffled;
    for (const size_t i : order) shuffled.push_back(positions[i]);
    const Answers expected = ask(positions);
    const Answers answers = ask(shuffled);
    for (size_t i = 0; i < order.size(); ++i) {
        ASSERT_EQ(answers.locations[i], expected.locations[order[i]]);
        ASSERT_EQ(answers.irradiance[i], expected.irradiance[order[i]]);
    }
}

TEST_F(BatchLocations, DoNotDependOnTheSizeOfTheBatch) {
    const Answers expected = ask(positions);
    for (const size_t size : {size_t{1}, size_t{7}, size_t{256}, size_t{1024}}) {
        for (size_t begin = 0; begin + size <= positions.size(); begin += 5 * size) {
            const Answers part = ask(std::span(positions).subspan(begin, size));
            for (size_t i = 0; i < size; ++i) {
                ASSERT_EQ(part.locations[i], expected.locations[begin + i]);
                ASSERT_EQ(part.irradiance[i], expected.irradiance[begin + i]);
            }
        }
    }
}

TEST_F(BatchLocations, FollowHintsAndSorting) {
    const Answers expected = ask(positions);
    std::vector<uint32_t> hints(positions.size(), kNoIndex);
    std::vector<uint64_t> sort_memory(2 * positions.size());
    for (const bool is_sorted : {false, true}) {
        std::vector<CellLocation> locations(positions.size());
        ASSERT_TRUE(interpolate(volume.view(),
                                {.positions = positions,
                                 .hints = hints,
                                 .sort_memory = is_sorted ? sort_memory : std::span<uint64_t>(),
                                 .locations = locations}));
        EXPECT_EQ(locations, expected.locations);
        for (size_t i = 0; i < hints.size(); ++i) ASSERT_EQ(hints[i], locations[i].cell);
    }
}

TEST_F(BatchLocations, ComeFromTheCallersThreads) {
    positions = make_positions(2 * kBatchTaskSize + 17);
    Answers answers(positions.size());
    const auto on_threads = [](size_t count, auto&& task) {
        std::vector<std::jthread> threads;
        for (size_t i = 0; i < count; ++i) threads.emplace_back([&task, i] { task(i); });
    };
    const InterpolationBatch batch{.positions = positions,
                                   .irradiance = answers.irradiance,
                                   .occlusion = answers.occlusion,
                                   .locations = answers.locations};
    ASSERT_TRUE(interpolate(volume.view(), batch, on_threads));
    EXPECT_TRUE(answers == ask(positions));
}

TEST_F(BatchLocations, HaveRoomForEachPosition) {
    std::vector<CellLocation> locations(positions.size() - 1);
    const auto report =
        interpolate(volume.view(), {.positions = positions, .locations = locations});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().field, "locations");
    EXPECT_NE(error_text(report.error()).find("4999"), std::string::npos);
}

}  // namespace
}  // namespace tetralight
