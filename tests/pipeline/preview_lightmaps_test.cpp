// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/preview_lightmaps.h>

#include <algorithm>

#include <tetralight/base/half.h>
#include "tests/pipeline/lightmap_part_fixture.h"

namespace tetralight::test {
namespace {

class PreviewLightmaps : public LightmapPartFixture {
  protected:
    PreviewLightmaps() {
        settings.is_unfiltered = true;
        // Stitching would change finished lightmaps.
        for (MeshInstance& instance : scene.instances) instance.lightmap.stitches_seams = false;
    }

    [[nodiscard]] static std::vector<float> greens(const Lightmaps& maps) {
        std::vector<float> values;
        for (const IrradianceTexel& texel : maps.irradiance) {
            const float value = float_from_half(texel.rgb[1]) * maps.info.scale;
            values.push_back(texel.coverage == 0 ? -1.0f : value);
        }
        return values;
    }

    static size_t covered_count(const Lightmaps& maps) {
        return static_cast<size_t>(std::ranges::count_if(
            maps.irradiance, [](const IrradianceTexel& texel) { return texel.coverage != 0; }));
    }
};

TEST_F(PreviewLightmaps, OfAllSamplesIsTheUnfilteredLight) {
    const PreparedLightmaps prepared = prepare();
    const TexelBake baked = bake(prepared, {0, texel_count()});
    const Lightmaps preview = preview_lightmaps(scene, prepared, baked, nullptr);
    EXPECT_TRUE(verify(preview.view()));
    const Lightmaps finished = finish_lightmaps(prepare(), baked).lightmaps;
    EXPECT_EQ(preview.rectangles, finished.rectangles);
    EXPECT_EQ(preview.corner_uvs, finished.corner_uvs);
    const auto shown = greens(preview), expected = greens(finished);
    ASSERT_EQ(shown.size(), expected.size());
    EXPECT_GT(covered_count(preview), 100u);
    for (size_t i = 0; i < shown.size(); ++i)
        EXPECT_NEAR(shown[i], expected[i], 1e-3f * std::abs(expected[i])) << i;
}

TEST_F(PreviewLightmaps, ObjectsWithoutLightAreNotCovered) {
    const PreparedLightmaps prepared = prepare();
    TexelBake none = bake(prepared, {0, 1});
    none.accumulators[0] = {};
    EXPECT_EQ(covered_count(preview_lightmaps(scene, prepared, none, nullptr)), 0u);
    // One texel gives its light to all of its object.
    const TexelBake one = bake(prepared, {0, 1});
    const Lightmaps preview = preview_lightmaps(scene, prepared, one, nullptr);
    EXPECT_TRUE(verify(preview.view()));
    const auto values = greens(preview);
    EXPECT_GE(covered_count(preview), 16u);
    std::vector<float> covered;
    std::ranges::copy_if(values, std::back_inserter(covered), [](float v) { return v >= 0.0f; });
    EXPECT_GT(covered[0], 0.0f);
    EXPECT_NEAR(std::ranges::min(covered), std::ranges::max(covered), 1e-3f * covered[0]);
}

/// The tiles and the box see the whole sky, or half of it.
TEST_F(PreviewLightmaps, TexelsWithoutSamplesHaveTheLightOfTheCache) {
    settings.bake.sample_count = 1024;
    std::vector<Lightmaps> previews;
    const PreparedLightmaps prepared = prepare();
    const LightmapPreview every{.show =
                                    [&](const LightmapsView& maps) {
                                        EXPECT_TRUE(verify(maps));
                                        previews.push_back(copy_lightmaps(maps));
                                    },
                                .seconds = 0.0};
    const PlaceRange some{0, 8};
    const auto baked = bake_texel_range(scene, prepared, some, {}, {}, every);
    ASSERT_TRUE(baked);
    ASSERT_FALSE(previews.empty());
    const Lightmaps finished =
        finish_lightmaps(prepare(), bake(prepared, {0, texel_count()})).lightmaps;
    EXPECT_EQ(covered_count(previews[0]), covered_count(finished));
    const auto shown = greens(previews[0]), expected = greens(finished);
    double difference = 0.0, sum = 0.0;
    for (size_t i = 0; i < shown.size(); ++i) {
        if (expected[i] < 0.0f) continue;
        difference += double{shown[i] - expected[i]};
        sum += double{expected[i]};
    }
    EXPECT_LT(std::abs(difference), 0.05 * sum);
}

TEST_F(PreviewLightmaps, ChangeNoLight) {
    settings.bake.target_error = 0.01;
    const PreparedLightmaps prepared = prepare();
    size_t count = 0;
    const LightmapPreview every{.show = [&](const LightmapsView&) { ++count; }, .seconds = 0.0};
    const PlaceRange all{0, texel_count()};
    const auto shown = bake_texel_range(scene, prepared, all, {}, {}, every);
    ASSERT_TRUE(shown);
    EXPECT_GT(count, 0u);
    EXPECT_EQ(shown->accumulators, bake(prepared, all).accumulators);
}

}  // namespace
}  // namespace tetralight::test
