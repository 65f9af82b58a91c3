// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/remove_probes.h>

#include <gtest/gtest.h>

#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

MergedProbes merged(size_t count) {
    std::vector<ProbeGroup> groups(2);
    groups[0].name = "a";
    groups[0].positions = test::random_positions(count, 1);
    groups[1].name = "b";
    groups[1].positions = {groups[0].positions[0], groups[0].positions[1]};  // welded
    auto probes = merge(groups);
    EXPECT_TRUE(probes);
    return std::move(*probes);
}

TEST(RemoveProbes, KeepsTheOthersInOrderAndAccountsForAll) {
    const MergedProbes before = merged(30);
    std::vector<bool> is_left_out(30, false);
    for (size_t i = 0; i < 30; i += 3) is_left_out[i] = true;
    const MergedProbes after = remove_probes(before, is_left_out);
    ASSERT_EQ(after.positions.size(), 20u);
    ASSERT_EQ(after.sources.size(), before.sources.size());
    for (size_t i = 0; i < before.sources.size(); ++i) {
        const ProbeSource &was = before.sources[i], &is = after.sources[i];
        EXPECT_EQ(is.group, was.group);
        EXPECT_EQ(is.index, was.index);
        if (is_left_out[was.probe]) {
            EXPECT_EQ(is.probe, kNoIndex);
        } else {
            EXPECT_EQ(after.positions[is.probe], before.positions[was.probe]);
        }
    }
    for (size_t i = 0; i < 20; ++i)
        EXPECT_EQ(after.positions[i], before.positions[i / 2 * 3 + 1 + i % 2]);
}

TEST(RemoveProbes, CountsOnlyProbesThatAreThereAsWelded) {
    const MergedProbes before = merged(30);
    EXPECT_EQ(before.welded_count(), 2u);
    std::vector<bool> is_left_out(30, false);
    is_left_out[before.sources[0].probe] = true;
    EXPECT_EQ(remove_probes(before, is_left_out).welded_count(), 1u);
}

TEST(RemoveProbes, GivesSoundVolumes) {
    std::vector<bool> is_left_out(100, false);
    for (size_t i = 0; i < 100; i += 7) is_left_out[i] = true;
    const ProbeVolume volume = make_probe_volume(remove_probes(merged(100), is_left_out));
    EXPECT_TRUE(verify(volume.view()));
    EXPECT_TRUE(validate(volume.view()).problems().empty());
}

}  // namespace
}  // namespace tetralight
