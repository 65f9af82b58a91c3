// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/place_range.h>

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include <tetralight/base/error_text.h>

namespace tetralight {
namespace {

std::string error_of(const std::vector<FileRange>& files, size_t count) {
    const Status status = check_cover(files, {"probe", count});
    return status ? "" : error_text(status.error());
}

TEST(PlaceRange, CountsEveryStep) {
    for (uint32_t begin = 0; begin < 5; ++begin) {
        for (uint32_t end = begin; end < 20; ++end) {
            for (uint32_t step = 1; step < 22; ++step) {
                const PlaceRange range{begin, end, step};
                uint32_t count = 0;
                for (uint32_t place = begin; place < end; place += step) {
                    EXPECT_EQ(range[count], place);
                    ++count;
                }
                EXPECT_EQ(range.count(), count);
                uint32_t contained = 0;
                for (uint32_t place = 0; place < 25; ++place) contained += range.contains(place);
                EXPECT_EQ(contained, count);
            }
        }
    }
    const uint32_t most = UINT32_MAX;
    EXPECT_EQ((PlaceRange{1, most, most}.count()), 1u);
}

TEST(PlaceRange, IsNamedAsOptionsAre) {
    EXPECT_EQ(name_of({12, 20}), "12..20");
    EXPECT_EQ(name_of({12, 20, 4}), "12..20x4");
}

TEST(SpreadRanges, AreAllPlacesOnceEach) {
    for (const size_t places : {1u, 2u, 7u, 64u, 1000u}) {
        for (const size_t count : {1u, 2u, 5u, 64u, 2000u}) {
            const auto ranges = spread_ranges(places, count);
            EXPECT_EQ(ranges.size(), std::min(places, count));
            std::multiset<uint32_t> seen;
            for (const PlaceRange& range : ranges) {
                EXPECT_NEAR(range.count(),
                            static_cast<double>(places) / static_cast<double>(ranges.size()), 1.0);
                for (uint32_t i = 0; i < range.count(); ++i) seen.insert(range[i]);
            }
            std::vector<uint32_t> all(places);
            std::iota(all.begin(), all.end(), 0u);
            EXPECT_TRUE(std::ranges::equal(seen, all));
        }
    }
}

TEST(SpreadRanges, WithoutPlacesAreOneEmptyRange) {
    const auto ranges = spread_ranges(0, 4);
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].count(), 0u);
}

TEST(SpreadRanges, AreAsExpensiveAsEachOther) {
    // Costs that change slowly along the order of the bake.
    std::vector<double> costs;
    for (int i = 0; i < 6400; ++i) costs.push_back(i < 5000 ? 1.0 : 1.0 + 0.01 * (i - 5000));
    const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / 64.0;
    for (const PlaceRange& range : spread_ranges(costs.size(), 64)) {
        const std::vector<double> own = take<double>(costs, range);
        EXPECT_NEAR(std::accumulate(own.begin(), own.end(), 0.0), mean, 0.05 * mean);
    }
}

TEST(TakeAndPut, AreInversesOfEachOther) {
    constexpr size_t kEach = 3;
    std::vector<int> all(25 * kEach);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(take<int>(all, {1, 8, 5}, kEach), (std::vector<int>{3, 4, 5, 18, 19, 20}));
    std::vector<int> copy(all.size());
    for (const PlaceRange& range : spread_ranges(25, 4))
        put<int>(take<int>(all, range, kEach), range, copy, kEach);
    EXPECT_EQ(copy, all);
}

TEST(CheckCover, TakesRangesAndStepsInAnyOrder) {
    EXPECT_EQ(error_of({{"b", {4, 20}}, {"a", {0, 4}}}, 20), "");
    EXPECT_EQ(error_of({{"a", {0, 4, 2}}, {"c", {4, 20}}, {"b", {1, 4, 2}}}, 20), "");
}

TEST(CheckCover, NamesWhatIsMissingOrTwice) {
    EXPECT_EQ(error_of({{"a", {0, 20, 2}}}, 20),
              "probes 1..2 and 9 others of 20 are in no part; the next, 0..20x2, are in a");
    EXPECT_EQ(error_of({{"a", {0, 20, 2}}, {"b", {1, 17, 2}}}, 20),
              "probes 17..18 and 1 others of 20 are in no part; the next, 0..20x2, are in a");
    EXPECT_EQ(error_of({{"a", {0, 20, 2}}, {"b", {1, 20, 3}}}, 20),
              "b: probes 1..20x3 overlap probes 0..20x2 of a");
    EXPECT_EQ(error_of({{"a", {0, 0}}}, 3),
              "probes 0..3 of 3 are in no part; the last, 0..0, are in a");
}

}  // namespace
}  // namespace tetralight
