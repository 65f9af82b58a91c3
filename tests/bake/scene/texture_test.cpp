// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/texture.h>

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include <tetralight/bake/image/srgb.h>

namespace tetralight {
namespace {

constexpr std::array<uint8_t, 4> kBlack = {0, 0, 0, 255};
constexpr std::array<uint8_t, 4> kWhite = {255, 255, 255, 255};

/// Four texels in a row, of which only the first is white.
Texture row_texture(TextureWrap wrap) {
    return {"row", Image8{4, 1, {kWhite, kBlack, kBlack, kBlack}}, wrap, wrap};
}

float red_at(const Texture& texture, float u) {
    return sample_texture(texture, {u, 0.5f}).x;
}

TEST(SampleTexture, TexelCentersGiveTexels) {
    const Texture texture = row_texture(TextureWrap::Repeat);
    EXPECT_FLOAT_EQ(red_at(texture, 0.125f), 1.0f);
    EXPECT_FLOAT_EQ(red_at(texture, 0.375f), 0.0f);
}

TEST(SampleTexture, FiltersLinearlyBetweenCenters) {
    EXPECT_FLOAT_EQ(red_at(row_texture(TextureWrap::Repeat), 0.1875f), 0.75f);
}

TEST(SampleTexture, RepeatBlendsAcrossTheEdge) {
    const Texture texture = row_texture(TextureWrap::Repeat);
    EXPECT_FLOAT_EQ(red_at(texture, 0.0f), 0.5f);
    EXPECT_FLOAT_EQ(red_at(texture, 1.0f), 0.5f);
    EXPECT_FLOAT_EQ(red_at(texture, -2.875f), 1.0f);
}

TEST(SampleTexture, ClampKeepsTheEdge) {
    const Texture texture = row_texture(TextureWrap::ClampToEdge);
    EXPECT_FLOAT_EQ(red_at(texture, -5.0f), 1.0f);
    EXPECT_FLOAT_EQ(red_at(texture, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(red_at(texture, 5.0f), 0.0f);
}

TEST(SampleTexture, MirrorRunsBackwardsInOddPeriods) {
    const Texture texture = row_texture(TextureWrap::MirroredRepeat);
    EXPECT_FLOAT_EQ(red_at(texture, 0.0f), 1.0f);
    EXPECT_FLOAT_EQ(red_at(texture, -0.125f), 1.0f);
    EXPECT_FLOAT_EQ(red_at(texture, 1.125f), 0.0f);
    EXPECT_FLOAT_EQ(red_at(texture, 1.875f), 1.0f);
    EXPECT_FLOAT_EQ(red_at(texture, 2.125f), 1.0f);
}

TEST(SampleTexture, RowZeroIsAtTheTop) {
    const Texture texture{"column", Image8{1, 2, {kWhite, kBlack}}};
    EXPECT_FLOAT_EQ(sample_texture(texture, {0.5f, 0.25f}).x, 1.0f);
    EXPECT_FLOAT_EQ(sample_texture(texture, {0.5f, 0.75f}).x, 0.0f);
}

TEST(SampleTexture, DecodesBeforeFiltering) {
    const Texture texture{"pair", Image8{2, 1, {{0, 0, 0, 255}, {188, 188, 188, 255}}}};
    EXPECT_FLOAT_EQ(red_at(texture, 0.5f), 0.5f * linear_from_srgb8(188));
}

TEST(SampleTexture, DataIsLinearInAllChannels) {
    const Texture texture{"data", Image8{2, 1, {{0, 51, 102, 255}, {51, 51, 204, 0}}}};
    const glm::vec4 middle = sample_data_texture(texture, {0.5f, 0.5f});
    EXPECT_FLOAT_EQ(middle.x, 0.1f);
    EXPECT_FLOAT_EQ(middle.y, 0.2f);
    EXPECT_FLOAT_EQ(middle.z, 0.6f);
    EXPECT_FLOAT_EQ(middle.w, 0.5f);
}

TEST(SampleTexture, FourTexelsAreWeightedByTheAreasAcross) {
    // A quarter of the way right and half of the way down between the four centres.
    const Texture texture{
        "four", Image8{2, 2, {{255, 0, 0, 8}, {0, 255, 0, 8}, {0, 0, 255, 8}, {0, 0, 0, 8}}}};
    const glm::vec4 color = sample_texture(texture, {0.25f + 0.125f, 0.25f + 0.25f});
    EXPECT_FLOAT_EQ(color.x, 0.75f * 0.5f);
    EXPECT_FLOAT_EQ(color.y, 0.25f * 0.5f);
    EXPECT_FLOAT_EQ(color.z, 0.75f * 0.5f);
}

TEST(SampleTexture, AlphaIsLinear) {
    const Texture texture{"alpha", Image8{1, 1, {{0, 0, 0, 51}}}};
    EXPECT_FLOAT_EQ(sample_texture(texture, {0.5f, 0.5f}).w, 0.2f);
}

TEST(SampleTexture, AlphaAloneHasTheSameBits) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> coordinate(-3.0f, 3.0f);
    Texture texture{"alphas", Image8{7, 5, {}}, TextureWrap::Repeat, TextureWrap::MirroredRepeat};
    for (int i = 0; i < 35; ++i) {
        texture.image.pixels.push_back({0, 0, 0, static_cast<uint8_t>(engine())});
    }
    for (int i = 0; i < 1000; ++i) {
        const glm::vec2 uv(coordinate(engine), coordinate(engine));
        EXPECT_EQ(sample_texture_alpha(texture, uv), sample_texture(texture, uv).w);
    }
}

TEST(SampleTexture, LargeCoordinatesKeepTheirFraction) {
    // 2^20 + 1/8 and -2^20 + 1/8 are floats; the first texel is centered at 1/8.
    const Texture texture = row_texture(TextureWrap::Repeat);
    EXPECT_EQ(red_at(texture, 0x1p20f + 0.125f), 1.0f);
    EXPECT_EQ(red_at(texture, -0x1p20f + 0.125f), 1.0f);
    EXPECT_EQ(red_at(texture, 0x1p23f), 0.5f);
    EXPECT_EQ(red_at(texture, -0x1p30f), 0.5f);
}

TEST(SampleTexture, AnyCoordinateIsSafe) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const auto wrap :
         {TextureWrap::Repeat, TextureWrap::MirroredRepeat, TextureWrap::ClampToEdge}) {
        for (const float u : {1e30f, -1e30f, kInfinity, -kInfinity, std::nanf("")}) {
            const float red = red_at(row_texture(wrap), u);
            EXPECT_TRUE(red >= 0.0f && red <= 1.0f) << u;
        }
    }
}

}  // namespace
}  // namespace tetralight
