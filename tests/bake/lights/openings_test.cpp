// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lights/openings.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include <tetralight/bake/sampling/sobol.h>
#include <tetralight/bake/sampling/spherical_rectangle.h>
#include "tests/support/window_room.h"

namespace tetralight {
namespace {

constexpr uint32_t kCount = 1 << 14;

class OpeningsTest : public testing::Test {
  protected:
    OpeningsTest() : scene(test::window_room()) {
        sun.direction = glm::normalize(glm::vec3(0.25f, -1.0f, 1.0f));
        sun.intensity = glm::vec3(10.0f);
        openings = Openings(trace_scene, {window(), door()}, {sun});
    }

    [[nodiscard]] glm::vec3 at(const glm::dvec3& world) const {
        return trace_scene.render_from_world(world);
    }

    [[nodiscard]] Opening window() const {
        return {at(test::kWindow), test::kWindowAlong, test::kUp, {0, 0, 1}};
    }

    /// A rectangle in the wall at x = 2, which hides it from the room.
    [[nodiscard]] Opening door() const {
        return {at({2.1, 0, 0}), {0, 2, 0}, {0, 0, 1}, {-1, 0, 0}};
    }

    Scene scene;
    TraceScene trace_scene = *TraceScene::make_static(scene);
    Light sun;
    Openings openings;
};

double solid_angle(const Opening& opening, glm::vec3 position) {
    return SphericalRectangle(opening.corner, opening.along, opening.across, position)
        .solid_angle();
}

TEST_F(OpeningsTest, DirectionsPassAnOpeningWithTheirDensity) {
    // The mean of 1 / density is the solid angle of the directions that can be drawn.
    for (const glm::dvec3& world : {glm::dvec3(0.5, 1, 1), glm::dvec3(-1.8, 0.2, -1.5)}) {
        const glm::vec3 position = at(world);
        const Openings::Weights weights = openings.weights({position});
        ASSERT_GT(weights.openings[0], 0.0f);
        EXPECT_EQ(weights.openings[1], 0.0f) << "behind the wall";
        double sum = 0.0;
        for (uint32_t i = 0; i < kCount; ++i) {
            Sampler sampler(1, i);
            const float choice = sampler.next();
            const glm::vec3 direction =
                openings.sample_direction(weights, position, choice, sampler.next2());
            const float density = openings.direction_pdf(weights, position, direction);
            ASSERT_GT(density, 0.0f);
            EXPECT_NEAR(glm::length(direction), 1.0f, 1e-6f);
            sum += 1.0 / static_cast<double>(density);
        }
        EXPECT_NEAR(sum / kCount, solid_angle(openings.openings()[0], position),
                    2e-3 * sum / kCount);
    }
}

TEST_F(OpeningsTest, DensitiesOfDirectionsAreThoseOfAllOpenings) {
    // Two openings without walls between; each is drawn by its weight.
    const Opening second{at({-0.5, 1, -1.5}), {0.5f, 0, 0}, {0, 0.5f, 0}, {0, 0, 1}};
    const Openings both(trace_scene, {window(), second}, {});
    const glm::vec3 position = at({0.25, 1.25, 1.0});
    const Openings::Weights weights = both.weights({position});
    ASSERT_GT(weights.openings[1], 0.0f);
    uint32_t through_second = 0;
    double inverse = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        Sampler sampler(2, i);
        const float choice = sampler.next();
        const glm::vec3 direction =
            both.sample_direction(weights, position, choice, sampler.next2());
        inverse += 1.0 / static_cast<double>(both.direction_pdf(weights, position, direction));
        through_second += choice * weights.opening_sum >= weights.openings[0];
    }
    // From here the second covers a part of the first, so that the union is the window and the part
    // of the second that is beside it: none.
    EXPECT_NEAR(static_cast<float>(through_second) / kCount,
                weights.openings[1] / weights.opening_sum, 2e-3f);
    const double first_angle = solid_angle(window(), position);
    const double second_angle = solid_angle(second, position);
    EXPECT_LT(inverse / kCount, (first_angle + second_angle) * 1.001);
    EXPECT_GT(inverse / kCount, std::max(first_angle, second_angle) * 0.999);
}

TEST_F(OpeningsTest, NothingIsDrawnOnTheBrightSideBelowTheSurfaceAndFarAway) {
    EXPECT_EQ(openings.weights({at({0, 1.5, -3})}).openings[0], 0.0f);
    EXPECT_EQ(openings.weights({at({0, 1, 1.9}), {0, 0, 1}}).opening_sum, 0.0f);
    EXPECT_GT(openings.weights({at({0, 1, 1.9}), {0, 0, -1}}).opening_sum, 0.0f);
    EXPECT_EQ(openings.weights({at({0, 1.5, 100})}).opening_sum, 0.0f);
    EXPECT_EQ(openings.direction_pdf(openings.weights({at({0, 1, 0})}), at({0, 1, 0}), {0, 0, 1}),
              0.0f);
}

TEST_F(OpeningsTest, SpotIsWhereTheSunFallsThroughTheWindow) {
    // The sun falls 1 m for each metre along z, and a quarter along x.
    ASSERT_EQ(openings.spots().size(), 1u);
    const LitSpot& spot = openings.spots()[0];
    EXPECT_EQ(spot.opening, 0u);
    EXPECT_LT(glm::distance(spot.center, at({0.375, 0, -0.5})), 0.05f);
    EXPECT_NEAR(spot.radius, 0.5 * std::hypot(1.25, 1.0), 0.1);
    const glm::vec3 above = at({1, 1, 1});
    EXPECT_GT(openings.weights({above}).spots[0], 0.0f);
    EXPECT_EQ(openings.weights({at({1, 2, 5})}).spot_sum, 0.0f) << "behind a wall";
    EXPECT_EQ(openings.weights({above, {0, 1, 0}}).spot_sum, 0.0f) << "below the surface";
}

TEST_F(OpeningsTest, EntrancesHaveTheirDensityAcrossTheLight) {
    // The mean of 1 / density is the area of the window across the light.
    const Openings::Weights weights = openings.weights({at({1, 1, 1})});
    ASSERT_GT(weights.spot_sum, 0.0f);
    double sum = 0.0;
    for (uint32_t i = 0; i < kCount; ++i) {
        Sampler sampler(3, i);
        const float choice = sampler.next();
        const Openings::Entrance entrance =
            openings.sample_entrance(weights, choice, sampler.next2());
        EXPECT_EQ(entrance.light, 0u);
        const glm::vec3 lit = entrance.position + 0.5f * sun.direction;
        const float density = openings.entrance_density(weights, 0, lit, -sun.direction);
        ASSERT_GT(density, 0.0f);
        sum += 1.0 / static_cast<double>(density);
    }
    EXPECT_NEAR(sum / kCount, sun.direction.z, 1e-3);
    EXPECT_EQ(openings.entrance_density(weights, 0, at({1.5, 0, 1}), -sun.direction), 0.0f);
    EXPECT_EQ(openings.entrance_density(weights, 1, at({0.375, 0, -0.5}), -sun.direction), 0.0f);
}

TEST_F(OpeningsTest, MoreThanTheMaximumAreIgnored) {
    const Openings many(trace_scene, std::vector<Opening>(Openings::kMaxCount + 8, window()),
                        {sun, sun});
    EXPECT_EQ(many.openings().size(), Openings::kMaxCount);
    EXPECT_EQ(many.spots().size(), Openings::kMaxCount);
    const glm::vec3 position = at({0, 1, 0});
    const Openings::Weights weights = many.weights({position});
    EXPECT_NEAR(weights.opening_sum, 32.0f * weights.openings[31], 1e-4f * weights.opening_sum);
}

TEST_F(OpeningsTest, NoOpeningsAreEmpty) {
    EXPECT_TRUE(Openings().is_empty());
    EXPECT_TRUE(Openings(trace_scene, {}, {sun}).is_empty());
    EXPECT_FALSE(openings.is_empty());
}

}  // namespace
}  // namespace tetralight
