// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/lppv/lppv_atlas.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <thread>

#include "tests/lppv/lppv_fixture.h"

namespace tetralight {
namespace {

using Refilled = std::vector<uint32_t>;

/// Small volumes all over [-0.8, 0.8]³, turned anyhow.
std::vector<LppvGrid> make_grids(size_t count, uint64_t seed) {
    const auto places = test::random_positions(count, seed, 0.8);
    std::vector<LppvGrid> grids;
    for (size_t i = 0; i < count; ++i) {
        LppvGrid grid = test::grid_in_box({2, 3, 5}, {0.1, 0.15, 0.3}, 10.0 * double(i));
        grid.world_from_local[3] = glm::dvec4(places[i], 1.0);
        grid.local_from_world = glm::inverse(grid.world_from_local);
        grids.push_back(grid);
    }
    return grids;
}

ProbeVolume make_volume() {
    ProbeVolume volume = test::make_random_volume(test::random_positions(900, 3), 4);
    std::mt19937_64 engine(8);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.occlusion.emplace_back(share(engine), share(engine), share(engine), share(engine));
    }
    return volume;
}

LppvAtlas make_atlas(const std::vector<LppvGrid>& grids, LppvQuality quality, LppvLayout layout,
                     LppvRefresh refresh = LppvRefresh::Automatic) {
    LppvAtlas atlas(
        {.slab_size = {32, 32, 32}, .layout = layout, .format = LppvTexelFormat::Float});
    for (const LppvGrid& grid : grids) EXPECT_TRUE(atlas.add(grid, quality, refresh));
    return atlas;
}

TEST(LppvAtlas, LightsEachObjectAsItsReceiverSays) {
    const ProbeVolume volume = test::make_walled_volume();
    const auto grids = make_grids(3, 1);
    const std::array receivers{Receiver{}, Receiver{.rendering_layers = 0b01},
                               Receiver{Walls::HideProbes, 0b10, 0.5f}};
    LppvAtlas atlas({.slab_size = {32, 32, 32},
                     .layout = LppvLayout::SevenSlabs,
                     .format = LppvTexelFormat::Float});
    for (size_t i = 0; i < 3; ++i) {
        ASSERT_TRUE(
            atlas.add(grids[i], LppvQuality::Full, LppvRefresh::Automatic, {}, receivers[i]));
    }
    (void)atlas.refresh(volume.view(), {});
    for (uint32_t id = 0; id < 3; ++id) {
        const Lppv lppv = *make_lppv(volume.view(), grids[id], {.receiver = receivers[id]});
        for (size_t i = 0; i < grids[id].point_count(); ++i) {
            const glm::vec3 p(grids[id].world_position(grids[id].point(i)));
            const auto light = sample_lppv_atlas(atlas.texture(), atlas.constants(id), p);
            const glm::vec3 up(0, 1, 0);
            EXPECT_LE(
                glm::distance(sample_sh9(light, up), sample_sh9(pack_sh(lppv.irradiance[i]), up)),
                1e-4f);
        }
    }
}

TEST(LppvAtlas, ShowsEachObjectItsOwnVolume) {
    const ProbeVolume volume = make_volume();
    const auto grids = make_grids(40, 1);
    std::mt19937_64 engine(2);
    for (const auto quality : {LppvQuality::Low, LppvQuality::Normal, LppvQuality::Full}) {
        const bool is_full = quality == LppvQuality::Full;
        const auto layout = is_full ? LppvLayout::SevenSlabs : LppvLayout::FourSlabs;
        LppvAtlas atlas = make_atlas(grids, quality, layout);
        EXPECT_EQ(atlas.refresh(volume.view(), {}).refilled.size(), grids.size());
        for (uint32_t id = 0; id < grids.size(); ++id) {
            const Lppv lppv = *make_lppv(volume.view(), grids[id], {.quality = quality});
            const LppvAtlasConstants constants = atlas.constants(id);
            for (int i = 0; i < 20; ++i) {
                // Inside and far outside: what lies beside it in the atlas must not show.
                const float reach = i < 10 ? 0.2f : 20.0f;
                const glm::vec3 p = glm::vec3(grids[id].world_position({1, 1, 2})) +
                                    reach * test::random_direction(engine);
                const glm::vec3 n = test::random_direction(engine);
                const InterpolatedProbe expected = sample_lppv(lppv, p);
                const glm::vec3 light =
                    sample_sh9(sample_lppv_atlas(atlas.texture(), constants, p), n);
                ASSERT_LE(glm::distance(light * std::numbers::pi_v<float>,
                                        evaluate_irradiance(expected.irradiance, n)),
                          4e-4f);
                if (is_full) continue;
                ASSERT_LE(glm::distance(sample_lppv_atlas_occlusion(atlas.texture(), constants, p),
                                        expected.occlusion),
                          4e-5f);
            }
        }
    }
}

TEST(LppvAtlas, SurroundsEachVolumeWithCopiesOfItsOuterTexels) {
    const ProbeVolume volume = make_volume();
    LppvAtlas atlas = make_atlas(make_grids(3, 1), LppvQuality::Low, LppvLayout::FourSlabs);
    atlas.refresh(volume.view(), {});
    const TexelBox box = atlas.texels(1);
    ASSERT_EQ(box.size, glm::uvec3(4, 5, 7));
    for (uint32_t slab = 0; slab < 4; ++slab) {
        for (uint32_t i = 0; i < 4 * 5 * 7; ++i) {
            const glm::uvec3 texel(i % 4, i / 4 % 5, i / 20);
            const glm::uvec3 inner = glm::clamp(texel, glm::uvec3(1), box.size - 2u);
            const glm::uvec3 offset = box.min + glm::uvec3(32 * slab, 0, 0);
            EXPECT_EQ(fetch_texel(atlas.texture(), offset + texel),
                      fetch_texel(atlas.texture(), offset + inner));
        }
    }
}

TEST(LppvAtlas, RefillsOnlyWhatMoved) {
    const ProbeVolume volume = make_volume();
    const auto grids = make_grids(40, 1);
    LppvAtlas atlas = make_atlas(grids, LppvQuality::Normal, LppvLayout::FourSlabs);
    atlas.refresh(volume.view(), {});
    EXPECT_TRUE(atlas.refresh(volume.view(), {}).refilled.empty());
    const auto elsewhere = make_grids(40, 9);
    atlas.move(7, elsewhere[7]);
    atlas.move(3, elsewhere[3]);
    atlas.move(5, grids[5]);  // where it was
    const LppvAtlasReport report = atlas.refresh(volume.view(), {});
    EXPECT_EQ(report.refilled, (Refilled{3, 7}));
    EXPECT_EQ(report.point_count, 2u * 30u);
}

TEST(LppvAtlas, InvalidPointsTakeTheLightOfTheNearestValidOne) {
    const ProbeVolume volume = make_volume();
    const LppvGrid grid = make_grids(1, 1)[0];
    std::vector<float> validity(grid.point_count(), 1.0f);
    LppvAtlas atlas({.slab_size = {8, 8, 8}});
    const uint32_t id = *atlas.add(grid, LppvQuality::Full, LppvRefresh::Automatic, validity);
    atlas.refresh(volume.view(), {});
    const auto texel = [&](uint32_t z) {
        return fetch_texel(atlas.texture(), atlas.texels(id).min + glm::uvec3(1, 1, 1 + z));
    };
    const glm::vec4 first = texel(0), second = texel(1);
    EXPECT_NE(first, second);
    validity[0] = 0.25f;
    validity[2] = 0.0f;  // the next along y: now the nearest is the next along z
    atlas.move(id, grid, validity);
    EXPECT_EQ(atlas.refresh(volume.view(), {}).refilled, (Refilled{id}));
    EXPECT_EQ(texel(0), second);
    atlas.move(id, grid, validity);
    EXPECT_TRUE(atlas.refresh(volume.view(), {}).refilled.empty());
    validity.pop_back();
    EXPECT_FALSE(atlas.add(grid, LppvQuality::Full, LppvRefresh::Automatic, validity));
}

/// Everything that a volume's group c lights differently afterwards.
std::vector<uint32_t> relight_last_group(ProbeVolume& volume) {
    const std::vector<uint32_t> group{2};
    const auto probes = probes_of_groups(volume.view(), group);
    for (const uint32_t probe : probes) volume.irradiance[probe] *= 2.0f;
    return probes;
}

TEST(LppvAtlas, RefillsWhatLiesAmongChangedProbesToTheSameBytesAsAFullRefresh) {
    // Three groups, each in a part of space of its own.
    auto positions = test::random_positions(900, 3);
    std::ranges::sort(positions, {}, [](const glm::dvec3& p) { return p.x; });
    ProbeVolume volume = test::make_random_volume(positions, 4);
    auto grids = make_grids(60, 1);
    LppvAtlas atlas = make_atlas(grids, LppvQuality::Normal, LppvLayout::FourSlabs);
    atlas.refresh(volume.view(), {});
    const LppvTexture before = atlas.texture();

    const auto elsewhere = make_grids(60, 9);
    for (uint32_t id = 0; id < 6; ++id) {
        grids[id] = elsewhere[id];
        atlas.move(id, grids[id]);
    }
    const auto changed = relight_last_group(volume);
    ASSERT_EQ(changed.size(), 300u);
    const LppvAtlasReport report = atlas.refresh(volume.view(), {.probes = changed});

    LppvAtlas full = make_atlas(grids, LppvQuality::Normal, LppvLayout::FourSlabs);
    full.refresh(volume.view(), {});
    EXPECT_EQ(atlas.texture(), full.texture());
    EXPECT_NE(atlas.texture(), before);
    for (uint32_t id = 0; id < grids.size(); ++id) {
        EXPECT_EQ(atlas.constants(id), full.constants(id));
    }
    EXPECT_LT(report.refilled.size(), 45u);  // about a third and the six that moved
    EXPECT_GT(report.refilled.size(), 10u);
}

TEST(LppvAtlas, ManualVolumesWaitAndOthersNeverDo) {
    const ProbeVolume volume = make_volume();
    const auto grids = make_grids(3, 1);
    LppvAtlas atlas({.slab_size = {16, 16, 16}});
    EXPECT_EQ(*atlas.add(grids[0], LppvQuality::Low, LppvRefresh::Manual), 0u);
    EXPECT_EQ(*atlas.add(grids[1], LppvQuality::Low, LppvRefresh::EveryFrame), 1u);
    EXPECT_EQ(*atlas.add(grids[2], LppvQuality::Low, LppvRefresh::Automatic), 2u);
    EXPECT_EQ(atlas.refresh(volume.view(), {}).refilled, (Refilled{0, 1, 2}));
    EXPECT_EQ(atlas.refresh(volume.view(), {}).refilled, (Refilled{1}));
    const LppvAtlasConstants before = atlas.constants(0);
    atlas.move(0, grids[1]);
    EXPECT_EQ(atlas.refresh(volume.view(), {.is_everything = true}).refilled, (Refilled{1, 2}));
    EXPECT_EQ(atlas.constants(0), before);  // it still shows where it was filled
    atlas.mark(0);
    EXPECT_EQ(atlas.refresh(volume.view(), {}).refilled, (Refilled{0, 1}));
    EXPECT_NE(atlas.constants(0), before);
}

TEST(LppvAtlas, GivesTheSameBytesOnAnyThreads) {
    const ProbeVolume volume = make_volume();
    const auto grids = make_grids(300, 1);
    LppvAtlasSettings settings{.slab_size = {64, 64, 32}, .layout = LppvLayout::SevenSlabs};
    LppvAtlas one(settings), many(settings);
    for (const LppvGrid& grid : grids) {
        ASSERT_TRUE(one.add(grid, LppvQuality::Full, LppvRefresh::Automatic));
        ASSERT_TRUE(many.add(grid, LppvQuality::Full, LppvRefresh::Automatic));
    }
    one.refresh(volume.view(), {});
    many.refresh(volume.view(), {}, [](size_t count, auto&& task) {
        EXPECT_GT(count, 1u);
        std::vector<std::jthread> workers;
        for (size_t i = count; i-- > 0;) workers.emplace_back([&task, i] { task(i); });
    });
    EXPECT_EQ(one.texture(), many.texture());
}

TEST(LppvAtlas, SaysWhenItIsFullAndUsesRoomAgain) {
    const LppvGrid grid = test::grid_in_box({6, 6, 6}, glm::dvec3(1.0), 0.0);
    LppvAtlas atlas({.slab_size = {16, 8, 8}});
    ASSERT_TRUE(atlas.add(grid, LppvQuality::Low, LppvRefresh::Automatic));
    const uint32_t second = *atlas.add(grid, LppvQuality::Low, LppvRefresh::Automatic);
    const auto third = atlas.add(grid, LppvQuality::Low, LppvRefresh::Automatic);
    ASSERT_FALSE(third);
    EXPECT_EQ(error_text(third.error()),
              "the atlas has no room for 8 x 8 x 8 texels; 1024 of 1024 are in use");
    atlas.remove(second);
    EXPECT_EQ(atlas.size(), 1u);
    EXPECT_EQ(*atlas.add(grid, LppvQuality::Low, LppvRefresh::Automatic), second);
}

TEST(LppvAtlas, FindsTheProbesOfGroups) {
    const ProbeVolume volume = make_volume();
    const std::vector<uint32_t> groups{0, 2};
    const auto probes = probes_of_groups(volume.view(), groups);
    EXPECT_EQ(probes.size(), 600u);
    EXPECT_TRUE(std::ranges::is_sorted(probes));
}

}  // namespace
}  // namespace tetralight
