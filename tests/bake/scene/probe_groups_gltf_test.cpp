// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/probe_groups_gltf.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

std::vector<ProbeGroup> read_back(const std::vector<ProbeGroup>& groups) {
    const TempFolder folder;
    const auto status = write_probe_groups_glb(folder.path("g.glb"), groups);
    EXPECT_TRUE(status) << error_text(status.error());
    const auto scene = read_gltf(folder.path("g.glb"));
    EXPECT_TRUE(scene) << error_text(scene.error());
    EXPECT_TRUE(scene->warnings.empty());
    return scene->probe_groups;
}

glm::dvec3 world(const ProbeGroup& group, size_t i) {
    return glm::dvec3(group.world_from_group * glm::dvec4(group.positions[i], 1.0));
}

TEST(ProbeGroupsGltf, ComeBackWithTheirNamesAndFlags) {
    const std::vector<ProbeGroup> groups{
        {"hall \"1\"", glm::dmat4(1.0), {{1, 2, 3}, {-4, 5, 6.5}}, true},
        {"Küche", glm::dmat4(1.0), {{0, 0, 0}}, false, 0x80000009}};
    const auto back = read_back(groups);
    ASSERT_EQ(back.size(), 2u);
    for (size_t g = 0; g < groups.size(); ++g) {
        EXPECT_EQ(back[g].name, groups[g].name);
        EXPECT_EQ(back[g].dering, groups[g].dering);
        EXPECT_EQ(back[g].rendering_layers, groups[g].rendering_layers);
        ASSERT_EQ(back[g].positions.size(), groups[g].positions.size());
        for (size_t i = 0; i < groups[g].positions.size(); ++i) {
            EXPECT_EQ(world(back[g], i), groups[g].positions[i]);
        }
    }
}

TEST(ProbeGroupsGltf, FarFromTheOriginNothingIsLost) {
    // Floats at 1e7 are a metre apart; halves relative to the first probe are exact.
    const ProbeGroup group{"far", glm::dmat4(1.0), {{1e7, 0, 0}, {1e7 + 0.5, 0, 0.25}}};
    const auto back = read_back({group});
    EXPECT_EQ(world(back[0], 1), group.positions[1]);
}

TEST(ProbeGroupsGltf, KeepATransform) {
    const auto transform = glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(0, 1, 0));
    const ProbeGroup group{"turned", transform, {{1, 0, 0}, {0, 1, 2}}};
    const auto back = read_back({group});
    for (size_t i = 0; i < 2; ++i) {
        const glm::dvec3 d = world(back[0], i) - world(group, i);
        EXPECT_LT(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), 1e-12);
    }
}

TEST(ProbeGroupsGltf, AGroupMayBeEmpty) {
    const auto back = read_back({{"empty", glm::dmat4(1.0), {}}});
    ASSERT_EQ(back.size(), 1u);
    EXPECT_TRUE(back[0].positions.empty());
}

TEST(ProbeGroupsGltf, RefusesWhatIsNoListOfGroups) {
    const TempFolder folder;
    const std::string path = folder.path("g.glb");
    const ProbeGroup one{"a", glm::dmat4(1.0), {{0, 0, 0}}};
    EXPECT_FALSE(write_probe_groups_glb(path, {}));
    EXPECT_FALSE(write_probe_groups_glb(path, std::vector{one, one}));
    const auto status =
        write_probe_groups_glb(path, std::vector{ProbeGroup{"\xff", glm::dmat4(1.0), {{0, 0, 0}}}});
    ASSERT_FALSE(status);
    EXPECT_NE(error_text(status.error()).find("not UTF-8"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace tetralight
