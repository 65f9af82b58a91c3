// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/import_groups.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/imports/import_case.h"

namespace tetralight {
namespace {

constexpr const char* kJson = R"({"groups": [{"name": "hall", "positions": [[1, 2, 3]]}]})";

TEST(ImportGroups, TakesTheReaderOfTheExtensionInAnyCase) {
    for (const char* name : {"a.csv", "a.CSV"})
        EXPECT_EQ(sound_import(name, "1,2,3").groups.at(0).positions.size(), 1u);
}

TEST(ImportGroups, ReadsFilesOfOtherExtensionsAsJson) {
    for (const char* name : {"a.json", "a", "a.probes.txt"})
        EXPECT_EQ(sound_import(name, kJson).groups.at(0).name, "hall") << name;
    EXPECT_EQ(import_error("a.scn", "RSRC").find("a.scn: "), 0u);
}

/// The positions of all groups of a file in tests/imports/files, sorted.
std::vector<glm::dvec3> sample_positions(const std::string& name) {
    const auto imported = import_groups(TETRALIGHT_IMPORT_FILES "/" + name);
    EXPECT_TRUE(imported) << error_text(imported.error());
    std::vector<glm::dvec3> positions;
    if (!imported) return positions;
    for (const ProbeGroup& group : imported->groups)
        positions.insert(positions.end(), group.positions.begin(), group.positions.end());
    // By values that differ by more than the error of the rotations.
    std::ranges::sort(positions, {},
                      [](const glm::dvec3& p) { return p.x + 100 * p.y + 20 * p.z; });
    return positions;
}

TEST(ImportGroups, OneSetOfProbesIsTheSameInAllFormats) {
    const std::vector<glm::dvec3> expected = {
        {0, 0.5, 0}, {8, 0.5, 0}, {1, 1.5, 1}, {0, 0.5, 8}, {0, 8.5, 0}};
    for (const char* name : {"probes.csv", "level.tscn", "level.unity"}) {
        const auto positions = sample_positions(name);
        ASSERT_EQ(positions.size(), expected.size()) << name;
        for (size_t i = 0; i < expected.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_NEAR(positions[i][axis], expected[i][axis], 1e-12) << name << " " << i;
    }
}

TEST(ImportGroups, ExtensionsAreSorted) {
    const auto extensions = group_file_extensions();
    EXPECT_TRUE(std::ranges::is_sorted(extensions));
    EXPECT_TRUE(std::ranges::binary_search(extensions, ".tscn"));
}

TEST(ImportGroups, SaysWhenASceneHasNone) {
    EXPECT_EQ(import_error("a.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{}]})"),
              "a.gltf: no node has extras.light_probe_group");
}

}  // namespace
}  // namespace tetralight
