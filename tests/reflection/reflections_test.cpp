// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/reflections.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

// docs/file_format.md gives these to other programs.
static_assert(offsetof(ReflectionProbe, box_center) == 24);
static_assert(offsetof(ReflectionProbe, half_size) == 36);
static_assert(offsetof(ReflectionProbe, axes) == 48);
static_assert(offsetof(ReflectionProbe, blend_distance) == 84);
static_assert(offsetof(ReflectionProbe, importance) == 88);
static_assert(offsetof(ReflectionProbe, validity) == 92);
static_assert(offsetof(ReflectionProbe, irradiance) == 96);
static_assert(offsetof(ReflectionProbe, reserved) == 204);

TEST(Reflections, LevelsOfRoughnessAreTheInverseOfRoughnessOfLevels) {
    for (uint32_t count = 2; count <= kMaxReflectionLevels; ++count) {
        EXPECT_EQ(roughness_of_level(0, count), 0.0f);
        EXPECT_EQ(roughness_of_level(count - 1, count), 1.0f);
        for (uint32_t level = 0; level < count; ++level) {
            EXPECT_NEAR(level_of_roughness(roughness_of_level(level, count), count),
                        static_cast<float>(level), 1e-5f);
        }
    }
}

TEST(Reflections, RoughnessOutOfRangeHasTheFirstOrTheLastLevel) {
    EXPECT_EQ(level_of_roughness(-1.0f, 5), 0.0f);
    EXPECT_EQ(level_of_roughness(std::nanf(""), 5), 0.0f);
    EXPECT_EQ(level_of_roughness(7.0f, 5), 4.0f);
    EXPECT_EQ(level_of_roughness(0.5f, 1), 0.0f);
    EXPECT_EQ(level_of_roughness(0.5f, 0), 0.0f);
    EXPECT_EQ(roughness_of_level(0, 1), 0.0f);
}

TEST(Reflections, LevelsEndAtFacesOf8Texels) {
    for (uint32_t size = 8; size <= kLargestCubeSize; size *= 2) {
        const uint32_t count = reflection_level_count(size);
        EXPECT_EQ(size >> (count - 1), 8u) << size;
        EXPECT_LE(count, kMaxReflectionLevels);
    }
    EXPECT_EQ(reflection_level_count(4), 1u);
    EXPECT_EQ(reflection_level_count(0), 1u);
}

TEST(Reflections, ViewShowsWhatIsOwned) {
    const Reflections reflections = test::make_small_reflections();
    const ReflectionsView view = reflections.view();
    EXPECT_EQ(view.size, 4u);
    EXPECT_EQ(view.level_count, 2u);
    EXPECT_EQ(view.probes.data(), reflections.probes.data());
    EXPECT_EQ(view.probes.size(), 2u);
    EXPECT_EQ(view.levels[1].data(), reflections.levels[1].data());
    EXPECT_EQ(view.levels[1].size(), 2u * 6 * 2 * 2);
    EXPECT_TRUE(view.levels[2].empty());
    EXPECT_EQ(view.metadata, reflections.metadata);
}

}  // namespace
}  // namespace tetralight
