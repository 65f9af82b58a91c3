// SPDX-License-Identifier: Apache-2.0
// The text of the C API's header: versions and exported functions.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include <tetralight/runtime/tetralight.h>

namespace {

TEST(CHeader, VersionIsTheProjects) {
    const std::string version = TETRALIGHT_PROJECT_VERSION;
    EXPECT_EQ(tetralight_version_string(), version);
    int major = -1, minor = -1, patch = -1;
    ASSERT_EQ(std::sscanf(version.c_str(), "%d.%d.%d", &major, &minor, &patch), 3);
    EXPECT_EQ(TETRALIGHT_VERSION_MAJOR, major);
    EXPECT_EQ(TETRALIGHT_VERSION_MINOR, minor);
    EXPECT_EQ(TETRALIGHT_VERSION_PATCH, patch);
    EXPECT_EQ(tetralight_version(), static_cast<uint32_t>(10000 * major + 100 * minor + patch));
}

TEST(CHeader, EveryFunctionIsMarkedForExport) {
    std::ifstream file(TETRALIGHT_SOURCE_DIR "/runtime/tetralight.h");
    const std::string header = (std::ostringstream() << file.rdbuf()).str();
    const std::regex declaration(
        R"((TETRALIGHT_API\s+)?(?:tetralight_status|void|uint32_t|const char\*|const tetralight_volume\*)\s+(tetralight_\w+)\()");
    size_t function_count = 0;
    for (std::sregex_iterator match(header.begin(), header.end(), declaration), end; match != end;
         ++match) {
        ++function_count;
        EXPECT_TRUE((*match)[1].matched) << (*match)[2];
    }
    EXPECT_EQ(function_count, 52u);
}

}  // namespace
