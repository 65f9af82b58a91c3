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
