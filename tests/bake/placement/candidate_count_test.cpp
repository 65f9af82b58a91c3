// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/candidate_count.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <limits>

namespace tetralight {
namespace {

constexpr uint64_t kAnyNumber = std::numeric_limits<uint64_t>::max();
constexpr uint64_t kGigabyte = 1'000'000'000;

std::string message(const Status& status) {
    return status ? "" : error_text(status.error());
}

TEST(CandidateCount, AllowsUpToTheLimit) {
    EXPECT_TRUE(check_candidate_count(100.0, 100, kGigabyte));
    EXPECT_EQ(message(check_candidate_count(101.0, 100, kGigabyte)),
              "a grid of 101 probes is more than the limit of 100");
}

TEST(CandidateCount, SaysNumbersBeyondAnyInteger) {
    EXPECT_EQ(message(check_candidate_count(1e300, kAnyNumber, kGigabyte)),
              "a grid of 1e+300 probes is more than the limit of 18446744073709551615");
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(message(check_candidate_count(infinite, 7, kGigabyte)),
              "a grid of inf probes is more than the limit of 7");
}

TEST(CandidateCount, RefusesWhatMemoryDoesNotHold) {
    EXPECT_TRUE(check_candidate_count(1e6, kAnyNumber, kGigabyte));
    EXPECT_EQ(message(check_candidate_count(1e10, kAnyNumber, kGigabyte)),
              "a grid of 10000000000 probes needs about 4000 GB of memory, 1 GB are free");
}

TEST(CandidateCount, RefinedProbesTakeMore) {
    EXPECT_TRUE(check_refined_count(100'000, kGigabyte));
    EXPECT_EQ(message(check_refined_count(1'000'000, kGigabyte)),
              "a grid of 1000000 probes needs about 8 GB of memory, 1 GB are free");
}

}  // namespace
}  // namespace tetralight
