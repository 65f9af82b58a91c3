// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/cut_world.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <set>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/walk_reach.h>
#include "tests/support/cut_worlds.h"
#include "tests/support/probe_families.h"
#include "tests/support/random_walls.h"

namespace tetralight {
namespace {

using test::as_floats;
using test::expect_same_answers;

/// A volume, its world in a folder, and all tiles of it.
struct WholeAndWorld {
    ProbeVolume volume;
    TempFolder folder;
    std::shared_ptr<const WorldTiles> tiles;

    WholeAndWorld(ProbeVolume whole, double tile_size) : volume(std::move(whole)) {
        test::write_world(folder, volume.view(), {.tile_size = glm::dvec3(tile_size)});
        tiles = test::open_all(folder);
    }

    void expect_same(const std::vector<glm::vec3>& positions,
                     const OutsideHull& outside = {}) const {
        ASSERT_TRUE(tiles);
        expect_same_answers(volume.view(), *tiles, positions, outside);
    }
};

TEST(CutWorld, AnswersAreThoseOfTheVolume) {
    const WholeAndWorld world(test::make_lit_volume(test::random_positions(4000, 1)), 0.5);
    EXPECT_EQ(world.tiles->index().tiles.size(), 4u * 4 * 4 + 1);
    world.expect_same(as_floats(test::random_positions(20000, 2)));
    world.expect_same(test::meeting_positions(world.volume, 3));
}

TEST(CutWorld, AnswersOutsideAreThoseOfTheVolume) {
    const WholeAndWorld world(test::make_lit_volume(test::random_positions(3000, 1)), 0.5);
    for (const double scale : {1.1, 2.0, 100.0, 1e7}) {
        world.expect_same(as_floats(test::random_positions(3000, 3, scale)));
    }
    for (const OutsidePolicy policy : {OutsidePolicy::Clamp, OutsidePolicy::Ambient}) {
        world.expect_same(as_floats(test::random_positions(3000, 4, 1.3)), {policy, 2.0f});
    }
}

TEST(CutWorld, AnswersOfALatticeAreThoseOfTheVolume) {
    // Every vertex has many cells around it, and eight probes of each cube lie on one sphere.
    const WholeAndWorld world(test::make_lit_volume(test::lattice(13, 0.0, 1)), 4.0);
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 51 * 51 * 51; i += 7) {
        positions.push_back(glm::vec3(i % 51, i / 51 % 51, i / 51 / 51) * 0.25f);
    }
    world.expect_same(positions);
    world.expect_same(test::meeting_positions(world.volume));
}

TEST(CutWorld, AnswersOfAllFamiliesAreThoseOfTheVolume) {
    for (const test::ProbeFamily& family : test::probe_families()) {
        SCOPED_TRACE(family.name);
        ProbeVolume volume = test::make_lit_volume(family.make(1));
        if (volume.info.dimension != Dimension::Space) continue;
        auto box = Box<glm::dvec3>::empty();
        for (const glm::dvec3& p : volume.exact_positions) box = union_of(box, p);
        const glm::dvec3 size = box.size();
        const double longest = std::max({size.x, size.y, size.z});
        std::vector<glm::vec3> positions;
        for (const glm::dvec3& p : test::random_positions(2000, 2)) {
            positions.emplace_back(box.center() + 0.52 * p * size);
        }
        const WholeAndWorld world(std::move(volume), 0.3 * longest);
        world.expect_same(positions);
    }
}

TEST(CutWorld, AnswersThroughWallsAreThoseOfTheVolume) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(1500, 12));
    test::add_random_walls(volume, 1);
    make_compact_probes(volume);
    const WholeAndWorld world(std::move(volume), 0.8);
    const auto positions = as_floats(test::random_positions(5000, 13, 1.05));
    world.expect_same(positions);
    expect_same_answers(world.volume.view(), *world.tiles, positions, {},
                        {.walls = Walls::HideProbes, .radius = 0.2f});
}

TEST(CutWorld, PositionsOnBordersOfTilesHaveTheAnswersOfTheVolume) {
    const WholeAndWorld world(test::make_lit_volume(test::lattice(9, 0.1, 5)), 2.0);
    const WorldIndexView index = world.tiles->index();
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : test::random_positions(3000, 6, 4.0)) {
        const double border = index.borders[positions.size() % 3] + index.info.world_origin.x;
        positions.emplace_back(border, p.y + 4.0, p.z + 4.0);
    }
    world.expect_same(positions);
}

TEST(CutWorld, TilesHoldEveryTetrahedronThatTouchesTheirBox) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(1500, 7));
    auto cutter = WorldCutter::make(volume.view(), {.tile_size = glm::dvec3(0.7)});
    ASSERT_TRUE(cutter);
    for (uint32_t tile = 0; tile + 1 < cutter->tile_count(); ++tile) {
        const CutTile cut = cutter->cut(tile);
        const std::set<uint32_t> held(cut.cells.begin(), cut.cells.end());
        const Box<glm::dvec3> box = tile_box(cutter->index().view(), tile);
        for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
            // Twenty positions of each tetrahedron.
            const auto& vertices = volume.cells[cell].vertices;
            for (int i = 0; i < 20; ++i) {
                const glm::dvec4 w(1 + i % 3, 1 + i % 4, 1 + i % 5, i % 2);
                glm::dvec3 position(0.0);
                for (int k = 0; k < 4; ++k) {
                    position += w[k] / (w.x + w.y + w.z + w.w) *
                                glm::dvec3(volume.positions[vertices[static_cast<size_t>(k)]]);
                }
                if (contains(box, position)) {
                    ASSERT_TRUE(held.contains(cell)) << tile << " " << cell;
                }
            }
        }
    }
}

TEST(CutWorld, TilesHoldFewCellsMoreThanTouchThem) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(20000, 8));
    auto cutter = WorldCutter::make(volume.view(), {.tile_size = glm::dvec3(1.0)});
    ASSERT_TRUE(cutter);
    for (uint32_t tile = 0; tile + 1 < cutter->tile_count(); ++tile) {
        const Box<glm::dvec3> box = tile_box(cutter->index().view(), tile);
        uint32_t touching = 0;
        for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
            touching += may_touch(volume.view(), cell, box);
        }
        EXPECT_LT(cutter->cut(tile).entry.inner_cell_count, 1.25 * touching);
    }
}

TEST(CutWorld, TilesHaveWhatTheVolumeHoldsForTheirProbes) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(800, 9));
    for (uint32_t i = 0; i < volume.positions.size(); ++i) {
        volume.validity.push_back(static_cast<float>(i % 7) / 7.0f);
        volume.occlusion.emplace_back(0.5f, 0.25f, 1.0f, static_cast<float>(i % 3) / 3.0f);
        volume.rendering_layers.push_back(1u + i % 5);
    }
    auto cutter = WorldCutter::make(volume.view(), {.tile_size = glm::dvec3(1.0)});
    ASSERT_TRUE(cutter);
    const CutTile cut = cutter->cut(3);
    ASSERT_EQ(cut.probes.size(), cut.volume.positions.size());
    for (size_t i = 0; i < cut.probes.size(); ++i) {
        const uint32_t probe = cut.probes[i];
        ASSERT_EQ(cut.volume.positions[i], volume.positions[probe]);
        ASSERT_EQ(cut.volume.irradiance[i], volume.irradiance[probe]);
        ASSERT_EQ(cut.volume.validity[i], volume.validity[probe]);
        ASSERT_EQ(cut.volume.occlusion[i], volume.occlusion[probe]);
        ASSERT_EQ(cut.volume.rendering_layers[i], volume.rendering_layers[probe]);
        ASSERT_EQ(cut.volume.exact_positions[i], volume.exact_positions[probe]);
    }
    EXPECT_EQ(cut.volume.sources.size(), cut.probes.size());
    EXPECT_EQ(cut.volume.group_names, volume.group_names);
    EXPECT_EQ(cut.volume.info.world_origin, volume.info.world_origin);
    EXPECT_EQ(cut.volume.info.extent, volume.info.extent);
}

TEST(CutWorld, OneTileHoldsAllCells) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(500, 10));
    auto cutter = WorldCutter::make(volume.view(), {.tile_size = glm::dvec3(10.0)});
    ASSERT_TRUE(cutter);
    EXPECT_EQ(cutter->tile_count(), 2u);
    const CutTile cut = cutter->cut(0);
    EXPECT_EQ(cut.entry.inner_cell_count, volume.info.inner_cell_count);
    EXPECT_EQ(cut.entry.probe_count, volume.positions.size());
}

TEST(CutWorld, RefusesWhatCannotBeCut) {
    const ProbeVolume flat = test::make_lit_volume({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(WorldCutter::make(flat.view(), {}).error().field, "volume");
    ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 11));
    for (const double size : {0.0, -1.0, std::nan(""), 1e-4}) {
        const auto cutter = WorldCutter::make(volume.view(), {.tile_size = glm::dvec3(size)});
        ASSERT_FALSE(cutter) << size;
        EXPECT_EQ(cutter.error().field, "tile_size");
    }
    volume.seed_grid.clear();
    EXPECT_EQ(WorldCutter::make(volume.view(), {}).error().field, "volume");
}

}  // namespace
}  // namespace tetralight
