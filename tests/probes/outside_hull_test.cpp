// SPDX-License-Identifier: Apache-2.0
// What is answered beyond the hull, under each policy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <tetralight/probes/detail/hull_cell.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/probe_families.h"
#include "tests/support/property_volume.h"

namespace tetralight {
namespace {

constexpr OutsideHull kClamp{OutsidePolicy::Clamp};

/// A position as a volume sees it: in its plane, on its line.
glm::dvec3 flattened(const ProbeVolume& volume, const glm::dvec3& p) {
    const glm::dvec3 origin(volume.positions[0]);
    const glm::dvec3 along = glm::dot(p - origin, volume.info.axis) * volume.info.axis;
    if (volume.info.dimension == Dimension::Plane) return p - along;
    return volume.info.dimension == Dimension::Line ? origin + along : p;
}

glm::dvec3 blended_position(const ProbeVolume& volume, const CellLocation& location) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = volume.cells[location.cell].vertices[i];
        if (probe == kNoIndex) continue;
        sum += static_cast<double>(location.weights[i]) * glm::dvec3(volume.positions[probe]);
    }
    return sum;
}

float weight_sum(const CellLocation& location) {
    const glm::vec4& w = location.weights;
    return w.x + w.y + w.z + w.w + location.ambient;
}

class OutsideHullFamilies : public testing::TestWithParam<size_t> {
  protected:
    test::ProbeFamily family = test::probe_families()[GetParam()];
    ProbeVolume volume = test::make_lit_volume(family.make(1));
    double extent = static_cast<double>(volume.info.extent) + 1e-12;
    std::mt19937_64 engine{GetParam()};

    /// At 1e-3 to 10 extents around a probe.
    glm::vec3 random_position() {
        const auto& probe = volume.exact_positions[engine() % volume.exact_positions.size()];
        const double scale = std::pow(10.0, std::uniform_real_distribution(-3.0, 1.0)(engine));
        return glm::vec3(probe + scale * extent * glm::dvec3(test::random_direction(engine)));
    }
};

TEST_P(OutsideHullFamilies, NoWeightIsAZeroWithASign) {
    for (const OutsidePolicy policy : {OutsidePolicy::Clamp, OutsidePolicy::Ambient}) {
        for (int trial = 0; trial < 200; ++trial) {
            const auto weights =
                locate(volume.view(), random_position(), kNoIndex, {policy, 50.0f}).weights;
            for (int i = 0; i < 4; ++i) EXPECT_FALSE(std::signbit(weights[i])) << weights[i];
        }
    }
}

/// x is the point of a convex set that is closest to p if and only if (p − x)·(v − x) ≤ 0 for every
/// vertex v of the set (the variational inequality of projections).
TEST_P(OutsideHullFamilies, ClampGivesTheClosestPointOfTheHull) {
    for (int trial = 0; trial < 300; ++trial) {
        const glm::vec3 p = random_position();
        const CellLocation location = locate(volume.view(), p, kNoIndex, kClamp);
        EXPECT_NEAR(weight_sum(location), 1.0f, 1e-5f);
        if (location.cell < volume.info.inner_cell_count) continue;
        const glm::dvec3 x = flattened(volume, blended_position(volume, location));
        const glm::dvec3 to_p = flattened(volume, glm::dvec3(p) - volume.info.world_origin) - x;
        for (const glm::vec3& v : volume.positions) {
            const glm::dvec3 to_v = flattened(volume, glm::dvec3(v)) - x;
            ASSERT_LE(glm::dot(to_p, to_v), 1e-6 * extent * (glm::length(to_p) + extent))
                << family.name << " " << trial;
        }
    }
}

/// Halves the step of a path where the light changes most until it is one of floats: what is left
/// of the change there is a jump.
TEST_P(OutsideHullFamilies, EveryPolicyIsContinuousAlongPathsAcrossTheHull) {
    const OutsideHull fade{OutsidePolicy::Ambient, static_cast<float>(extent)};
    float brightest = 1.0f;
    for (const IrradianceSh& sh : volume.irradiance) {
        brightest = std::max(brightest, glm::length(sh.coefficients[0]));
    }
    // A position is known to a float's step of the world: the light fades by some of it.
    const double float_step = 0x1p-23 * (extent + glm::length(volume.info.world_origin));
    const double tolerance = brightest * (2e-4 + 4.0 * float_step / extent);
    for (const OutsideHull& outside : {OutsideHull{}, kClamp, fade}) {
        for (int path = 0; path < 10; ++path) {
            const glm::dvec3 from(random_position());
            const glm::dvec3 to = volume.exact_positions[engine() % volume.exact_positions.size()];
            const auto light_at = [&](double t) {
                const glm::vec3 p(glm::mix(from, to, t));
                const auto location = locate(volume.view(), p, kNoIndex, outside);
                return interpolate(volume.view(), location).irradiance.coefficients[0];
            };
            const auto change = [&](double t0, double t1) {
                return glm::distance(light_at(t0), light_at(t1));
            };
            constexpr int kSteps = 300;
            double low = 0.0;
            double width = 1.0 / kSteps;
            for (int step = 1; step < kSteps; ++step) {
                const double t = static_cast<double>(step) / kSteps;
                if (change(t, t + width) > change(low, low + width)) low = t;
            }
            while (width > 1e-12) {
                width /= 2.0;
                if (change(low + width, low + 2.0 * width) > change(low, low + width)) low += width;
            }
            EXPECT_LE(change(low, low + width), tolerance) << family.name << " " << path;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, OutsideHullFamilies,
                         testing::Range<size_t>(0, test::probe_families().size()));

/// Probes at the corners of the cube [0, 1]³.
ProbeVolume cube() {
    return test::make_lit_volume(test::lattice(2, 0.0, 0));
}

TEST(OutsideHull, AmbientFadesInLinearlyWithTheDistance) {
    ProbeVolume volume = cube();
    volume.info.ambient = test::linear_light({7, 8, 9});
    const OutsideHull fade{OutsidePolicy::Ambient, 4.0f};
    const IrradianceSh at_hull = test::linear_light({1.0, 0.3, 0.6});
    for (const float distance : {0.0f, 1.0f, 3.0f, 4.0f, 40.0f}) {
        const auto location = locate(volume.view(), {1.0f + distance, 0.3f, 0.6f}, kNoIndex, fade);
        const float share = std::min(1.0f, distance / 4.0f);
        EXPECT_NEAR(location.ambient, share, 1e-6f);
        const auto light = interpolate(volume.view(), location);
        for (int k = 0; k < kShCoefficientCount; ++k) {
            const glm::vec3 expected =
                glm::mix(at_hull.coefficients[k], volume.info.ambient.coefficients[k], share);
            EXPECT_LT(glm::distance(light.irradiance.coefficients[k], expected), 1e-5f);
        }
        EXPECT_FLOAT_EQ(light.occlusion.x, 1.0f);
    }
}

TEST(OutsideHull, OcclusionFadesToLit) {
    ProbeVolume volume = cube();
    volume.occlusion.assign(8, glm::vec4(0.0f));
    const OutsideHull fade{OutsidePolicy::Ambient, 2.0f};
    const auto location = locate(volume.view(), {0.5f, 2.0f, 0.5f}, kNoIndex, fade);
    EXPECT_NEAR(interpolate(volume.view(), location).occlusion.x, 0.5f, 1e-6f);
}

TEST(OutsideHull, InsideEveryPolicyIsTheSame) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(100, 1));
    for (const glm::dvec3& p : test::random_positions(500, 2, 0.5)) {
        const CellLocation location = locate(volume.view(), glm::vec3(p));
        ASSERT_LT(location.cell, volume.info.inner_cell_count);
        EXPECT_EQ(locate(volume.view(), glm::vec3(p), kNoIndex, kClamp), location);
    }
}

TEST(HullCell, OfCollinearCornersHoldsWhatTheyGrowInto) {
    // At t the corners are (∓1 ∓ 0.6 t, 0, 0.8 t) and (0, 0.6 t, 0.8 t).
    const std::array<glm::dvec3, 3> corners{{{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}}};
    const HullCellRays rays{{{{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}}}};
    const auto weights = [&](const glm::dvec3& query) {
        return detail::hull_cell_weights(detail::make_hull_triangle(corners, query), rays);
    };
    const auto inside = weights({0, 0.1, 1});  // t = 1.25, where the third corner is at y = 0.75
    ASSERT_TRUE(inside);
    EXPECT_NEAR(inside->z, 0.1 / 0.75, 1e-6);  // of rays in floats
    EXPECT_NEAR(inside->x, inside->y, 1e-12);
    const auto beyond = weights({0, -0.1, 1});
    ASSERT_TRUE(beyond);
    EXPECT_NEAR(beyond->z, -0.1 / 0.75, 1e-6);
}

TEST(HullCell, OfCollinearCornersOfATurnedLatticeIsNoGap) {
    std::vector<glm::dvec3> positions = test::lattice(3, 0.0, 10);
    positions.resize(21);
    const ProbeVolume volume = test::make_random_volume(test::turned(positions, 1.0), 10);
    for (const glm::vec3& p : {glm::vec3(2.35138416f, 2.13306379f, -0.659502506f),
                               glm::vec3(1.86248076f, 1.81753826f, -0.743337691f)}) {
        EXPECT_FALSE(trace_location(volume.view(), p).is_fallback);
    }
}

}  // namespace
}  // namespace tetralight
