// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/check_tetrahedra.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/detail/delaunay.h>
#include "tests/support/random_probes.h"

namespace tetralight::detail {
namespace {

constexpr Cell kOneTetrahedron{{0, 1, 2, 3}, {kNoIndex, kNoIndex, kNoIndex, kNoIndex}};

const std::vector<glm::dvec3> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::string problem(const std::vector<Cell>& cells, std::span<const glm::dvec3> positions) {
    const auto result = check_tetrahedra(cells, positions);
    EXPECT_FALSE(result);
    return result ? "" : error_text(result.error());
}

/// Takes tetrahedra away; their neighbors have nothing there.
std::vector<Cell> without(std::vector<Cell> cells, uint32_t removed) {
    for (Cell& cell : cells) {
        for (uint32_t& neighbor : cell.neighbors) {
            if (neighbor == kNoIndex) continue;
            if (neighbor == removed)
                neighbor = kNoIndex;
            else if (neighbor > removed)
                --neighbor;
        }
    }
    cells.erase(cells.begin() + removed);
    return cells;
}

TEST(CheckTetrahedra, TakesWhatIsDelaunayInWhateverOrder) {
    const auto positions = test::random_positions(100, 1);
    const auto expected = tetrahedralize(positions);
    std::vector<Cell> cells = delaunay_tetrahedra(positions);
    for (Cell& cell : cells) {  // an even permutation
        std::rotate(cell.vertices.begin(), cell.vertices.begin() + 1, cell.vertices.begin() + 3);
        std::rotate(cell.neighbors.begin(), cell.neighbors.begin() + 1, cell.neighbors.begin() + 3);
    }
    const auto result = check_tetrahedra(cells, positions);
    ASSERT_TRUE(result) << error_text(result.error());
    EXPECT_EQ(*result, expected);
}

TEST(CheckTetrahedra, RefusesIndicesOutOfRange) {
    Cell cell = kOneTetrahedron;
    EXPECT_TRUE(check_tetrahedra({cell}, kCorners));
    cell.vertices[2] = 4;
    EXPECT_EQ(problem({cell}, kCorners), "tetrahedron 0: vertex 4 is out of range (4)");
    cell.vertices[2] = kNoIndex;
    EXPECT_EQ(problem({cell}, kCorners), "tetrahedron 0: vertex 4294967295 is out of range (4)");
    cell = kOneTetrahedron;
    cell.neighbors[1] = 1;
    EXPECT_EQ(problem({cell}, kCorners), "tetrahedron 0: neighbor 1 is out of range (1)");
}

TEST(CheckTetrahedra, RefusesNeighborsThatAreNone) {
    Cell cell = kOneTetrahedron;
    cell.neighbors[1] = 0;
    EXPECT_EQ(problem({cell}, kCorners), "tetrahedra 0 and 0 are not neighbors");
    std::vector<Cell> cells = delaunay_tetrahedra(test::random_positions(50, 2));
    std::swap(cells[7].neighbors[0], cells[7].neighbors[1]);
    problem(cells, test::random_positions(50, 2));
}

TEST(CheckTetrahedra, RefusesNoCells) {
    EXPECT_EQ(problem({}, kCorners), "left out 4 of 4 probes");
}

TEST(CheckTetrahedra, CountsPositionsThatAreLeftOut) {
    auto positions = kCorners;
    positions.insert(positions.end(), {{2, 2, 2}, {3, 3, 3}});
    EXPECT_EQ(problem({kOneTetrahedron}, positions), "left out 2 of 6 probes");
}

TEST(CheckTetrahedra, RefusesTetrahedraOfTheOtherOrientation) {
    Cell cell = kOneTetrahedron;
    std::swap(cell.vertices[0], cell.vertices[1]);
    EXPECT_EQ(problem({cell}, kCorners), "1 cell is inverted or has no volume");
}

TEST(CheckTetrahedra, RefusesAFlatTetrahedron) {
    auto positions = kCorners;
    positions[3] = {0.3, 0.3, 0.0};
    EXPECT_EQ(problem({kOneTetrahedron}, positions), "1 cell is inverted or has no volume");
}

TEST(CheckTetrahedra, RefusesWhatIsNotDelaunay) {
    const auto positions = test::random_positions(60, 3);
    const std::vector<Cell> cells = delaunay_tetrahedra(positions);
    auto moved = positions;
    moved[5] = glm::mix(positions[5], positions[6], 0.9);
    problem(cells, moved);
}

TEST(CheckTetrahedra, RefusesAHullWithADentAndACellMissingInside) {
    const auto positions = test::random_positions(200, 4);
    const std::vector<Cell> cells = delaunay_tetrahedra(positions);
    for (uint32_t i = 0; i < cells.size(); ++i) problem(without(cells, i), positions);
}

TEST(CheckTetrahedra, RefusesTwoTetrahedraThatDoNotMeet) {
    auto positions = kCorners;
    for (const glm::dvec3& p : kCorners) positions.push_back(p + glm::dvec3(5.0));
    Cell other = kOneTetrahedron;
    for (uint32_t& vertex : other.vertices) vertex += 4;
    EXPECT_EQ(problem({kOneTetrahedron, other}, positions), "the hull is not closed");
    for (uint32_t& vertex : other.vertices) vertex -= vertex < 6 ? 4 : 0;
    problem({kOneTetrahedron, other}, positions);  // they share an edge
}

TEST(CheckTetrahedra, RefusesASlit) {
    const auto positions = test::random_positions(50, 5);
    const std::vector<Cell> whole = delaunay_tetrahedra(positions);
    for (uint32_t i = 0; i < whole.size(); ++i) {
        for (const uint32_t neighbor : whole[i].neighbors) {
            if (neighbor == kNoIndex) continue;
            std::vector<Cell> cells = whole;
            std::ranges::replace(cells[i].neighbors, neighbor, kNoIndex);
            std::ranges::replace(cells[neighbor].neighbors, i, kNoIndex);
            problem(cells, positions);
        }
    }
}

TEST(CheckTetrahedra, RefusesEveryWrongNumber) {
    const auto positions = test::random_positions(30, 6);
    const std::vector<Cell> whole = delaunay_tetrahedra(positions);
    const auto count = static_cast<uint32_t>(whole.size());
    std::mt19937_64 engine(7);
    for (int i = 0; i < 20'000; ++i) {
        std::vector<Cell> cells = whole;
        Cell& cell = cells[engine() % count];
        const bool is_vertex = engine() % 2 == 0;
        uint32_t& number = (is_vertex ? cell.vertices : cell.neighbors)[engine() % 4];
        const uint32_t before = number;
        number = static_cast<uint32_t>(engine() % (is_vertex ? 31 : count + 1));
        if (number == count) number = kNoIndex;
        if (number != before) problem(cells, positions);
    }
}

}  // namespace
}  // namespace tetralight::detail
