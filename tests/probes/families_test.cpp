// SPDX-License-Identifier: Apache-2.0
// What must hold for every set of probes, whatever its shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/probe_families.h"

namespace tetralight {
namespace {

class Families : public testing::TestWithParam<size_t> {
  protected:
    static constexpr uint64_t kSeeds = 3;

    /// Calls `check(volume, seed)` for some sets of the family.
    template <class Check>
    void for_each_volume(Check check) {
        const test::ProbeFamily family = test::probe_families()[GetParam()];
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            SCOPED_TRACE(family.name + " " + std::to_string(seed));
            check(test::make_lit_volume(family.make(seed)), seed);
        }
    }
};

/// Probes, middles of two to four neighbors, places near all these, and places around the hull.
std::vector<glm::vec3> adversarial_positions(const ProbeVolume& volume, uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::vector<glm::vec3> positions;
    const float extent = volume.info.extent;
    for (int i = 0; i < 500; ++i) {
        const Cell& cell = volume.cells[engine() % volume.cells.size()];
        const size_t corner_count = 1 + engine() % 4;
        glm::dvec3 sum(0.0);
        double count = 0.0;
        for (size_t k = 0; k < corner_count; ++k) {
            if (cell.vertices[k] == kNoIndex) continue;
            sum += glm::dvec3(volume.positions[cell.vertices[k]]);
            count += 1.0;
        }
        const glm::dvec3 middle = volume.info.world_origin + sum / count;
        positions.emplace_back(middle);
        positions.emplace_back(middle + 1e-6 * extent * glm::dvec3(test::random_direction(engine)));
        positions.emplace_back(middle + 3.0 * extent * glm::dvec3(test::random_direction(engine)));
        positions.emplace_back(middle + 1e4 * extent * glm::dvec3(test::random_direction(engine)));
    }
    return positions;
}

TEST_P(Families, AreSoundAndValid) {
    for_each_volume([](const ProbeVolume& volume, uint64_t) {
        const auto status = verify(volume.view());
        EXPECT_TRUE(status) << error_text(status.error());
        for (const std::string& problem : validate(volume.view()).problems()) {
            ADD_FAILURE() << problem;
        }
    });
}

TEST_P(Families, LoseNoProbe) {
    const test::ProbeFamily family = test::probe_families()[GetParam()];
    const std::vector<glm::dvec3> positions = family.make(1);
    const ProbeVolume volume = test::make_lit_volume(positions);
    ASSERT_EQ(volume.sources.size(), positions.size());
    double diagonal = 0.0;
    for (const glm::dvec3& p : positions)
        diagonal = std::max(diagonal, glm::distance(p, positions[0]));
    for (const ProbeSource& source : volume.sources) {
        const double moved =
            glm::distance(volume.exact_positions[source.probe], positions[source.index]);
        EXPECT_LE(moved, 1e-5 * diagonal);
    }
}

TEST_P(Families, AnswerEverywhereWithConvexWeights) {
    for_each_volume([](const ProbeVolume& volume, uint64_t seed) {
        uint32_t hint = kNoIndex;
        for (const glm::vec3& p : adversarial_positions(volume, seed)) {
            const CellLocation location = locate(volume.view(), p, hint);
            ASSERT_LT(location.cell, volume.cells.size());
            const glm::vec4 w = location.weights;
            EXPECT_GE(std::min({w.x, w.y, w.z, w.w}), 0.0f);
            EXPECT_NEAR(w.x + w.y + w.z + w.w, 1.0f, 1e-5f);
            hint = location.cell;
        }
    });
}

TEST_P(Families, AnswerTheSameWhereverTheWalkStarts) {
    for_each_volume([](const ProbeVolume& volume, uint64_t seed) {
        std::mt19937_64 engine(seed);
        const ProbeVolumeView view = volume.view();
        for (const glm::vec3& p : adversarial_positions(volume, seed + 100)) {
            const auto hint = static_cast<uint32_t>(engine() % volume.cells.size());
            const auto a = interpolate(view, locate(view, p)).irradiance;
            const auto b = interpolate(view, locate(view, p, hint)).irradiance;
            for (int k = 0; k < kShCoefficientCount; ++k) {
                const float size = 1.0f + glm::length(a.coefficients[k]);
                ASSERT_LE(glm::distance(a.coefficients[k], b.coefficients[k]), 1e-4f * size)
                    << p.x << " " << p.y << " " << p.z;
            }
        }
    });
}

TEST_P(Families, GiveWeightsThatRebuildThePositionInsideTheHull) {
    for_each_volume([](const ProbeVolume& volume, uint64_t seed) {
        if (volume.info.dimension != Dimension::Space) return;
        for (const glm::vec3& p : adversarial_positions(volume, seed + 200)) {
            const CellLocation location = locate(volume.view(), p);
            if (location.cell >= volume.info.inner_cell_count) continue;
            const glm::dvec3 local = glm::dvec3(p) - volume.info.world_origin;
            glm::dvec3 rebuilt(0.0);
            for (int i = 0; i < 4; ++i) {
                const uint32_t probe = volume.cells[location.cell].vertices[i];
                rebuilt +=
                    static_cast<double>(location.weights[i]) * glm::dvec3(volume.positions[probe]);
            }
            ASSERT_LE(glm::distance(rebuilt, local),
                      2e-6 * static_cast<double>(volume.info.extent));
        }
    });
}

INSTANTIATE_TEST_SUITE_P(
    All, Families, testing::Range<size_t>(0, test::probe_families().size()),
    [](const auto& instance) {
        std::string name = test::probe_families()[instance.param].name;
        std::ranges::replace_if(
            name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
        return name;
    });

}  // namespace
}  // namespace tetralight
