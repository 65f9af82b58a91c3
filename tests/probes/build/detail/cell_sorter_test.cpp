// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/cell_sorter.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tetralight::detail {
namespace {

std::array<uint64_t, 4> corners_of(const Cell& cell) {
    std::array<uint64_t, 4> corners;
    for (int i = 0; i < 4; ++i) corners[i] = make_corner(cell.vertices[i], cell.neighbors[i]);
    return corners;
}

bool is_even(const std::array<uint32_t, 4>& vertices) {
    int inversions = 0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) inversions += vertices[i] > vertices[j] ? 1 : 0;
    }
    return inversions % 2 == 0;
}

std::vector<Cell> sort(const std::vector<Cell>& cells, size_t vertex_count) {
    CellSorter sorter(vertex_count);
    for (const Cell& cell : cells) sorter.count(cell.vertices[0]);
    sorter.reserve_places(0);
    for (const Cell& cell : cells) sorter.add(cell);
    return sorter.finish();
}

TEST(MakeSortedCell, KeepsOrientationAndNeighborsOppositeTheirVertices) {
    std::array<uint32_t, 4> vertices{3, 5, 7, 9};
    do {
        const Cell cell{vertices, {vertices[0] + 10, vertices[1] + 10, vertices[2] + 10, kNoIndex}};
        const Cell sorted = make_sorted_cell(corners_of(cell), 4);
        const bool is_kept = is_even(vertices);
        EXPECT_EQ(sorted.vertices, (is_kept ? std::array<uint32_t, 4>{3, 5, 7, 9}
                                            : std::array<uint32_t, 4>{3, 5, 9, 7}));
        for (int i = 0; i < 4; ++i) {
            const bool was_last = sorted.vertices[i] == vertices[3];
            EXPECT_EQ(sorted.neighbors[i], was_last ? kNoIndex : sorted.vertices[i] + 10);
        }
    } while (std::next_permutation(vertices.begin(), vertices.end()));
}

TEST(MakeSortedCell, LeavesUnusedPlacesBehind) {
    const Cell triangle{{8, 2, 4, kNoIndex}, {1, kNoIndex, 0, kNoIndex}};
    const Cell sorted = make_sorted_cell(corners_of(triangle), 3);
    EXPECT_EQ(sorted, (Cell{{2, 4, 8, kNoIndex}, {kNoIndex, 0, 1, kNoIndex}}));
    const Cell segment{{8, 2, kNoIndex, kNoIndex}, {1, 0, kNoIndex, kNoIndex}};
    EXPECT_EQ(make_sorted_cell(corners_of(segment), 2), segment);
}

TEST(CellSorter, OrdersByVerticesAndRenamesNeighbors) {
    const std::vector<Cell> cells{{{1, 2, 3, 4}, {kNoIndex, kNoIndex, kNoIndex, 2}},
                                  {{0, 2, 5, 3}, {2, kNoIndex, kNoIndex, kNoIndex}},
                                  {{0, 1, 2, 3}, {0, 1, kNoIndex, kNoIndex}}};
    const std::vector<Cell> expected{{{0, 1, 2, 3}, {2, 1, kNoIndex, kNoIndex}},
                                     {{0, 2, 5, 3}, {0, kNoIndex, kNoIndex, kNoIndex}},
                                     {{1, 2, 3, 4}, {kNoIndex, kNoIndex, kNoIndex, 0}}};
    EXPECT_EQ(sort(cells, 6), expected);
}

TEST(CellSorter, SortsThousandsOfCellsAroundOneProbe) {
    std::vector<Cell> cells;
    for (uint32_t i = 0; i < 5000; ++i) {
        cells.push_back({{0, i + 1, i + 2, i + 3}, {kNoIndex, i, kNoIndex, kNoIndex}});
    }
    const std::vector<Cell> expected = cells;  // each is its own neighbor
    std::vector<Cell> shuffled = cells;
    std::ranges::shuffle(shuffled, std::mt19937_64(1));
    for (uint32_t i = 0; i < shuffled.size(); ++i) shuffled[i].neighbors[1] = i;
    EXPECT_EQ(sort(shuffled, 5003), expected);
}

TEST(CellSorter, OfNothingIsNothing) {
    EXPECT_TRUE(sort({}, 0).empty());
    EXPECT_TRUE(sort({}, 7).empty());
}

}  // namespace
}  // namespace tetralight::detail
