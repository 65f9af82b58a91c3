// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv_texture.h>

#include <gtest/gtest.h>

#include <numbers>

#include "tests/lppv/lppv_fixture.h"

namespace tetralight {
namespace {

using test::grid_in_box;

/// A grid whose points hold unrelated light and occlusion, so that whatever is mixed up shows.
Lppv make_random_lppv(const LppvGrid& grid, LppvQuality quality) {
    const ProbeVolume volume = test::make_random_volume(test::random_positions(200, 3), 4);
    Lppv lppv = *make_lppv(volume.view(), grid, {});
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (IrradianceSh& sh : lppv.irradiance) {
        const IrradianceSh random = test::random_light(engine, -1.0f, 1.0f);
        const IrradianceSh first = &sh == &lppv.irradiance[0] ? random : lppv.irradiance[0];
        sh = random;
        for (int i = 4; i < kShCoefficientCount; ++i) {
            if (quality == LppvQuality::Low) sh.coefficients[i] = glm::vec3(0.0f);
            if (quality == LppvQuality::Normal) sh.coefficients[i] = first.coefficients[i];
        }
        lppv.occlusion.emplace_back(share(engine), share(engine), share(engine), share(engine));
    }
    lppv.quality = quality;
    return lppv;
}

/// Positions in and around the unit cube's grid.
std::vector<glm::vec3> positions_around(const LppvGrid& grid) {
    std::mt19937_64 engine(6);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 local(coordinate(engine), coordinate(engine), coordinate(engine));
        positions.emplace_back(grid.world_from_local * glm::dvec4(local, 1.0));
    }
    return positions;
}

void expect_same_light(const PackedSh& light, const IrradianceSh& expected, float tolerance) {
    std::mt19937_64 engine(7);
    for (int i = 0; i < 5; ++i) {
        const glm::vec3 n = test::random_direction(engine);
        EXPECT_LE(glm::distance(sample_sh9(light, n),
                                evaluate_irradiance(expected, n) * std::numbers::inv_pi_v<float>),
                  tolerance);
    }
}

class LppvTextureOf : public testing::TestWithParam<glm::uvec3> {
  protected:
    void expect_texture_of(LppvQuality quality, LppvLayout layout) const {
        for (const auto placement : {LppvPlacement::CellCorners, LppvPlacement::CellCenters}) {
            const LppvGrid grid = grid_in_box(GetParam(), {1.0, -2.0, 0.5}, 30.0, placement);
            const Lppv lppv = make_random_lppv(grid, quality);
            const LppvConstants constants = make_lppv_constants(lppv, layout);
            const auto floats = make_lppv_texture(lppv, layout, LppvTexelFormat::Float);
            const auto halves = make_lppv_texture(lppv, layout, LppvTexelFormat::Half);
            for (const glm::vec3& p : positions_around(grid)) {
                const InterpolatedProbe expected = sample_lppv(lppv, p);
                expect_same_light(sample_lppv_texture(floats, constants, p), expected.irradiance,
                                  2e-5f);
                expect_same_light(sample_lppv_texture(halves, constants, p), expected.irradiance,
                                  4e-3f);
                if (layout == LppvLayout::SevenSlabs) continue;
                EXPECT_LE(
                    glm::distance(sample_lppv_occlusion(floats, constants, p), expected.occlusion),
                    2e-5f);
            }
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Grids, LppvTextureOf,
                         testing::Values(glm::uvec3(5, 4, 3), glm::uvec3(1, 2, 1),
                                         glm::uvec3(2, 1, 6), glm::uvec3(33, 1, 1)));

TEST_P(LppvTextureOf, FourSlabsAloneAreBands0And1) {
    expect_texture_of(LppvQuality::Low, LppvLayout::FourSlabs);
}

TEST_P(LppvTextureOf, FourSlabsWithAConstantBand2AreRight) {
    expect_texture_of(LppvQuality::Normal, LppvLayout::FourSlabs);
}

TEST_P(LppvTextureOf, SevenSlabsHoldEverything) {
    for (const auto quality : {LppvQuality::Low, LppvQuality::Normal, LppvQuality::Full}) {
        expect_texture_of(quality, LppvLayout::SevenSlabs);
    }
}

TEST(LppvTexture, TheLastComponentOfShaIsS0InFourSlabsAndLessS6InSeven) {
    const Lppv lppv =
        make_random_lppv(grid_in_box({2, 2, 2}, glm::dvec3(1.0), 0.0), LppvQuality::Full);
    const PackedSh packed = pack_sh(lppv.irradiance[0]);
    const auto four = make_lppv_texture(lppv, LppvLayout::FourSlabs, LppvTexelFormat::Float);
    const auto seven = make_lppv_texture(lppv, LppvLayout::SevenSlabs, LppvTexelFormat::Float);
    EXPECT_EQ(four.size, glm::uvec3(8, 2, 2));
    EXPECT_EQ(seven.size, glm::uvec3(14, 2, 2));
    EXPECT_EQ(fetch_texel(seven, {0, 0, 0}), packed.sha_r);
    EXPECT_EQ(fetch_texel(seven, {12, 0, 0}), packed.shc);
    // s0 = K0 E0 / pi, K0 the constant of band 0.
    const float s0 = 0.28209479f * lppv.irradiance[0].coefficients[0].r / std::numbers::pi_v<float>;
    EXPECT_NEAR(fetch_texel(four, {0, 0, 0}).w, s0, 1e-6f);
    EXPECT_EQ(glm::vec3(fetch_texel(four, {0, 0, 0})), glm::vec3(packed.sha_r));
    EXPECT_EQ(fetch_texel(four, {6, 0, 0}), lppv.occlusion[0]);
}

TEST(LppvTexture, CoordinatesAreThoseOfUnity) {
    const LppvGrid grid = grid_in_box({5, 2, 4}, {4.0, 2.0, 8.0}, 0.0, LppvPlacement::CellCenters);
    const Lppv lppv = make_random_lppv(grid, LppvQuality::Low);
    const LppvConstants c = make_lppv_constants(lppv, LppvLayout::FourSlabs);
    EXPECT_FLOAT_EQ(c.params.z, 1.0f / 20.0f);
    // Cell centres: the volume's coordinates are those of its box, here in the object's space.
    const glm::vec3 low(c.local_from_world * glm::vec4(-2, -1, -4, 1));
    const glm::vec3 high(c.local_from_world * glm::vec4(2, 1, 4, 1));
    EXPECT_LE(glm::distance((low - glm::vec3(c.low)) * glm::vec3(c.size_inverse), glm::vec3(0.0f)),
              1e-6f);
    EXPECT_LE(glm::distance((high - glm::vec3(c.low)) * glm::vec3(c.size_inverse), glm::vec3(1.0f)),
              1e-6f);
}

TEST(LppvTexture, WorldBoxesNeedNoTransform) {
    const LppvPart cube{glm::dmat4(1.0), glm::dvec3(-1.0), glm::dvec3(1.0)};
    const LppvGrid grid = *make_lppv_grid({glm::dmat4(1.0), std::span(&cube, 1)},
                                          {.bounds = LppvBounds::AutomaticWorld});
    const Lppv lppv = make_random_lppv(grid, LppvQuality::Low);
    EXPECT_EQ(make_lppv_constants(lppv, LppvLayout::FourSlabs).params.y, 0.0f);
}

TEST(LppvTexture, HalvesSaturate) {
    Lppv lppv = make_random_lppv(grid_in_box({1, 1, 1}, glm::dvec3(1.0), 0.0), LppvQuality::Low);
    lppv.irradiance[0].coefficients[0] = glm::vec3(1e9f);
    const auto halves = make_lppv_texture(lppv, LppvLayout::FourSlabs, LppvTexelFormat::Half);
    EXPECT_EQ(fetch_texel(halves, {0, 0, 0}).w, 65504.0f);
}

TEST(LppvTexture, KnowsItsLargestValue) {
    Lppv lppv;
    lppv.grid = test::grid_in_box({2, 1, 1}, glm::dvec3(1.0), 0.0);
    lppv.irradiance.resize(2);
    lppv.irradiance[1].coefficients[0] = {0.0f, -1e6f, 0.0f};
    const float w = std::abs(pack_sh(lppv.irradiance[1]).sha_g.w);  // s0, the rest is 0
    EXPECT_GT(w, kLargestHalf);
    for (const auto layout : {LppvLayout::FourSlabs, LppvLayout::SevenSlabs}) {
        EXPECT_EQ(largest_texel_value(lppv, layout), w);
        const LppvTexture halves = make_lppv_texture(lppv, layout, LppvTexelFormat::Half);
        EXPECT_EQ(fetch_texel(halves, {3, 0, 0}).w, -kLargestHalf);
    }
}

}  // namespace
}  // namespace tetralight
