// SPDX-License-Identifier: Apache-2.0
// Lightmaps through the C API.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/lightmap/lightmap_fixture.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

class CApiLightmaps : public testing::Test {
  protected:
    CApiLightmaps() {
        EXPECT_EQ(tetralight_lightmaps_open(path.c_str(), &lightmaps, &error), TETRALIGHT_OK)
            << error.message;
    }

    ~CApiLightmaps() override { tetralight_lightmaps_close(lightmaps); }

    CApiLightmaps(const CApiLightmaps&) = delete;
    CApiLightmaps& operator=(const CApiLightmaps&) = delete;

    const TempFolder folder;
    const Lightmaps data = test::make_full_lightmaps();
    const std::string path = folder.write("test.lightmaps", lightmap_file_bytes(data.view()));
    tetralight_lightmaps* lightmaps = nullptr;
    tetralight_error error{};
    const float uv[2]{0.3f, 0.6f};
    const float base[3]{0.0f, 1.0f, 0.0f};
    const float normal[3]{0.0f, 0.8f, 0.6f};
    float rgb[3]{-7.0f, -7.0f, -7.0f};
};

TEST_F(CApiLightmaps, HasWhatTheFileHas) {
    tetralight_lightmaps_info info{};
    ASSERT_EQ(tetralight_lightmaps_get_info(lightmaps, &info, &error), TETRALIGHT_OK);
    EXPECT_EQ(info.page_size, 4u);
    EXPECT_EQ(info.page_count, 2u);
    EXPECT_EQ(info.instance_count, 3u);
    EXPECT_EQ(info.has_light, 1u);
    EXPECT_EQ(info.scale, data.info.scale);
    EXPECT_EQ(info.mixed_lighting, 1u);
    EXPECT_EQ(info.has_ambient_occlusion, 1u);
}

TEST_F(CApiLightmaps, HaveTheArraysOfTheFile) {
    tetralight_const_array array{};
    const auto expect_array = [&](uint32_t which, const auto& expected) {
        ASSERT_EQ(tetralight_lightmaps_get_array(lightmaps, which, &array, &error), TETRALIGHT_OK)
            << error.message;
        ASSERT_EQ(array.size, expected.size() * sizeof expected[0]) << which;
        EXPECT_EQ(array.stride, sizeof expected[0]) << which;
        EXPECT_EQ(std::memcmp(array.data, expected.data(), array.size), 0) << which;
    };
    expect_array(TETRALIGHT_LIGHTMAP_IRRADIANCE, data.irradiance);
    expect_array(TETRALIGHT_LIGHTMAP_LIGHT, data.light);
    expect_array(TETRALIGHT_LIGHTMAP_VALIDITY, data.validity);
    expect_array(TETRALIGHT_LIGHTMAP_STANDARD_ERROR, data.error);
    expect_array(TETRALIGHT_LIGHTMAP_SHADOW_MASK, data.shadow_mask);
    expect_array(TETRALIGHT_LIGHTMAP_AMBIENT_OCCLUSION, data.ambient_occlusion);
    expect_array(TETRALIGHT_LIGHTMAP_INSTANCE_NAMES, data.instance_names);
    expect_array(TETRALIGHT_LIGHTMAP_METADATA, data.metadata);
}

TEST_F(CApiLightmaps, AnArrayThatIsMissingIsAnError) {
    Lightmaps bare = data;
    bare.ambient_occlusion.clear();
    bare.info.ambient_occlusion_distance = 0.0f;
    const auto bytes = lightmap_file_bytes(bare.view());
    tetralight_lightmaps* other = nullptr;
    ASSERT_EQ(tetralight_lightmaps_open_memory(bytes.data(), bytes.size(), &other, &error),
              TETRALIGHT_OK)
        << error.message;
    tetralight_const_array array{&error, 1, 2};
    EXPECT_EQ(tetralight_lightmaps_get_array(other, TETRALIGHT_LIGHTMAP_AMBIENT_OCCLUSION, &array,
                                             &error),
              TETRALIGHT_NOT_THERE);
    EXPECT_EQ(array.data, &error);
    EXPECT_EQ(tetralight_lightmaps_get_array(other, 8, &array, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_lightmaps_get_array(other, 0, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_get_array(nullptr, 0, &array, &error), TETRALIGHT_BAD_POINTER);
    tetralight_lightmaps_close(other);
}

TEST_F(CApiLightmaps, OpenFromMemory) {
    std::vector<std::byte> bytes = lightmap_file_bytes(data.view());
    tetralight_lightmaps* other = nullptr;
    ASSERT_EQ(tetralight_lightmaps_open_memory(bytes.data(), bytes.size(), &other, &error),
              TETRALIGHT_OK)
        << error.message;
    bytes.assign(bytes.size(), std::byte{0xff});
    ASSERT_EQ(tetralight_lightmaps_sample(other, 1, uv, nullptr, nullptr, rgb, &error),
              TETRALIGHT_OK);
    EXPECT_EQ(glm::vec3(rgb[0], rgb[1], rgb[2]), sample_irradiance(data.view(), 1, {uv[0], uv[1]}));
    tetralight_lightmaps_close(other);
    other = nullptr;
    EXPECT_EQ(tetralight_lightmaps_open_memory(bytes.data(), bytes.size(), &other, &error),
              TETRALIGHT_CORRUPT);
    EXPECT_EQ(other, nullptr);
    EXPECT_EQ(tetralight_lightmaps_open_memory(nullptr, 1, &other, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_open_memory(bytes.data(), 1, nullptr, &error),
              TETRALIGHT_BAD_POINTER);
}

TEST_F(CApiLightmaps, SamplesTheShadowMaskAndAmbientOcclusion) {
    float visible[4]{-7.0f, -7.0f, -7.0f, -7.0f};
    float open = -7.0f;
    ASSERT_EQ(tetralight_lightmaps_shadow_mask(lightmaps, 1, uv, visible, &error), TETRALIGHT_OK);
    const glm::vec4 expected = sample_shadow_mask(data.view(), 1, {0.3f, 0.6f});
    for (int i = 0; i < 4; ++i) EXPECT_EQ(visible[i], expected[i]);
    ASSERT_EQ(tetralight_lightmaps_ambient_occlusion(lightmaps, 1, uv, &open, nullptr),
              TETRALIGHT_OK);
    EXPECT_EQ(open, sample_ambient_occlusion(data.view(), 1, {0.3f, 0.6f}));
    EXPECT_EQ(tetralight_lightmaps_shadow_mask(lightmaps, 2, uv, visible, &error),
              TETRALIGHT_NOT_THERE);
    EXPECT_EQ(tetralight_lightmaps_ambient_occlusion(lightmaps, 2, uv, &open, &error),
              TETRALIGHT_NOT_THERE);
    EXPECT_EQ(tetralight_lightmaps_shadow_mask(lightmaps, 1, uv, nullptr, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_ambient_occlusion(lightmaps, 1, nullptr, &open, &error),
              TETRALIGHT_BAD_POINTER);
}

TEST_F(CApiLightmaps, KnowsThePlacesOfInstances) {
    tetralight_lightmap_place place{};
    ASSERT_EQ(tetralight_lightmaps_rectangle(lightmaps, 1, &place, &error), TETRALIGHT_OK);
    EXPECT_EQ(place.page, 1u);
    EXPECT_EQ(place.scale[0], 0.75f);
    EXPECT_EQ(place.offset[1], 0.25f);
    ASSERT_EQ(tetralight_lightmaps_rectangle(lightmaps, 2, &place, nullptr), TETRALIGHT_OK);
    EXPECT_EQ(place.page, TETRALIGHT_NO_PAGE);
    EXPECT_EQ(tetralight_lightmaps_rectangle(lightmaps, 3, &place, &error), TETRALIGHT_NOT_THERE);
    EXPECT_GT(std::strlen(error.message), 5u);
}

TEST_F(CApiLightmaps, SamplesWhatTheLibrarySamples) {
    ASSERT_EQ(tetralight_lightmaps_sample(lightmaps, 1, uv, nullptr, nullptr, rgb, &error),
              TETRALIGHT_OK);
    EXPECT_EQ(glm::vec3(rgb[0], rgb[1], rgb[2]), sample_irradiance(data.view(), 1, {uv[0], uv[1]}));
    ASSERT_EQ(tetralight_lightmaps_sample(lightmaps, 1, uv, base, normal, rgb, &error),
              TETRALIGHT_OK);
    EXPECT_EQ(
        glm::vec3(rgb[0], rgb[1], rgb[2]),
        sample_lightmap(data.view(), 1, {uv[0], uv[1]}, {{0.0f, 1.0f, 0.0f}, {0.0f, 0.8f, 0.6f}}));
}

TEST_F(CApiLightmaps, WrongArgumentsAreErrorsAndWriteNothing) {
    const float nan[3]{std::nanf(""), 0.0f, 0.0f};
    const auto sample = [&](const float* at, const float* on, uint32_t page) {
        return tetralight_lightmaps_sample(lightmaps, page, at, base, on, rgb, &error);
    };
    EXPECT_EQ(sample(nullptr, normal, 0), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(sample(nan, normal, 0), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(sample(uv, nan, 0), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(sample(uv, normal, 2), TETRALIGHT_NOT_THERE);
    EXPECT_EQ(sample(uv, normal, TETRALIGHT_NO_PAGE), TETRALIGHT_NOT_THERE);
    EXPECT_EQ(tetralight_lightmaps_sample(nullptr, 0, uv, base, normal, rgb, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_sample(lightmaps, 0, uv, base, normal, nullptr, nullptr),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_sample(lightmaps, 0, uv, nullptr, normal, rgb, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_sample(lightmaps, 0, uv, nan, normal, rgb, &error),
              TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(rgb[0], -7.0f);
}

TEST_F(CApiLightmaps, NullPointersAreErrors) {
    tetralight_lightmaps* none = nullptr;
    tetralight_lightmaps_info info;
    tetralight_lightmap_place place;
    EXPECT_EQ(tetralight_lightmaps_open(nullptr, &none, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_open(path.c_str(), nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_get_info(nullptr, &info, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_get_info(lightmaps, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_rectangle(nullptr, 0, &place, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_lightmaps_rectangle(lightmaps, 0, nullptr, &error),
              TETRALIGHT_BAD_POINTER);
    tetralight_lightmaps_close(nullptr);
}

TEST_F(CApiLightmaps, FilesThatCannotBeOpenedHaveAStatusOfTheirOwn) {
    tetralight_lightmaps* none = nullptr;
    const std::string missing = folder.path("none.lightmaps");
    EXPECT_EQ(tetralight_lightmaps_open(missing.c_str(), &none, &error), TETRALIGHT_BAD_FILE);
    auto bytes = lightmap_file_bytes(data.view());
    bytes.back() ^= std::byte{1};
    const std::string corrupt = folder.write("corrupt.lightmaps", bytes);
    EXPECT_EQ(tetralight_lightmaps_open(corrupt.c_str(), &none, &error), TETRALIGHT_CORRUPT);
    EXPECT_EQ(none, nullptr);
}

}  // namespace
}  // namespace tetralight
