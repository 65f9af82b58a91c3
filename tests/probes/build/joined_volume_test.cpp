// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/joined_volume.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <thread>
#include <tuple>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/probe_edges.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/seed_grid.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using Coordinates = std::array<double, 3>;
using std::chrono::microseconds;

Coordinates coordinates(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

/// The vertices of the cells that a walk from cell to cell finds.
std::set<std::vector<Coordinates>> cells_of(const ProbeVolumeView& volume) {
    std::set<std::vector<Coordinates>> result;
    if (volume.cells.empty()) return result;
    std::set<uint32_t> seen{0};
    std::vector<uint32_t> next{0};
    while (!next.empty()) {
        const uint32_t cell = next.back();
        next.pop_back();
        std::vector<Coordinates> vertices;
        for (const uint32_t vertex : volume.cells[cell].vertices) {
            if (vertex != kNoIndex) {
                vertices.push_back(coordinates(volume.exact_positions[vertex]));
            }
        }
        std::ranges::sort(vertices);
        result.insert(vertices);
        for (const uint32_t neighbor : volume.cells[cell].neighbors) {
            if (neighbor != kNoIndex && seen.insert(neighbor).second) next.push_back(neighbor);
        }
    }
    return result;
}

/// The light of the probes that cells have, by position.
std::map<Coordinates, std::array<float, 29>> light_of(const ProbeVolumeView& volume) {
    std::map<Coordinates, std::array<float, 29>> result;
    for (const Cell& cell : volume.cells) {
        for (const uint32_t probe : cell.vertices) {
            if (probe == kNoIndex) continue;
            auto& values = result[coordinates(volume.exact_positions[probe])];
            for (size_t k = 0; k < 27; ++k) {
                values[k] = volume.irradiance[probe].coefficients[k / 3][static_cast<int>(k % 3)];
            }
            values[27] = volume.validity.empty() ? 1.0f : volume.validity[probe];
            values[28] = volume.occlusion.empty() ? 1.0f : volume.occlusion[probe].x;
        }
    }
    return result;
}

/// What is known of walls, by the positions of cells' corners: codes of edges, and splits.
std::map<std::vector<Coordinates>, int> walls_of(const ProbeVolumeView& volume) {
    std::map<std::vector<Coordinates>, int> result;
    for (uint32_t index = 0; index < volume.cells.size(); ++index) {
        const uint32_t element = find_visibility(volume, index);
        if (element == kNoIndex) continue;
        const Cell& cell = volume.cells[index];
        const CellVisibility& visibility = volume.cell_visibility[element];
        std::vector<Coordinates> corners;
        for (const uint32_t probe : cell.vertices) {
            if (probe != kNoIndex) corners.push_back(coordinates(volume.exact_positions[probe]));
        }
        std::vector<Coordinates> name = corners;
        std::ranges::sort(name);
        for_each_edge(cell, [&](size_t i, size_t k) {
            std::vector<Coordinates> edge = name;
            edge.push_back(corners[i]);
            edge.push_back(corners[k]);
            result[edge] = visibility.codes[edge_place(i, k)];
        });
        for_each_blocked_pair(visibility, [&](size_t from, size_t a, size_t b) {
            std::vector<Coordinates> pair = name;
            pair.push_back(corners[from]);
            pair.push_back(std::min(corners[a], corners[b]));
            pair.push_back(std::max(corners[a], corners[b]));
            result[pair] = (split_bits(visibility) & split_bit(from, a, b)) != 0 ? 1 : 0;
        });
    }
    return result;
}

/// Walls at random, the same in all cells around an edge.
void add_walls(ProbeVolume& volume, uint64_t seed) {
    std::mt19937 random(static_cast<uint32_t>(seed));
    const ProbeEdges edges(volume.view());
    std::vector<uint8_t> codes(edges.size());
    for (uint8_t& code : codes) {
        code = static_cast<uint8_t>(random() % 4 == 0 ? random() % 256 : kFreeEdge);
    }
    store_visibility(edges, codes, volume);
    set_all_splits(volume, [](uint32_t from, uint32_t a, uint32_t b) {
        return (from * 7 + a * 3 + b) % 4 == 0;
    });
}

/// Steps until all is done; returns how many there were.
int finish(JoinedVolume& joined, std::chrono::nanoseconds budget = microseconds(100)) {
    int steps = 1;
    for (auto is_done = joined.step(budget); is_done && !*is_done; is_done = joined.step(budget)) {
        ++steps;
    }
    return steps;
}

void expect_as_if_made_at_once(const JoinedVolume& joined) {
    const ProbeVolumeView view = joined.view();
    const ProbeVolume expected = joined.canonical();
    EXPECT_EQ(view.info.dimension, expected.info.dimension);
    EXPECT_TRUE(cells_of(view) == cells_of(expected.view()));
    EXPECT_TRUE(light_of(view) == light_of(expected.view()));
    EXPECT_TRUE(walls_of(view) == walls_of(expected.view()));
    EXPECT_EQ(view.group_names, expected.group_names);
    // Searches begin at cells that are there.
    for (const glm::vec3& position : view.positions) {
        const uint64_t word = find_seed_word(view.seed_grid, position);
        EXPECT_LT(seed_cell(view.seed_grid, word, position), view.cells.size());
    }
    ASSERT_EQ(view.sources.size(), expected.sources.size());
    for (size_t i = 0; i < view.sources.size(); ++i) {
        const ProbeSource &ours = view.sources[i], &theirs = expected.sources[i];
        EXPECT_EQ(std::tie(ours.group, ours.index), std::tie(theirs.group, theirs.index));
        EXPECT_EQ(view.exact_positions[ours.probe], expected.exact_positions[theirs.probe]);
    }
    EXPECT_EQ(count_wrong_compact_probes(view), 0u);
    // The same light everywhere.
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-3.0f, 3.0f);
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 200; ++i) {
        const float x = uniform(random), y = uniform(random), z = uniform(random);
        positions.emplace_back(x, y, z);
    }
    std::vector<IrradianceSh> ours(positions.size()), theirs(positions.size());
    ASSERT_TRUE(interpolate(view, {.positions = positions, .irradiance = ours}));
    ASSERT_TRUE(interpolate(expected.view(), {.positions = positions, .irradiance = theirs}));
    for (size_t i = 0; i < positions.size(); ++i) {
        for (size_t k = 0; k < 9; ++k) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(ours[i].coefficients[k][c], theirs[i].coefficients[k][c], 2e-2f);
            }
        }
    }
}

ProbeVolume part_at(const glm::dvec3& place, size_t count, uint64_t seed) {
    auto positions = test::random_positions(count, seed);
    for (glm::dvec3& p : positions) p += place;
    ProbeVolume part = test::make_lit_volume(std::move(positions));
    make_compact_probes(part);
    return part;
}

TEST(JoinedVolume, IsAfterAnyHistoryAsIfMadeAtOnce) {
    std::map<std::string, ProbeVolume> parts;
    for (uint64_t i = 0; i < 8; ++i) {
        const glm::dvec3 place(0.7 * static_cast<double>(i % 3), 0.5 * static_cast<double>(i / 3),
                               0);
        parts.emplace(std::string(1, static_cast<char>('a' + i)),
                      part_at(place, 60 + 40 * i, i + 1));
    }
    // Two have probes of a third.
    for (const char* name : {"b", "c"}) {
        std::vector<glm::dvec3> positions = parts.at(name).exact_positions;
        const auto& others = parts.at("a").exact_positions;
        positions.insert(positions.end(), others.begin(), others.begin() + 30);
        parts[name] = test::make_lit_volume(std::move(positions));
        parts[name].validity.assign(parts[name].positions.size(), 0.25f);
    }
    for (const char* name : {"a", "c", "e"}) add_walls(parts[name], 1);
    parts["d"].occlusion.assign(parts["d"].positions.size(), glm::vec4(0.5f));

    JoinedVolume joined;
    std::set<std::string> there;
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        for (auto orders = 1 + random() % 3; orders > 0; --orders) {
            const auto& [name, part] = *std::next(parts.begin(), random() % parts.size());
            if (there.erase(name) != 0) {
                ASSERT_TRUE(joined.remove(name));
            } else {
                ASSERT_TRUE(joined.add(name, part.view()));
                there.insert(name);
            }
        }
        finish(joined);
        if (random() % 3 == 0) continue;  // more comes before it is committed
        joined.commit();
        expect_as_if_made_at_once(joined);
        if (HasFailure()) return;
    }
}

TEST(JoinedVolume, QueriesReadTheOldOneUntilItIsCommitted) {
    const ProbeVolume level = part_at(glm::dvec3(0.0), 3000, 1),
                      room = part_at(glm::dvec3(0.3), 500, 2);
    JoinedVolume joined;
    ASSERT_TRUE(joined.add("level", level.view()));
    finish(joined);
    joined.commit();
    const auto before = cells_of(joined.view());
    ASSERT_TRUE(joined.add("room", room.view()));
    int steps = 0;
    for (bool is_done = false; !is_done; ++steps) {
        is_done = *joined.step(microseconds(100));
        EXPECT_TRUE(cells_of(joined.view()) == before);
    }
    EXPECT_GT(steps, 3);
    joined.commit();
    EXPECT_FALSE(cells_of(joined.view()) == before);
    ASSERT_TRUE(joined.remove("room"));
    EXPECT_GT(finish(joined), 3);
    joined.commit();
    EXPECT_TRUE(cells_of(joined.view()) == before);
}

TEST(JoinedVolume, QueriesMayRunBesideSteps) {
    const ProbeVolume level = part_at(glm::dvec3(0.0), 2000, 8);
    const ProbeVolume room = part_at(glm::dvec3(0.3), 400, 9);
    JoinedVolume joined;
    ASSERT_TRUE(joined.add("level", level.view()));
    finish(joined);
    joined.commit();
    for (int round = 0; round < 4; ++round) {
        std::atomic<bool> is_over = false;
        std::thread asker([&] {
            const std::vector<glm::vec3> positions{{0.1f, 0.2f, 0.3f}, {0.9f, 0.5f, 0.4f}};
            std::vector<IrradianceSh> light(positions.size());
            while (!is_over) {
                if (!interpolate(joined.view(), {.positions = positions, .irradiance = light}))
                    break;
            }
        });
        EXPECT_TRUE(round % 2 == 0 ? joined.add("room", room.view()) : joined.remove("room"));
        finish(joined);
        is_over = true;
        asker.join();
        joined.commit();
    }
    expect_as_if_made_at_once(joined);
}

TEST(JoinedVolume, TakesFlatNearAndFarProbes) {
    std::vector<glm::dvec3> flat = test::random_positions(50, 3);
    for (glm::dvec3& p : flat) p.y = 0.0;
    std::vector<glm::dvec3> near = test::random_positions(50, 4);
    for (size_t i = 0; i < 10; ++i) near.push_back(near[i] + glm::dvec3(1e-7));
    const ProbeVolume plane = test::make_lit_volume(flat);
    const ProbeVolume cloud = part_at(glm::dvec3(0.0), 80, 5);
    // As near to those of the cloud as `merge` leaves none.
    auto moved = cloud.exact_positions;
    for (glm::dvec3& p : moved) p += glm::dvec3(1e-7);
    const ProbeVolume twin = test::make_lit_volume(moved);
    const ProbeVolume far = part_at(glm::dvec3(5e3), 40, 6);

    JoinedVolume joined;
    ASSERT_TRUE(joined.add("plane", plane.view()));
    finish(joined);
    joined.commit();
    EXPECT_EQ(joined.view().info.dimension, Dimension::Plane);
    expect_as_if_made_at_once(joined);
    for (const auto& [name, part] :
         {std::pair("cloud", &cloud), std::pair("far", &far), std::pair("twin", &twin)}) {
        ASSERT_TRUE(joined.add(name, part->view()));
        finish(joined);
        joined.commit();
        joined.commit();
        expect_as_if_made_at_once(joined);
    }
    for (const char* name : {"cloud", "far", "twin", "plane"}) {
        ASSERT_TRUE(joined.remove(name));
        finish(joined);
        joined.commit();
        joined.commit();
        expect_as_if_made_at_once(joined);
    }
    EXPECT_EQ(joined.view().probe_count(), 0u);
}

TEST(JoinedVolume, BeginsAnewAfterMemoryWasShort) {
    const ProbeVolume level = part_at(glm::dvec3(0.0), 300, 10);
    const ProbeVolume room = part_at(glm::dvec3(0.3), 100, 11);
    bool is_short = true;
    MemorySource memory;
    memory.context = &is_short;
    memory.resize = [](void* context, void* block, size_t byte_count) -> void* {
        if (byte_count > 0 && *static_cast<bool*>(context)) return nullptr;
        return MemorySource().resize(nullptr, block, byte_count);
    };
    JoinedVolume joined({}, memory);
    const auto fail_and_retry = [&] {
        const auto before = cells_of(joined.view());
        is_short = true;
        for (int i = 0; i < 2; ++i) {
            const auto step = joined.step(std::chrono::seconds(1));
            ASSERT_FALSE(step);
            EXPECT_EQ(step.error().code, ErrorCode::OutOfResources);
            joined.commit();
            EXPECT_TRUE(cells_of(joined.view()) == before);
        }
        is_short = false;
        finish(joined);
        joined.commit();
        expect_as_if_made_at_once(joined);
    };
    ASSERT_TRUE(joined.add("level", level.view()));
    fail_and_retry();
    EXPECT_EQ(joined.view().probe_count(), 300u);
    ASSERT_TRUE(joined.add("room", room.view()));
    fail_and_retry();
    EXPECT_EQ(joined.view().probe_count(), 400u);
}

TEST(JoinedVolume, RefusesNamesThatAreThereAndThoseThatAreNot) {
    const ProbeVolume part = part_at(glm::dvec3(0.0), 50, 7);
    JoinedVolume joined;
    ASSERT_TRUE(joined.add("a", part.view()));
    EXPECT_EQ(error_text(joined.add("a", part.view()).error()),
              "volume \"a\": there is one of this name");
    EXPECT_EQ(error_text(joined.remove("b").error()), "volume \"b\": there is no such volume");
    ASSERT_TRUE(joined.remove("a"));
    EXPECT_FALSE(joined.remove("a"));
    EXPECT_FALSE(joined.add("", part.view()));
    EXPECT_FALSE(joined.add("two\nlines", part.view()));
    EXPECT_FALSE(joined.add("\xff", part.view()));
    ProbeVolume floats = part;
    floats.exact_positions.clear();
    EXPECT_EQ(error_text(joined.add("b", floats.view()).error()),
              "volume \"b\": it has no exact positions");
    ProbeVolume bad = part;
    bad.exact_positions[3].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(joined.add("b", bad.view()));
    bad.exact_positions[3].x = 1e300;
    EXPECT_FALSE(joined.add("b", bad.view()));
    bad = part;
    bad.irradiance.pop_back();
    EXPECT_EQ(error_text(joined.add("b", bad.view()).error()),
              "volume \"b\": it has light of another number of probes");
}

}  // namespace
}  // namespace tetralight
