// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/cut_light.h>

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

constexpr double kBand0 = 0.28209479177387814;

BakedProbes bake(const Scene& scene, const std::vector<glm::dvec3>& positions,
                 BakeSettings settings) {
    const auto baked = bake_probes(scene, positions, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return baked ? *baked : BakedProbes{};
}

BakeSettings samples(uint32_t sample_count, uint32_t bounces) {
    BakeSettings settings;
    settings.sample_count = sample_count;
    settings.bounces = bounces;
    return settings;
}

/// A closed room that emits radiance 1 everywhere: light of order n is albedo^n.
Scene furnace(float albedo) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(albedo), glm::vec3(1.0f)), test::Facing::Inward,
                  {-1, -2, -1}, {3, 1, 1});
    return scene;
}

/// A white room without emission; its light comes from a sky through an opening in the ceiling.
Scene white_room() {
    Scene scene;
    Material white = test::diffuse(glm::vec3(0.8f));
    white.is_double_sided = true;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, white, test::Facing::Inward, {-2, 0, -2}, {2, 3, 2});
    Mesh& walls = scene.meshes.back();
    // The ceiling is open: its two triangles have all corners at the top.
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < walls.indices.size(); i += 3) {
        bool is_ceiling = true;
        for (size_t k = 0; k < 3; ++k) {
            is_ceiling = is_ceiling && walls.positions[walls.indices[i + k]].y > 2.9f;
        }
        if (is_ceiling) continue;
        indices.insert(indices.end(), walls.indices.begin() + static_cast<ptrdiff_t>(i),
                       walls.indices.begin() + static_cast<ptrdiff_t>(i + 3));
    }
    walls.indices = indices;
    return scene;
}

TEST(CutLight, IsAGeometricSeriesOfTheLastLight) {
    const CutLight cut{glm::dvec3(2.0, 4.0, 0.0), 8.0, 6.0};
    EXPECT_EQ(cut.lost_radiance(), glm::dvec3(6.0, 12.0, 0.0));  // (3/4) / (1/4) = 3
}

TEST(CutLight, IsFiniteWhereNothingIsAbsorbedAndNoneWhereNoPathIsCut) {
    EXPECT_NEAR(CutLight({glm::dvec3(1.0), 2.0, 2.5}).lost_radiance().x, 999.0, 1e-6);
    EXPECT_EQ(CutLight({glm::dvec3(1.0), 2.0, 0.0}).lost_radiance(), glm::dvec3(0.0));
    EXPECT_EQ(CutLight{}.lost_radiance(), glm::dvec3(0.0));
}

TEST(CutLight, StandardErrorOfAFurnaceHasTheLostPartOfTheSeries) {
    // Kept: (1 − ρ^(b+1)) / (1 − ρ). Lost: ρ^(b+1) / (1 − ρ).
    for (const double albedo : {0.5, 0.8}) {
        for (const uint32_t bounces : {0u, 1u, 4u}) {
            const double kept = 1.0 - std::pow(albedo, bounces + 1);
            const BakedProbes baked =
                bake(furnace(static_cast<float>(albedo)), {{1, 0, 0}}, samples(1 << 14, bounces));
            const double lost = (1.0 - kept) / kept;
            const double expected = std::hypot(lost, double{baked.sampling_error[0]});
            EXPECT_NEAR(baked.standard_error[0], expected, 0.03 * expected) << albedo << bounces;
            EXPECT_LT(baked.sampling_error[0], 0.1 * lost);
        }
    }
}

TEST(CutLight, AllLightIsTheWholeSeriesAndLosesNone) {
    for (const double albedo : {0.5, 0.8, 0.95}) {
        const BakedProbes baked = bake(furnace(static_cast<float>(albedo)), {{1, 0, 0}},
                                       samples(1 << 16, BakeSettings{}.bounces));
        const double radiance = baked.radiance[0].coefficients[0].y * kBand0;
        EXPECT_NEAR(radiance * (1.0 - albedo), 1.0, 0.005);
        EXPECT_EQ(baked.standard_error[0], baked.sampling_error[0]);
    }
}

TEST(CutLight, StandardErrorOfAnOpenRoomIsTheLossOfItsBounces) {
    const std::vector<glm::dvec3> positions{{0, 0.5, 0}, {1.5, 1, -1}, {-1, 2.5, 1}};
    const BakedProbes all = bake(white_room(), positions, samples(1 << 15, kAllBounces));
    for (const uint32_t bounces : {1u, 2u, 4u}) {
        const BakedProbes cut = bake(white_room(), positions, samples(1 << 15, bounces));
        for (size_t i = 0; i < positions.size(); ++i) {
            const double whole = all.radiance[i].coefficients[0].x;
            const double kept = cut.radiance[i].coefficients[0].x;
            EXPECT_GT(whole / kept, 1.01);
            const double ratio = cut.standard_error[i] / (whole / kept - 1.0);
            EXPECT_GT(ratio, 0.7) << bounces << " " << i;
            EXPECT_LT(ratio, 1.4) << bounces << " " << i;
        }
    }
}

TEST(CutLight, DoesNotCountForTheTargetError) {
    BakeSettings settings = samples(1024, 1);
    settings.target_error = 0.02;
    const BakedProbes baked = bake(furnace(0.8f), {{1, 0, 0}}, settings);
    EXPECT_EQ(baked.sample_count[0], 1024u);
    EXPECT_LT(baked.sampling_error[0], 0.02);
    EXPECT_GT(baked.standard_error[0], 1.0);  // ρ² / (1 − ρ²) = 1.8
}

}  // namespace
}  // namespace tetralight
