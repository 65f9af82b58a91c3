// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_uri.h>

#include <gtest/gtest.h>

namespace tetralight::detail {
namespace {

TEST(GltfUri, DecodesPercentEscapesOnly) {
    EXPECT_EQ(*relative_path_from_uri("a%20b/c+d%2epng"), "a b/c+d.png");
    EXPECT_EQ(*relative_path_from_uri("100%"), "100%");
    EXPECT_EQ(*relative_path_from_uri("%zz%4"), "%zz%4");
}

TEST(GltfUri, AllowsNamesWithDots) {
    EXPECT_TRUE(relative_path_from_uri("..a/b..c/..."));
}

TEST(GltfUri, RejectsWhatLeadsOutOfTheFolder) {
    for (const char* uri :
         {"", "/etc/passwd", "../a.bin", "a/../../b.bin", "a/..", "%2e%2e/a", "%2Fetc/passwd",
          "file:///etc/passwd", "http://host/a", "..\\a.bin", "c:a.bin", "a%00.png"}) {
        EXPECT_FALSE(relative_path_from_uri(uri)) << uri;
    }
}

TEST(GltfUri, FolderEndsInASlash) {
    EXPECT_EQ(folder_of("a/b/c.glb"), "a/b/");
    EXPECT_EQ(folder_of("c.glb"), "");
}

}  // namespace
}  // namespace tetralight::detail
