// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/locate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <tetralight/probes/interpolate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

glm::dvec3 blended_position(const ProbeVolume& volume, const CellLocation& location) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = volume.cells[location.cell].vertices[i];
        if (probe != kNoIndex) {
            sum += static_cast<double>(location.weights[i]) * glm::dvec3(volume.positions[probe]);
        }
    }
    return volume.info.world_origin + sum;
}

void expect_convex_weights(const CellLocation& location) {
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        EXPECT_GE(location.weights[i], 0.0f);
        sum += location.weights[i];
    }
    EXPECT_NEAR(sum, 1.0f, 1e-6f);
}

/// Whether a location says the position is in a tetrahedron, by an oracle that tests them all.
bool is_in_some_tetrahedron(const ProbeVolume& volume, const glm::dvec3& p) {
    for (uint32_t i = 0; i < volume.info.inner_cell_count; ++i) {
        const auto& v = volume.cells[i].vertices;
        bool is_inside = true;
        for (const auto& face : kOutwardFaces) {
            const glm::dvec3& a = volume.exact_positions[v[face[0]]];
            const glm::dvec3& b = volume.exact_positions[v[face[1]]];
            const glm::dvec3& c = volume.exact_positions[v[face[2]]];
            is_inside &= glm::dot(glm::cross(b - a, c - a), p - a) <= 0.0;
        }
        if (is_inside) return true;
    }
    return false;
}

TEST(Locate, WeightsReproduceEveryPositionInsideTheHull) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(500, 1));
    uint32_t hint = kNoIndex;
    for (const glm::dvec3& p : test::random_positions(5000, 2, 1.0)) {
        const CellLocation location = locate(volume.view(), glm::vec3(p), hint);
        expect_convex_weights(location);
        ASSERT_EQ(location.cell < volume.info.inner_cell_count, is_in_some_tetrahedron(volume, p));
        hint = location.cell;
        if (location.cell >= volume.info.inner_cell_count) continue;
        EXPECT_LT(glm::distance(blended_position(volume, location), p), 1e-6);
    }
}

TEST(Locate, FindsTheSameCellFromEveryHint) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(60, 3));
    const ProbeVolumeView view = volume.view();
    for (const glm::dvec3& p : test::random_positions(20, 4, 2.0)) {
        const CellLocation expected = locate(view, glm::vec3(p));
        for (uint32_t hint = 0; hint <= view.cells.size(); ++hint) {
            EXPECT_EQ(locate(view, glm::vec3(p), hint), expected);
        }
        EXPECT_EQ(locate(view, glm::vec3(p), kNoIndex - 1), expected);
    }
}

TEST(Locate, PositionOnAProbeIsThatProbe) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(200, 5));
    for (uint32_t probe = 0; probe < volume.positions.size(); ++probe) {
        const CellLocation location = locate(volume.view(), volume.positions[probe]);
        for (int i = 0; i < 4; ++i) {
            const bool is_it = volume.cells[location.cell].vertices[i] == probe;
            EXPECT_NEAR(location.weights[i], is_it ? 1.0f : 0.0f, 1e-6f);
        }
    }
}

TEST(Locate, BothCellsOfAFaceGiveTheSameAnswer) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 6));
    const ProbeVolumeView view = volume.view();
    for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
        for (int face = 0; face < 4; ++face) {
            glm::vec3 middle(0.0f);
            for (int i = 0; i < 4; ++i) {
                if (i != face) middle += volume.positions[volume.cells[cell].vertices[i]] / 3.0f;
            }
            const auto a = interpolate(view, locate(view, middle, cell));
            const auto b =
                interpolate(view, locate(view, middle, volume.cells[cell].neighbors[face]));
            for (int k = 0; k < kShCoefficientCount; ++k) {
                const glm::vec3 jump = a.irradiance.coefficients[k] - b.irradiance.coefficients[k];
                ASSERT_LT(glm::length(jump), 1e-5f) << "cell " << cell << " face " << face;
            }
        }
    }
}

TEST(Locate, HullCellsReachFarAwayWithConvexWeights) {
    for (const uint64_t seed : {7u, 8u, 9u}) {
        const ProbeVolume volume = test::make_lit_volume(test::random_positions(40, seed));
        std::mt19937_64 engine(seed);
        for (const float distance : {2.0f, 10.0f, 1e3f, 1e5f, 1e8f, 1e18f}) {
            for (int i = 0; i < 200; ++i) {
                const auto location =
                    locate(volume.view(), distance * test::random_direction(engine));
                ASSERT_GE(location.cell, volume.info.inner_cell_count) << distance;
                expect_convex_weights(location);
            }
        }
    }
}

TEST(Locate, IsContinuousAcrossTheHullAndItsCells) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(40, 10));
    const ProbeVolumeView view = volume.view();
    std::mt19937_64 engine(11);
    for (int path = 0; path < 20; ++path) {
        const glm::vec3 from = 3.0f * test::random_direction(engine);
        const glm::vec3 to = 3.0f * test::random_direction(engine);
        IrradianceSh previous = interpolate(view, locate(view, from)).irradiance;
        constexpr int kSteps = 20000;
        for (int step = 1; step <= kSteps; ++step) {
            const glm::vec3 p = glm::mix(from, to, static_cast<float>(step) / kSteps);
            const IrradianceSh here = interpolate(view, locate(view, p)).irradiance;
            // The field changes by at most a few units a metre; a jump would not shrink with steps.
            ASSERT_LT(glm::distance(here.coefficients[0], previous.coefficients[0]), 0.02f) << step;
            previous = here;
        }
    }
}

TEST(Locate, NoPositionIsAmbient) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(10, 12));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(locate(volume.view(), {nan, 0, 0}), CellLocation{});
    EXPECT_EQ(locate(volume.view(), {0, infinity, 0}), CellLocation{});
    EXPECT_EQ(locate(ProbeVolume{}.view(), {0, 0, 0}), CellLocation{});
}

TEST(Locate, KeepsItsPrecisionFarFromTheWorldsOrigin) {
    std::vector<glm::dvec3> positions = test::random_positions(50, 13);
    for (glm::dvec3& p : positions) p += glm::dvec3(1e5, -2e5, 3e5);
    const ProbeVolume volume = test::make_lit_volume(positions);
    const glm::vec3 query(glm::dvec3(1e5, -2e5, 3e5));
    const CellLocation location = locate(volume.view(), query);
    ASSERT_LT(location.cell, volume.info.inner_cell_count);
    EXPECT_LT(glm::distance(blended_position(volume, location), glm::dvec3(query)), 1e-5);
}

TEST(Locate, TracesTheStepsOfTheWalk) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(500, 16));
    const ProbeVolumeView view = volume.view();
    for (const glm::dvec3& p : test::random_positions(200, 17, 1.5)) {
        const LocationTrace walk = trace_location(view, glm::vec3(p), 0);
        EXPECT_EQ(walk.location, locate(view, glm::vec3(p), 0));
        EXPECT_GE(walk.step_count, 1u);
        EXPECT_FALSE(walk.is_fallback);
        EXPECT_EQ(trace_location(view, glm::vec3(p), walk.location.cell).step_count, 1u);
    }
}

TEST(Locate, AWalkThatCannotGoOnSearchesAllCells) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(30, 18));
    volume.cells[0].vertices[0] = kNoIndex;
    EXPECT_FALSE(trace_location(volume.view(), {0, 0, 0}, 0).is_fallback);  // it is near
    volume.cells[0].neighbors.fill(kNoIndex);
    EXPECT_FALSE(trace_location(volume.view(), {0, 0, 0}, 0).is_fallback);  // the seed grid helps
    volume.seed_grid.clear();
    volume.seeds.clear();
    EXPECT_TRUE(trace_location(volume.view(), {0, 0, 0}, 0).is_fallback);
}

TEST(Locate, CorruptIndicesGiveTheAmbientResultOrAnotherCell) {
    const ProbeVolume sound = test::make_lit_volume(test::random_positions(30, 14));
    std::mt19937_64 engine(15);
    for (int trial = 0; trial < 2000; ++trial) {
        ProbeVolume volume = sound;
        Cell& cell = volume.cells[engine() % volume.cells.size()];
        const auto value = static_cast<uint32_t>(engine());
        (trial % 2 == 0 ? cell.vertices : cell.neighbors)[engine() % 4] = value;
        const auto location = locate(volume.view(), 0.9f * test::random_direction(engine));
        const auto light = interpolate(volume.view(), location);
        EXPECT_TRUE(std::isfinite(light.irradiance.coefficients[0].x));
    }
}

TEST(Locate, WalksAlongALineFromOneEndToTheOther) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 1000; ++i) positions.emplace_back(i, 2 * i, 0);
    const ProbeVolume volume = test::make_lit_volume(positions);
    const uint32_t last = locate(volume.view(), {998.5f, 1997.0f, 0.0f}).cell;
    const LocationTrace trace = trace_location(volume.view(), {0.5f, 1.0f, 0.0f}, last);
    EXPECT_FALSE(trace.is_fallback);
    EXPECT_EQ(trace.location, locate(volume.view(), {0.5f, 1.0f, 0.0f}));
}

}  // namespace
}  // namespace tetralight
