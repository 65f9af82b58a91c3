// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/store_visibility.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <tetralight/probes/build/copy_light.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

/// One edge in `period` is blocked, the others are free.
std::vector<uint8_t> random_codes(size_t count, uint64_t seed, uint64_t period = 20) {
    std::mt19937_64 engine(seed);
    std::vector<uint8_t> codes(count, kFreeEdge);
    for (uint8_t& code : codes) {
        if (engine() % period == 0) code = static_cast<uint8_t>(kUnknownEdge + 1 + engine() % 188);
    }
    return codes;
}

ProbeVolume make_volume(const std::vector<glm::dvec3>& positions) {
    ProbeVolume volume = test::make_lit_volume(positions);
    const ProbeEdges edges(volume.view());
    store_visibility(edges, random_codes(edges.size(), 1, 2), volume);
    set_all_splits(volume, [](uint32_t from, uint32_t a, uint32_t b) {
        EXPECT_LT(a, b);
        return (from + 3 * a + 5 * b) % 2 == 0;
    });
    return volume;
}

TEST(ProbeEdges, AreThoseOfTheCells) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 2));
    const ProbeEdges edges(volume.view());
    size_t count = 0;
    for (uint32_t a = 0; a < 100; ++a) {
        EXPECT_EQ(edges.first(a), count);
        EXPECT_TRUE(std::ranges::is_sorted(edges.targets(a)));
        count += edges.targets(a).size();
        for (uint32_t b = 0; b < 100; ++b) {
            const bool is_edge = std::ranges::any_of(volume.cells, [&](const Cell& cell) {
                return a != b && std::ranges::count(cell.vertices, a) > 0 &&
                       std::ranges::count(cell.vertices, b) > 0;
            });
            EXPECT_EQ(edges.contains(a, b), is_edge);
            if (is_edge) {
                EXPECT_EQ(edges.targets(a)[edges.find(a, b) - edges.first(a)], b);
            }
        }
    }
    EXPECT_EQ(edges.size(), count);
}

TEST(StoreVisibility, GivesEachCellTheCodesOfItsEdges) {
    for (const glm::dvec3& extent : {glm::dvec3(1), glm::dvec3(1, 0, 1), glm::dvec3(1, 0, 0)}) {
        auto positions = test::random_positions(100, 3);
        for (glm::dvec3& position : positions) position *= extent;
        ProbeVolume volume = test::make_lit_volume(positions);
        const ProbeEdges edges(volume.view());
        const auto codes = random_codes(edges.size(), 4);
        store_visibility(edges, codes, volume);
        ASSERT_TRUE(verify(volume.view()));
        EXPECT_EQ(edge_codes(edges, volume.view()), codes);
        EXPECT_EQ(visibility_facts(volume.view()).torn_edges, 0u);
    }
}

TEST(StoreVisibility, StoresNothingInCellsWithFreeEdgesOnly) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 5));
    const ProbeEdges edges(volume.view());
    std::vector<uint8_t> codes(edges.size(), kFreeEdge);
    store_visibility(edges, codes, volume);
    EXPECT_TRUE(volume.cell_visibility.empty());
    EXPECT_EQ(visibility_facts(volume.view()), (VisibilityFacts{.edges = edges.size()}));
    const Cell& cell = volume.cells[7];
    codes[edges.find(cell.vertices[0], cell.vertices[1])] = 200;
    store_visibility(edges, codes, volume);
    const auto around = std::ranges::count_if(volume.cells, [&](const Cell& other) {
        return std::ranges::count(other.vertices, cell.vertices[0]) > 0 &&
               std::ranges::count(other.vertices, cell.vertices[1]) > 0;
    });
    EXPECT_EQ(static_cast<ptrdiff_t>(volume.cell_visibility.size()), around);
}

TEST(CopyVisibility, KeepsAllOfTheSameProbes) {
    const ProbeVolume from = make_volume(test::random_positions(100, 6));
    ProbeVolume to = test::make_lit_volume(test::random_positions(100, 6));
    copy_visibility(from.view(), to);
    EXPECT_EQ(to, from);
}

TEST(CopyVisibility, KnowsOldEdgesAndCountsNewOnes) {
    const auto positions = test::random_positions(100, 7);
    const ProbeVolume from = make_volume(positions);
    ProbeVolume to =
        test::make_lit_volume(std::vector<glm::dvec3>(positions.begin() + 10, positions.end()));
    copy_light(from.view(), to);
    ASSERT_TRUE(verify(to.view()));
    const ProbeEdges old_edges(from.view()), edges(to.view());
    const auto old_codes = edge_codes(old_edges, from.view()), codes = edge_codes(edges, to.view());
    const auto old_index = [&](uint32_t probe) {
        const auto place = std::ranges::find(from.exact_positions, to.exact_positions[probe]);
        return static_cast<uint32_t>(place - from.exact_positions.begin());
    };
    uint64_t unknown_count = 0;
    for (uint32_t a = 0; a < to.positions.size(); ++a) {
        for (const uint32_t b : edges.targets(a)) {
            const uint32_t old_a = old_index(a), old_b = old_index(b);
            const bool is_old = old_edges.contains(old_a, old_b);
            EXPECT_EQ(codes[edges.find(a, b)],
                      is_old ? old_codes[old_edges.find(old_a, old_b)] : kUnknownEdge);
            unknown_count += !is_old;
        }
    }
    EXPECT_GT(unknown_count, 0u);
    const VisibilityFacts facts = visibility_facts(to.view());
    EXPECT_EQ(facts.unknown_edges, unknown_count);
    EXPECT_EQ(facts.torn_edges + facts.torn_splits, 0u);
}

/// Of three probes that no old cell holds together it is not known.
TEST(CopyVisibility, KeepsTheSplitsOfOldFaces) {
    const auto positions = test::random_positions(100, 7);
    const ProbeVolume from = make_volume(positions);
    ProbeVolume to =
        test::make_lit_volume(std::vector<glm::dvec3>(positions.begin() + 3, positions.end()));
    copy_light(from.view(), to);
    const auto old_cell_of = [&](const Cell& cell) -> uint32_t {
        for (uint32_t old = 0; old < from.cells.size(); ++old) {
            const auto is_same = [&](int i) {
                const uint32_t a = cell.vertices[size_t(i)],
                               b = from.cells[old].vertices[size_t(i)];
                if (a == kNoIndex || b == kNoIndex) return a == b;
                return to.exact_positions[a] == from.exact_positions[b];
            };
            if (is_same(0) && is_same(1) && is_same(2) && is_same(3)) return old;
        }
        return kNoIndex;
    };
    int same_count = 0;
    for (uint32_t cell = 0; cell < to.cells.size(); ++cell) {
        const uint32_t old = old_cell_of(to.cells[cell]);
        if (old == kNoIndex || find_visibility(to.view(), cell) == kNoIndex) continue;
        EXPECT_EQ(to.cell_visibility[find_visibility(to.view(), cell)],
                  from.cell_visibility[find_visibility(from.view(), old)]);
        ++same_count;
    }
    EXPECT_GT(same_count, 50);
}

TEST(CopyVisibility, OfAVolumeThatKnowsNoWallsIsEmpty) {
    const auto positions = test::random_positions(50, 8);
    ProbeVolume to = make_volume(positions);
    copy_visibility(test::make_lit_volume(positions).view(), to);
    EXPECT_TRUE(to.visibility_blocks.empty());
    EXPECT_TRUE(to.cell_visibility.empty());
}

TEST(Validate, SeesEdgesWithDifferentCodesInTheirCells) {
    ProbeVolume volume = make_volume(test::random_positions(100, 9));
    EXPECT_EQ(validate(volume.view()).torn_edges, 0u);
    for (uint8_t& code : volume.cell_visibility[3].codes) {
        if (code <= kUnknownEdge) continue;
        --code;
        break;
    }
    const ValidationReport report = validate(volume.view());
    EXPECT_EQ(report.torn_edges, 1u);
    EXPECT_EQ(report.problems().size(), 1u);
}

TEST(Validate, SeesFacesThatAreSplitInOneOfTheirCells) {
    ProbeVolume volume = make_volume(test::random_positions(100, 9));
    for (CellVisibility& cell : volume.cell_visibility) {
        const uint32_t bits = split_bits(cell);
        if (bits == 0) continue;
        const uint32_t less = bits & (bits - 1);
        cell.splits = {static_cast<uint8_t>(less), static_cast<uint8_t>(less >> 8)};
        break;
    }
    EXPECT_EQ(visibility_facts(volume.view()).torn_splits, 1u);
    EXPECT_EQ(validate(volume.view()).torn_edges, 1u);
}

}  // namespace
}  // namespace tetralight
