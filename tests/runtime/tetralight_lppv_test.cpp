// SPDX-License-Identifier: Apache-2.0
// Proxy volumes through the C API.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/lppv/lppv_texture.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/lppv/lppv_fixture.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

tetralight_lppv_box make_box() {
    tetralight_lppv_box box{};
    for (int i = 0; i < 4; ++i) box.world_from_box[5 * i] = 1.0f;
    for (float& x : box.low) x = -2.0f;
    for (float& x : box.high) x = 2.0f;
    box.resolution[0] = 4;
    box.resolution[1] = 3;
    box.resolution[2] = 2;
    box.quality = TETRALIGHT_LPPV_FULL;
    box.layout = TETRALIGHT_LPPV_SEVEN_SLABS;
    box.format = TETRALIGHT_LPPV_FLOAT;
    return box;
}

constexpr size_t kTexels = 4 * 7 * 3 * 2;

class CApiLppv : public testing::Test {
  protected:
    CApiLppv() {
        const std::string path = folder.write("test.probes", probe_file_bytes(data.view()));
        EXPECT_EQ(tetralight_open(path.c_str(), &volume, &error), TETRALIGHT_OK) << error.message;
    }

    ~CApiLppv() override { tetralight_close(volume); }

    CApiLppv(const CApiLppv&) = delete;
    CApiLppv& operator=(const CApiLppv&) = delete;

    TempFolder folder;
    ProbeVolume data = test::make_cube_volume();
    tetralight_volume* volume = nullptr;
    tetralight_error error{};
    tetralight_lppv_box box = make_box();
    std::vector<float> texels = std::vector<float>(4 * kTexels, -7.0f);
    tetralight_array array{texels.data(), texels.size() * 4, 0};
    tetralight_lppv_constants constants{};
};

TEST_F(CApiLppv, FillsWhatTheLibraryFills) {
    tetralight_lppv_size size{};
    ASSERT_EQ(tetralight_get_lppv_size(&box, &size, &error), TETRALIGHT_OK) << error.message;
    EXPECT_EQ(size.texels[0], 28u);
    EXPECT_EQ(size.bytes, array.size);
    ASSERT_EQ(tetralight_fill_lppv(volume, &box, &array, &constants, &error), TETRALIGHT_OK)
        << error.message;
    LppvTexture texture{LppvLayout::SevenSlabs, LppvTexelFormat::Float, {28, 3, 2}, {}};
    const auto bytes = std::as_bytes(std::span(texels));
    texture.texels.assign(bytes.begin(), bytes.end());
    LppvConstants shader;
    std::memcpy(static_cast<void*>(&shader), &constants, sizeof shader);
    // Light is linear in the position here, so that a grid reproduces it.
    const glm::vec3 at(0.3f, -1.1f, 0.7f);
    const PackedSh expected = pack_sh(interpolate(data.view(), locate(data.view(), at)).irradiance);
    const PackedSh sampled = sample_lppv_texture(texture, shader, at);
    EXPECT_LE(glm::distance(sampled.sha_r, expected.sha_r), 1e-4f);
    EXPECT_LE(glm::distance(sampled.shc, expected.shc), 1e-4f);
}

TEST_F(CApiLppv, HalvesOfFourSlabsAreSmaller) {
    box.layout = TETRALIGHT_LPPV_FOUR_SLABS;
    box.format = TETRALIGHT_LPPV_HALF;
    box.quality = TETRALIGHT_LPPV_NORMAL;
    tetralight_lppv_size size{};
    ASSERT_EQ(tetralight_get_lppv_size(&box, &size, &error), TETRALIGHT_OK);
    EXPECT_EQ(size.texels[0], 16u);
    EXPECT_EQ(size.bytes, 4u * 3 * 2 * 4 * 8);
    EXPECT_EQ(tetralight_fill_lppv(volume, &box, &array, &constants, &error), TETRALIGHT_OK);
    EXPECT_EQ(texels[size.bytes / 4], -7.0f) << "written beyond the texture";
}

TEST_F(CApiLppv, NullPointersAreErrors) {
    tetralight_lppv_size size;
    EXPECT_EQ(tetralight_get_lppv_size(nullptr, &size, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_lppv_size(&box, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_fill_lppv(nullptr, &box, &array, &constants, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_fill_lppv(volume, nullptr, &array, &constants, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_fill_lppv(volume, &box, nullptr, &constants, &error),
              TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_fill_lppv(volume, &box, &array, nullptr, nullptr), TETRALIGHT_BAD_POINTER);
    array.data = nullptr;
    EXPECT_EQ(tetralight_fill_lppv(volume, &box, &array, &constants, &error),
              TETRALIGHT_BAD_POINTER);
}

TEST_F(CApiLppv, BoxesAndBuffersThatMakeNoSenseAreErrors) {
    array.size -= 1;
    EXPECT_EQ(tetralight_fill_lppv(volume, &box, &array, &constants, &error),
              TETRALIGHT_SHORT_BUFFER);
    array.size += 1;
    const tetralight_lppv_box good = box;
    const auto expect_bad = [&] {
        EXPECT_EQ(tetralight_fill_lppv(volume, &box, &array, &constants, &error),
                  TETRALIGHT_BAD_VALUE);
        EXPECT_GT(std::strlen(error.message), 5u);
        box = good;
    };
    box.layout = 9;
    expect_bad();
    box.quality = 9;
    expect_bad();
    box.format = 9;
    expect_bad();
    box.placement = 9;
    expect_bad();
    box.resolution[1] = 100000;
    expect_bad();
    box.low[0] = NAN;
    expect_bad();
    box.high[2] = -3.0f;
    expect_bad();
    box.world_from_box[12] = INFINITY;
    expect_bad();
    box.low[0] = -3e38f;
    box.high[0] = 3e38f;
    expect_bad();
    box.low[0] = 0.0f;
    box.high[0] = 1e-40f;
    expect_bad();
    EXPECT_NE(std::string(error.message).find("too thin for shaders"), std::string::npos);
    EXPECT_EQ(texels[0], -7.0f);
}

}  // namespace
}  // namespace tetralight
