// SPDX-License-Identifier: Apache-2.0
#include "probes/build/make_probe_volume.h"

#include <gtest/gtest.h>

#include "probes/build/validate.h"
#include "probes/probe_file.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

TEST(MakeProbeVolume, IsSoundAndValid) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(1000, 1));
    const auto status = verify(volume.view());
    EXPECT_TRUE(status) << status.error().message;
    EXPECT_TRUE(validate(volume.view()).problems().empty());
}

TEST(MakeProbeVolume, GivesTheSameBytesForEveryOrderOfTheGroups) {
    std::vector<ProbeGroup> groups(3);
    for (size_t i = 0; i < 3; ++i) {
        groups[i].name = std::string(1, static_cast<char>('a' + i));
        groups[i].positions = test::random_positions(50, i);
    }
    const auto bytes = [&] { return probe_file_bytes(make_probe_volume(*merge(groups)).view()); };
    const auto first = bytes();
    std::swap(groups[0], groups[2]);
    EXPECT_EQ(bytes(), first);
}

TEST(MakeProbeVolume, MovesTheLocalOriginOnlyFarAway) {
    std::vector<glm::dvec3> near = test::random_positions(50, 2);
    EXPECT_EQ(test::make_lit_volume(near).info.world_origin, glm::dvec3(0.0));
    for (glm::dvec3& p : near) p.x += 1e5;
    const ProbeVolume far = test::make_lit_volume(near);
    EXPECT_NEAR(far.info.world_origin.x, 1e5, 2.0);
    EXPECT_TRUE(validate(far.view()).problems().empty());
}

TEST(MakeProbeVolume, OfNothingHasNoCells) {
    const auto volume = make_probe_volume(MergedProbes{});
    EXPECT_TRUE(volume.cells.empty());
    EXPECT_TRUE(verify(volume.view()));
}

}  // namespace
}  // namespace tetralight
