// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <random>

#include <tetralight/pipeline/bake_store.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/pipeline/partial_bake.h>

#include "tests/pipeline/lightmap_part_fixture.h"
#include "tests/support/mapped_wall.h"

namespace tetralight {
namespace {

class MergeLightmapParts : public test::LightmapPartFixture {
  protected:
    [[nodiscard]] static std::string error_of(const std::vector<std::string>& paths) {
        const auto merged = merge_lightmap_parts(paths);
        EXPECT_FALSE(merged);
        return merged ? "" : error_text(merged.error());
    }

    void expect_whole(const std::vector<std::string>& paths) const {
        const auto merged = merge_lightmap_parts(paths);
        ASSERT_TRUE(merged) << error_text(merged.error());
        EXPECT_TRUE(lightmap_file_bytes(merged->lightmaps.view()) == whole());
    }

    void expect_whole_of_two() const {
        expect_whole({bake_part("a", {0, 12}), bake_part("b", {12, texel_count()})});
    }
};

TEST_F(MergeLightmapParts, GivesTheBytesOfOneBakeInAnyOrderOfTheParts) {
    const uint32_t count = texel_count();
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {12, 13}),
                      c = bake_part("c", {13, count}), d = bake_part("d", {count, count});
    expect_whole({a, b, c});
    expect_whole({d, c, a, b});
    expect_whole({bake_part("all", {0, count})});
}

TEST_F(MergeLightmapParts, OfAdaptiveBakesToo) {
    settings.bake.target_error = 0.02;
    settings.bake.max_sample_count = 1024;
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfUnfilteredBakesToo) {
    settings.is_unfiltered = true;
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfNormalMapsToo) {
    test::set_normal_map(scene, scene.materials[0], {0.5f, 0.2f});
    const auto flat = whole();
    settings.has_normal_maps = true;
    EXPECT_FALSE(whole() == flat);
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfLayersToo) {
    settings.lighting.layers = {"sky"};
    settings.bake.target_layer_error = 0.05;
    settings.bake.max_sample_count = 512;
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfShadowMasksAndAmbientOcclusionToo) {
    scene.lights[0].mode = LightMode::Mixed;
    settings.lighting.mixed_lighting = MixedLighting::Shadowmask;
    settings.ambient_occlusion_distance = 0.5f;
    settings.lighting.layers = {"sky"};
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfNamedObjectsToo) {
    settings.only = {"next"};
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfScenesWithObjectsOfOneMeshAndSeveralPages) {
    MeshInstance copy = scene.instances[2];
    copy.name = "copy";
    copy.world_from_mesh[3] = {5, 0, 0, 1};
    scene.instances.insert(scene.instances.begin(), copy);
    scene.instances[1].lightmap.receive_gi = ReceiveGi::Probes;
    settings.layout.page_size = 24;
    EXPECT_GT(prepare().layout.page_count, 1u);
    expect_whole_of_two();
}

TEST_F(MergeLightmapParts, OfAnyRangesThreadsAndInterruptions) {
    settings.bake.target_error = 0.05;
    settings.bake.max_sample_count = 512;
    std::mt19937 random(7);
    const std::vector<std::byte> expected = whole();
    const uint32_t count = texel_count();
    uint64_t earlier_ray_count = 0;
    for (int run = 0; run < 8; ++run) {
        std::vector<std::string> paths;
        std::vector<PlaceRange> ranges = spread_ranges(count, 1 + random() % 4);
        if (run % 2 == 0) {
            const auto middle = 1 + static_cast<uint32_t>(random()) % (count - 1);
            ranges = {{0, middle}, {middle, count}};
        }
        for (const PlaceRange& range : ranges) {
            settings.bake.thread_count = 1 + static_cast<uint32_t>(random()) % 4;
            const PreparedLightmaps prepared = prepare();
            auto store = BakeStore::open(folder.path("store" + std::to_string(run / 2)));
            ASSERT_TRUE(store);
            const BakeStorage storage{.sources = {&*store}, .target = &*store, .save_seconds = 0.0};
            size_t left = 1 + random() % 3;
            static_cast<void>(bake_texel_range(scene, prepared, range, storage,
                                               [&](const BakeProgress&) { return --left > 0; }));
            const auto baked = bake_texel_range(scene, prepared, range, storage);
            ASSERT_TRUE(baked) << error_text(baked.error());
            earlier_ray_count += baked->stored.earlier_ray_count;
            paths.push_back(folder.path("part" + std::to_string(paths.size())));
            ASSERT_TRUE(write_lightmap_part(paths.back(), prepared, *baked));
        }
        std::ranges::shuffle(paths, random);
        const auto merged = merge_lightmap_parts(paths, 1 + static_cast<uint32_t>(run) % 3);
        ASSERT_TRUE(merged) << error_text(merged.error());
        EXPECT_TRUE(lightmap_file_bytes(merged->lightmaps.view()) == expected) << run;
    }
    EXPECT_GT(earlier_ray_count, 0u);
}

TEST_F(MergeLightmapParts, ReportsAsOneBakeDoes) {
    settings.bake.target_error = 1e-4;
    settings.bake.max_sample_count = 256;
    const auto merged =
        merge_lightmap_parts({bake_part("a", {0, 12}), bake_part("b", {12, texel_count()})});
    const auto baked = bake_lightmaps(scene, settings);
    ASSERT_TRUE(merged && baked);
    const LightmapReport &ours = merged->report, &whole = baked->report;
    EXPECT_EQ(ours.texel_count, whole.texel_count);
    EXPECT_EQ(ours.invalid_count, whole.invalid_count);
    EXPECT_EQ(ours.chart_count, whole.chart_count);
    EXPECT_EQ(ours.seam_count, whole.seam_count);
    EXPECT_GT(whole.seam_count, 0u);
    EXPECT_EQ(ours.seam_difference, whole.seam_difference);
    EXPECT_EQ(ours.ray_count, whole.ray_count);
    EXPECT_EQ(ours.worst_error, whole.worst_error);
    EXPECT_EQ(ours.warnings, whole.warnings);
    EXPECT_GT(whole.over_target_count, 0u);
}

TEST_F(MergeLightmapParts, NamesWhatOverlapsAndWhatIsMissing) {
    const uint32_t count = texel_count();
    const std::string all = std::to_string(count), end = ".." + all;
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {11, count}),
                      c = bake_part("c", {20, 30});
    EXPECT_EQ(error_of({a, b}), b + ": texels 11" + end + " overlap texels 0..12 of " + a);
    EXPECT_EQ(error_of({a, c}), "texels 12..20 and " + std::to_string(count - 30) + " others of " +
                                    all + " are in no part; the next, 20..30, are in " + c);
    EXPECT_EQ(error_of({a}),
              "texels 12" + end + " of " + all + " are in no part; the last, 0..12, are in " + a);
}

TEST_F(MergeLightmapParts, RefusesPartsOfOtherScenesAndSettings) {
    const std::string a = bake_part("a", {0, 12});
    const auto refuse = [&] {
        const std::string b = bake_part("b", {12, texel_count()});
        EXPECT_EQ(error_of({a, b}), b + ": is of another bake than " + a +
                                        " (scene, settings or program version differ)");
    };
    const BakeLightmapsSettings old = settings;
    settings.bake.seed = 1;
    refuse();
    settings = old;
    settings.texels.grid = 1;
    refuse();
    settings = old;
    settings.only = {"next"};
    refuse();
    settings = old;
    settings.lighting.layers = {"sky"};
    refuse();
    settings = old;
    scene.lights[0].intensity.y = 2.5f;
    refuse();
}

TEST_F(MergeLightmapParts, NamesFilesThatAreNoParts) {
    const std::string none = folder.path("none");
    EXPECT_EQ(error_of({none}).find(none + ": cannot open"), 0u);
    const auto baked = bake_lightmaps(scene, settings);
    const std::string whole_path = folder.path("whole");
    ASSERT_TRUE(baked && write_lightmap_file(whole_path, baked->lightmaps.view()));
    EXPECT_EQ(error_of({whole_path}),
              whole_path + ": is not a part of a bake (lightmap --texels writes parts)");
}

TEST_F(MergeLightmapParts, RefusesPartsOfProbes) {
    ProbeGroup group;
    group.name = "hall";
    group.positions = {{0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 1}};
    const auto prepared = prepare_bake(scene, {&group, 1}, {});
    ASSERT_TRUE(prepared);
    const std::string probes = folder.path("probes"), texels = bake_part("texels", {0, 12});
    ASSERT_TRUE(write_part(probes, *prepared, {}));
    EXPECT_EQ(error_of({texels, probes}),
              probes + ": contains probes, but " + texels + " contains lightmaps");
    const auto merged = merge_parts({probes, texels});
    ASSERT_FALSE(merged);
    EXPECT_EQ(error_text(merged.error()),
              texels + ": contains lightmaps, but " + probes + " contains probes");
}

TEST_F(MergeLightmapParts, RangesBeyondTheTexelsAreRefused) {
    const PreparedLightmaps prepared = prepare();
    const std::string count = std::to_string(prepared.baked.size());
    const auto end = static_cast<uint32_t>(prepared.baked.size() + 1);
    const auto baked = bake_texel_range(scene, prepared, {5, end});
    ASSERT_FALSE(baked);
    EXPECT_EQ(baked.error().field, "texels");
    EXPECT_EQ(error_text(baked.error()),
              "texels 5.." + std::to_string(end) + ": there are " + count + " texels");
}

}  // namespace
}  // namespace tetralight
