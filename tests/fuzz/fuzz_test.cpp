// SPDX-License-Identifier: Apache-2.0
// The corpus, and a fixed number of cases of each target; `./run fuzz NAME SECONDS` runs more.
#include <gtest/gtest.h>

#include <filesystem>

#include <tetralight/bake/image/read_image.h>
#include "tests/fuzz/sound_scene.h"
#include "tests/fuzz/targets.h"

namespace tetralight::fuzz {
namespace {

class Fuzz : public testing::TestWithParam<Target> {};

INSTANTIATE_TEST_SUITE_P(All, Fuzz, testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(Fuzz, FindsNothing) {
    constexpr uint64_t kCaseCount = 3000;
    for (uint64_t seed = 1; seed <= kCaseCount; ++seed) {
        ASSERT_EQ(GetParam().run(seed), "") << "seed " << seed;
    }
}

TEST_P(Fuzz, TakesNothingOfTheCorpusWronglyAgain) {
    const std::string folder = TETRALIGHT_FUZZ_CORPUS "/" + std::string(GetParam().name);
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        EXPECT_EQ(GetParam().replay(entry.path().string()), "") << entry.path();
        ++count;
    }
    EXPECT_GT(count, 0u);
}

TEST(FuzzSeeds, TheSceneIsReadWhole) {
    const auto scene = sound_scene().read({.normal_maps = NormalMaps::Read});
    ASSERT_TRUE(scene) << error_text(scene.error());
    // Those of metals and of specular-glossiness are made of the images that their materials use.
    EXPECT_EQ(scene->textures.size(), 5u);
    EXPECT_EQ(scene->normal_maps.size(), 1u);
    EXPECT_EQ(scene->probe_groups.size(), 1u);
    EXPECT_EQ(scene->lights.size(), 5u);
    EXPECT_FALSE(scene->environment.image.pixels.empty());
}

TEST(FuzzSeeds, ImagesAreDecoded) {
    size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TETRALIGHT_FUZZ_SEEDS "/images")) {
        const std::string path = entry.path().string();
        const bool is_decoded = entry.path().extension() == ".exr"
                                    ? static_cast<bool>(read_hdr_image(path))
                                    : static_cast<bool>(decode_image8(*read_file(path), path));
        EXPECT_TRUE(is_decoded) << path;
        ++count;
    }
    EXPECT_GT(count, 10u);
}

}  // namespace
}  // namespace tetralight::fuzz
