// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/stitch_light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace tetralight {
namespace {

constexpr uint32_t kPageSize = 32;

/// Two vertical edges of 8 texels, at different places within texels.
SeamStitcher make_stitcher() {
    const Seam seam{{0, {4.5f, 2.0f}, {4.5f, 10.0f}}, {0, {20.2f, 12.3f}, {20.2f, 20.3f}}};
    return {std::vector{seam}, kPageSize, [](uint64_t) { return 0.0002; }};
}

glm::vec3 random_vector(std::mt19937_64& engine, float low, float high) {
    std::uniform_real_distribution<float> uniform(low, high);
    return {uniform(engine), uniform(engine), uniform(engine)};
}

/// Light of one texel whose vectors are those of its irradiance.
TexelLight random_light(std::mt19937_64& engine, const glm::vec3& normal, float brightness) {
    TexelLight light;
    for (int channel = 0; channel < 3; ++channel) {
        glm::vec3& vector = light.vector[channel];
        vector = brightness * (normal + random_vector(engine, -0.4f, 0.4f));
        light.irradiance[channel] = glm::dot(normal, vector);
        light.flux[channel] = 1.2f * glm::length(vector);
    }
    return light;
}

/// Light at a seam with two layers of which one is dark at each texel, and their sum.
struct LightAtSeam {
    SeamStitcher stitcher = make_stitcher();
    std::vector<glm::vec3> normals;
    std::vector<TexelLight> total;
    std::vector<std::vector<TexelLight>> layers{2};

    LightAtSeam() {
        std::mt19937_64 engine(11);
        for (const uint64_t texel : stitcher.texels()) {
            const bool is_first = texel % kPageSize < 10;
            const glm::vec3 lean = random_vector(engine, -0.2f, 0.2f);
            normals.push_back(
                glm::normalize((is_first ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0)) + lean));
            const bool is_even = engine() % 2 == 0;
            const std::array<bool, 2> is_dark{is_even, !is_even};
            for (size_t i = 0; i < 2; ++i) {
                const float brightness = is_dark[i] ? 0.001f : 1.0f;
                layers[i].push_back(random_light(engine, normals.back(), brightness));
            }
            total.push_back(layers[0].back());
            total.back() += layers[1].back();
        }
    }

    void stitch() { stitch_light(stitcher, normals, total, layers, 1); }
};

double seam_difference(const SeamStitcher& stitcher, const std::vector<TexelLight>& lights) {
    std::vector<double> values;
    for (const TexelLight& light : lights) values.push_back(double{light.irradiance.y});
    return stitcher.relative_percentile(values, 0.99);
}

TEST(StitchLight, BothSidesAgreeAfterwards) {
    LightAtSeam light;
    const double before = seam_difference(light.stitcher, light.total);
    light.stitch();
    EXPECT_LT(seam_difference(light.stitcher, light.total), 0.1 * before);
}

TEST(StitchLight, LayersAddUpToTheTotalWhereTheyWouldBecomeNegative) {
    LightAtSeam light;
    // Least squares brings a layer below 0: otherwise layers would add up by themselves.
    std::vector<double> values;
    for (const TexelLight& texel : light.layers[0]) values.push_back(double{texel.irradiance.x});
    ASSERT_LT(std::ranges::min(light.stitcher.stitched(values)), -0.001);
    light.stitch();
    for (size_t i = 0; i < light.total.size(); ++i) {
        TexelLight sum = light.layers[0][i];
        sum += light.layers[1][i];
        const TexelLight& total = light.total[i];
        const float rounding = 1e-5f * total.largest();
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(sum.irradiance[channel], total.irradiance[channel], rounding) << i;
            EXPECT_NEAR(sum.flux[channel], total.flux[channel], rounding) << i;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(sum.vector[channel][axis], total.vector[channel][axis], rounding) << i;
            }
        }
    }
}

TEST(StitchLight, NoIrradianceOrFluxIsNegative) {
    LightAtSeam light;
    light.stitch();
    light.layers.push_back(light.total);
    for (const std::vector<TexelLight>& lights : light.layers) {
        for (const TexelLight& texel : lights) {
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_GE(texel.irradiance[channel], 0.0f);
                EXPECT_GE(texel.flux[channel], 0.0f);
            }
        }
    }
}

TEST(StitchLight, VectorsGiveTheIrradianceOnTheTexelsNormals) {
    LightAtSeam light;
    light.stitch();
    light.layers.push_back(light.total);
    for (const std::vector<TexelLight>& lights : light.layers) {
        for (size_t i = 0; i < lights.size(); ++i) {
            const glm::vec3 irradiance = light.normals[i] * lights[i].vector;
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(irradiance[channel], lights[i].irradiance[channel], 1e-5f) << i;
        }
    }
}

TEST(StitchLight, VectorsOfTexelsWithOtherNormalsAreOnlyStitched) {
    LightAtSeam light;
    std::vector<double> values;
    for (const TexelLight& texel : light.total) values.push_back(double{texel.vector[1].z});
    std::ranges::fill(light.normals, glm::vec3(0.0f));
    light.stitch();
    const std::vector<double> stitched = light.stitcher.stitched(values);
    for (size_t i = 0; i < values.size(); ++i)
        EXPECT_NEAR(double{light.total[i].vector[1].z}, stitched[i], 1e-6) << i;
}

}  // namespace
}  // namespace tetralight
