// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_uri.h>

#include <gtest/gtest.h>

#include <filesystem>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include "tests/support/temp_folder.h"

namespace tetralight::detail {
namespace {

namespace fs = std::filesystem;

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

/// A folder "scene" with files, and a folder "other" beside it.
class GltfUriLinks : public testing::Test {
  protected:
    GltfUriLinks() {
        for (const char* name : {"scene/inner", "other"}) fs::create_directories(path(name));
        for (const char* name : {"scene/a.gltf", "scene/inner/a.bin", "other/b.bin"})
            folder_.write(name, "x");
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }

    void link(const std::string& target, const std::string& name) const {
        fs::create_symlink(path(target), path(name));
    }

    TempFolder folder_;
};

TEST_F(GltfUriLinks, PathsAreJoinedWithTheFolder) {
    EXPECT_EQ(*path_from_uri("inner/a%2ebin", path("scene/a.gltf")), path("scene/inner/a.bin"));
    EXPECT_EQ(*path_from_uri("missing.bin", path("scene/a.gltf")), path("scene/missing.bin"));
    EXPECT_EQ(*path_from_uri("missing.bin", "a.gltf"), "missing.bin");
    EXPECT_EQ(path_from_uri("../a.bin", "a.gltf").error().code, ErrorCode::Unsupported);
}

TEST_F(GltfUriLinks, LinksThatStayInTheFolderAreFollowed) {
    link("scene/inner/a.bin", "scene/link.bin");
    EXPECT_TRUE(path_from_uri("link.bin", path("scene/a.gltf")));
    // However the folder is reached.
    link("scene", "alias");
    EXPECT_TRUE(path_from_uri("link.bin", path("alias/a.gltf")));
}

TEST_F(GltfUriLinks, LinksThatLeaveTheFolderAreRefused) {
    link("other/b.bin", "scene/link.bin");
    link("other", "scene/folder");
    for (const char* uri : {"link.bin", "folder/b.bin"}) {
        const auto result = path_from_uri(uri, path("scene/a.gltf"));
        ASSERT_FALSE(result) << uri;
        EXPECT_EQ(result.error().code, ErrorCode::Unsupported);
        EXPECT_EQ(error_text(result.error()),
                  str_cat("uri \"", uri,
                          "\" is a symbolic link to a file outside of the scene's folder"));
    }
}

TEST_F(GltfUriLinks, AFolderOfLinksReadsWhatLiesBesideTheSceneItLinksTo) {
    fs::create_directories(path("links"));
    link("scene/a.gltf", "links/a.gltf");
    link("scene/inner/a.bin", "links/a.bin");
    link("other/b.bin", "links/b.bin");
    EXPECT_TRUE(path_from_uri("a.bin", path("links/a.gltf")));
    EXPECT_FALSE(path_from_uri("b.bin", path("links/a.gltf")));
}

}  // namespace
}  // namespace tetralight::detail
