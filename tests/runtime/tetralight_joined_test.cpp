// SPDX-License-Identifier: Apache-2.0
// Volumes that join and leave through the C API.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include <tetralight/probes/probe_file.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/support/random_probes.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

class CApiJoined : public testing::Test {
  protected:
    CApiJoined() {
        EXPECT_EQ(tetralight_joined_create(&joined, &error), TETRALIGHT_OK) << error.message;
        hall = open(0.0, 1);
        yard = open(1.5, 2);
    }

    ~CApiJoined() override {
        tetralight_joined_destroy(joined);
        tetralight_close(hall);
        tetralight_close(yard);
    }

    CApiJoined(const CApiJoined&) = delete;
    CApiJoined& operator=(const CApiJoined&) = delete;

    tetralight_volume* open(double x, uint64_t seed) {
        auto positions = test::random_positions(200, seed);
        for (glm::dvec3& p : positions) p.x += x;
        const ProbeVolume volume = test::make_lit_volume(std::move(positions));
        const std::string path = folder.path(std::to_string(seed) + ".probes");
        EXPECT_TRUE(write_probe_file(path, volume.view()));
        tetralight_volume* opened = nullptr;
        EXPECT_EQ(tetralight_open(path.c_str(), &opened, &error), TETRALIGHT_OK) << error.message;
        return opened;
    }

    /// Steps to the end.
    void finish() {
        for (uint32_t is_ready = 0; is_ready == 0;) {
            ASSERT_EQ(tetralight_joined_step(joined, 100, &is_ready, &error), TETRALIGHT_OK)
                << error.message;
        }
        ASSERT_EQ(tetralight_joined_commit(joined, &error), TETRALIGHT_OK);
    }

    [[nodiscard]] uint32_t cell_count() {
        tetralight_info info{};
        EXPECT_EQ(tetralight_get_info(tetralight_joined_volume(joined), &info, &error),
                  TETRALIGHT_OK);
        return info.inner_cell_count;
    }

    tetralight_light light_at(float x) {
        const float position[3]{x, 0.5f, 0.5f};
        tetralight_light light{};
        EXPECT_EQ(
            tetralight_query(tetralight_joined_volume(joined), position, nullptr, &light, &error),
            TETRALIGHT_OK);
        return light;
    }

    const TempFolder folder;
    tetralight_error error{};
    tetralight_joined* joined = nullptr;
    tetralight_volume* hall = nullptr;
    tetralight_volume* yard = nullptr;
};

TEST_F(CApiJoined, LightsWithAllThatJoinedAndHaveNotLeft) {
    const tetralight_volume* volume = tetralight_joined_volume(joined);
    ASSERT_EQ(tetralight_joined_add(joined, "hall", hall, &error), TETRALIGHT_OK);
    EXPECT_EQ(cell_count(), 0u);
    finish();
    const uint32_t alone = cell_count();
    EXPECT_GT(alone, 500u);
    const tetralight_light before = light_at(0.9f);
    ASSERT_EQ(tetralight_joined_add(joined, "yard", yard, &error), TETRALIGHT_OK);
    finish();
    EXPECT_EQ(tetralight_joined_volume(joined), volume);
    EXPECT_GT(cell_count(), 2 * alone);
    ASSERT_EQ(tetralight_joined_remove(joined, "yard", &error), TETRALIGHT_OK);
    finish();
    EXPECT_EQ(cell_count(), alone);
    const tetralight_light after = light_at(0.9f);
    for (size_t i = 0; i < std::size(before.packed); ++i) {
        EXPECT_NEAR(after.packed[i], before.packed[i], 1e-5f);
    }
    EXPECT_EQ(tetralight_verify(volume, &error), TETRALIGHT_OK);
}

TEST_F(CApiJoined, IsNotSaved) {
    ASSERT_EQ(tetralight_joined_add(joined, "hall", hall, &error), TETRALIGHT_OK);
    finish();
    const std::string path = folder.write("old.probes", "old");
    EXPECT_EQ(tetralight_save(tetralight_joined_volume(joined), path.c_str(), &error),
              TETRALIGHT_UNSUPPORTED);
    EXPECT_STREQ(error.message, "joined volumes cannot be saved as one");
    EXPECT_EQ(std::filesystem::file_size(path), 3u);
    EXPECT_EQ(tetralight_save(hall, path.c_str(), &error), TETRALIGHT_OK) << error.message;
}

TEST_F(CApiJoined, SaysWhatIsWrong) {
    uint32_t is_ready = 7;
    EXPECT_EQ(tetralight_joined_create(nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_joined_add(nullptr, "a", hall, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_joined_add(joined, nullptr, hall, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_joined_add(joined, "a", nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_joined_remove(joined, "a", &error), TETRALIGHT_NOT_THERE);
    EXPECT_STREQ(error.message, "volume \"a\": there is no such volume");
    EXPECT_EQ(tetralight_joined_step(joined, 10, nullptr, &error), TETRALIGHT_BAD_POINTER);
    ASSERT_EQ(tetralight_joined_add(joined, "a", hall, &error), TETRALIGHT_OK);
    EXPECT_EQ(tetralight_joined_add(joined, "a", yard, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "volume \"a\": there is one of this name");
    EXPECT_EQ(tetralight_joined_add(joined, "self", tetralight_joined_volume(joined), &error),
              TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_joined_commit(nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_joined_volume(nullptr), nullptr);
    EXPECT_EQ(tetralight_joined_step(joined, 0, &is_ready, nullptr), TETRALIGHT_OK);
    tetralight_joined_destroy(nullptr);
}

}  // namespace
}  // namespace tetralight
