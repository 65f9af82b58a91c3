// SPDX-License-Identifier: Apache-2.0
// Reflection probes through the C API.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/reflection/reflection_file.h>
#include <tetralight/reflection/sample_reflections.h>
#include <tetralight/reflection/split_sum.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/reflection/reflection_fixture.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

class CApiReflections : public testing::Test {
  protected:
    CApiReflections() {
        EXPECT_EQ(tetralight_reflections_open(path.c_str(), &reflections, &error), TETRALIGHT_OK)
            << error.message;
        EXPECT_EQ(tetralight_reflections_blend(reflections, position, &blend, &error),
                  TETRALIGHT_OK);
    }

    ~CApiReflections() override { tetralight_reflections_close(reflections); }

    CApiReflections(const CApiReflections&) = delete;
    CApiReflections& operator=(const CApiReflections&) = delete;

    const TempFolder folder;
    const Reflections data = test::make_small_reflections();
    const std::string path = folder.write("a.ktx2", reflection_file_bytes(data));
    tetralight_reflections* reflections = nullptr;
    tetralight_reflection_blend blend{};
    tetralight_error error{};
    /// 0.2 m outside the box of probe 0, where it fades out.
    const ReflectionProbe& box = data.probes[0];
    const glm::dvec3 place =
        box.position + glm::dvec3(box.box_center) + 1.2 * glm::dvec3(box.axes[1]);
    const double position[3]{place.x, place.y, place.z};
    const float direction[3]{0.0f, 0.8f, 0.6f};
    float rgb[3]{-7.0f, -7.0f, -7.0f};
};

TEST_F(CApiReflections, HaveWhatTheFileHas) {
    tetralight_reflections_info info{};
    ASSERT_EQ(tetralight_reflections_get_info(reflections, &info, &error), TETRALIGHT_OK);
    EXPECT_EQ(info.size, 4u);
    EXPECT_EQ(info.level_count, 2u);
    EXPECT_EQ(info.probe_count, 2u);
    tetralight_reflection_probe probe{};
    ASSERT_EQ(tetralight_reflections_get_probe(reflections, 0, &probe, &error), TETRALIGHT_OK);
    const ReflectionProbe& expected = data.probes[0];
    EXPECT_EQ(probe.position[2], 1e6);
    EXPECT_EQ(probe.box_center[1], expected.box_center.y);
    EXPECT_EQ(probe.half_size[2], 3.5f);
    EXPECT_EQ(probe.axes[5], expected.axes[1].z);
    EXPECT_EQ(probe.blend_distance, 0.5f);
    EXPECT_EQ(probe.importance, 7);
    EXPECT_EQ(probe.validity, 0.75f);
    ASSERT_EQ(tetralight_reflections_get_probe(reflections, 1, &probe, nullptr), TETRALIGHT_OK);
    EXPECT_TRUE(std::isinf(probe.half_size[0]));
}

TEST_F(CApiReflections, OpenFromMemory) {
    std::vector<std::byte> bytes = reflection_file_bytes(data);
    tetralight_reflections* other = nullptr;
    ASSERT_EQ(tetralight_reflections_open_memory(bytes.data(), bytes.size(), &other, &error),
              TETRALIGHT_OK)
        << error.message;
    bytes.assign(bytes.size(), std::byte{0xff});
    tetralight_const_array texels{};
    ASSERT_EQ(tetralight_reflections_texels(other, 0, &texels, &error), TETRALIGHT_OK);
    ASSERT_EQ(texels.size, data.levels[0].size() * 8);
    EXPECT_EQ(std::memcmp(texels.data, data.levels[0].data(), texels.size), 0);
    tetralight_reflections_close(other);
    other = nullptr;
    EXPECT_EQ(tetralight_reflections_open_memory(bytes.data(), bytes.size(), &other, &error),
              TETRALIGHT_CORRUPT);
    EXPECT_EQ(other, nullptr);
    EXPECT_EQ(tetralight_reflections_open_memory(nullptr, 1, &other, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_reflections_open_memory(bytes.data(), 1, nullptr, &error),
              TETRALIGHT_BAD_POINTER);
}

TEST_F(CApiReflections, GiveTheTexelsOfALevel) {
    tetralight_const_array texels{};
    ASSERT_EQ(tetralight_reflections_texels(reflections, 1, &texels, &error), TETRALIGHT_OK);
    ASSERT_EQ(texels.size, data.levels[1].size() * 8);
    EXPECT_EQ(texels.stride, 8u);
    EXPECT_EQ(std::memcmp(texels.data, data.levels[1].data(), texels.size), 0);
}

TEST_F(CApiReflections, SampleWhatTheLibrarySamples) {
    const ReflectionBlend expected = blend_reflections(data.view(), place);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(blend.probes[i], expected.probes[i]);
        EXPECT_EQ(blend.weights[i], expected.weights[i]);
    }
    EXPECT_GT(blend.weights[1], 0.0f);  // of two probes
    ASSERT_EQ(
        tetralight_reflections_sample(reflections, &blend, position, direction, 0.3f, rgb, &error),
        TETRALIGHT_OK);
    EXPECT_EQ(glm::vec3(rgb[0], rgb[1], rgb[2]),
              sample_reflections(data.view(), expected, place, {0.0f, 0.8f, 0.6f}, 0.3f));
}

TEST_F(CApiReflections, OcclusionIsThatOfTheLibrary) {
    tetralight_reflection_blend all_box{};
    all_box.weights[0] = 1.0f;
    const glm::vec3 normal(0.0f, 0.8f, 0.6f);
    const glm::vec3 of_cube = evaluate_irradiance(data.probes[0].irradiance, normal);
    const float half[3]{0.5f * of_cube.x, 0.5f * of_cube.y, 0.5f * of_cube.z};
    float occlusion = -7.0f;
    ASSERT_EQ(tetralight_reflections_occlusion(reflections, &all_box, direction, half, 0.4f,
                                               &occlusion, &error),
              TETRALIGHT_OK);
    EXPECT_EQ(occlusion, reflection_occlusion({half[0], half[1], half[2]}, of_cube, 0.4f));
}

TEST_F(CApiReflections, SplitSumIsThatOfTheLibrary) {
    float sum[2]{};
    ASSERT_EQ(tetralight_split_sum(0.25f, 0.5f, 64, sum, &error), TETRALIGHT_OK);
    EXPECT_EQ(glm::vec2(sum[0], sum[1]), integrate_split_sum(0.25f, 0.5f, 64));
    EXPECT_EQ(tetralight_split_sum(0.25f, 0.5f, 0, sum, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_split_sum(1.25f, 0.5f, 64, sum, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_split_sum(0.25f, std::nanf(""), 64, sum, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_split_sum(0.25f, 0.5f, 64, nullptr, &error), TETRALIGHT_BAD_POINTER);
}

TEST_F(CApiReflections, WrongArgumentsAreErrorsAndWriteNothing) {
    const float nan[3]{std::nanf(""), 0.0f, 0.0f};
    const double far[3]{0.0, HUGE_VAL, 0.0};
    const auto sample = [&](const tetralight_reflection_blend* of, const double* at,
                            const float* along, float roughness) {
        return tetralight_reflections_sample(reflections, of, at, along, roughness, rgb, &error);
    };
    EXPECT_EQ(sample(nullptr, position, direction, 0.0f), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(sample(&blend, nullptr, direction, 0.0f), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(sample(&blend, far, direction, 0.0f), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(sample(&blend, position, nan, 0.0f), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(sample(&blend, position, direction, 1.5f), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(sample(&blend, position, direction, nan[0]), TETRALIGHT_BAD_VALUE);
    blend.weights[2] = nan[0];
    EXPECT_EQ(sample(&blend, position, direction, 0.0f), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(rgb[0], -7.0f);
    blend = {{7, 8, UINT32_MAX}, {0.5f, 0.25f, 0.25f}};  // probes that are not there are black
    EXPECT_EQ(sample(&blend, position, direction, 0.0f), TETRALIGHT_OK);
    EXPECT_EQ(rgb[0], 0.0f);
}

TEST_F(CApiReflections, WhatIsNotThereHasAStatusOfItsOwn) {
    tetralight_reflection_probe probe{};
    tetralight_const_array texels{};
    EXPECT_EQ(tetralight_reflections_get_probe(reflections, 2, &probe, &error),
              TETRALIGHT_NOT_THERE);
    EXPECT_EQ(tetralight_reflections_texels(reflections, 2, &texels, &error), TETRALIGHT_NOT_THERE);
    EXPECT_EQ(texels.data, nullptr);
    EXPECT_GT(std::strlen(error.message), 5u);
}

TEST_F(CApiReflections, NullPointersAreErrors) {
    tetralight_reflections* none = nullptr;
    float occlusion = 0.0f;
    const auto bad = TETRALIGHT_BAD_POINTER;
    EXPECT_EQ(tetralight_reflections_open(nullptr, &none, &error), bad);
    EXPECT_EQ(tetralight_reflections_open(path.c_str(), nullptr, &error), bad);
    EXPECT_EQ(tetralight_reflections_get_info(reflections, nullptr, &error), bad);
    EXPECT_EQ(tetralight_reflections_get_info(nullptr, nullptr, &error), bad);
    EXPECT_EQ(tetralight_reflections_get_probe(reflections, 0, nullptr, &error), bad);
    EXPECT_EQ(tetralight_reflections_texels(reflections, 0, nullptr, &error), bad);
    EXPECT_EQ(tetralight_reflections_blend(nullptr, position, &blend, &error), bad);
    EXPECT_EQ(tetralight_reflections_blend(reflections, position, nullptr, &error), bad);
    EXPECT_EQ(tetralight_reflections_occlusion(reflections, &blend, nullptr, direction, 1.0f,
                                               &occlusion, &error),
              bad);
    EXPECT_EQ(tetralight_reflections_occlusion(reflections, &blend, direction, direction, 1.0f,
                                               nullptr, nullptr),
              bad);
    tetralight_reflections_close(nullptr);
}

TEST_F(CApiReflections, FilesThatCannotBeOpenedHaveAStatusOfTheirOwn) {
    tetralight_reflections* none = nullptr;
    const std::string missing = folder.path("none.ktx2");
    EXPECT_EQ(tetralight_reflections_open(missing.c_str(), &none, &error), TETRALIGHT_BAD_FILE);
    auto bytes = reflection_file_bytes(data);
    bytes.pop_back();
    const std::string corrupt = folder.write("corrupt.ktx2", bytes);
    EXPECT_EQ(tetralight_reflections_open(corrupt.c_str(), &none, &error), TETRALIGHT_CORRUPT);
    bytes[12] = std::byte{109};  // a texture of floats
    const std::string other = folder.write("other.ktx2", bytes);
    EXPECT_EQ(tetralight_reflections_open(other.c_str(), &none, &error), TETRALIGHT_UNSUPPORTED);
    EXPECT_EQ(none, nullptr);
}

}  // namespace
}  // namespace tetralight
