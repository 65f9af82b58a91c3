// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <vector>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/base/error_text.h>
#include "tests/support/window_room.h"

// A room whose light comes through one window.

namespace tetralight {
namespace {

using test::kUp;
using test::kWindow;
using test::kWindowAlong;
using test::wall_material;
using test::window_room;

constexpr double kBand0 = 0.28209479177387814;

enum class Outside { Sun, Sky };

void add_light(Scene& scene, Outside outside) {
    if (outside == Outside::Sky) {
        scene.environment.radiance = glm::vec3(1.0f);
        return;
    }
    test::add_sun(scene, LightMode::Mixed, glm::vec3(10.0f)).direction =
        glm::normalize(glm::vec3(0.25f, -1.0f, 1.0f));
}

const glm::dvec3 kProbe(0.75, 1.25, 0.5);

BakedProbes bake(const Scene& scene, const std::vector<glm::dvec3>& positions,
                 const BakeSettings& settings) {
    auto baked = bake_probes(scene, positions, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return std::move(*baked);
}

/// The light of one probe and its standard error.
struct Measured {
    double mean = 0.0, error = 0.0;
};

Measured light_at(const Scene& scene, uint64_t seed, const glm::dvec3& position = kProbe) {
    BakeSettings settings;
    settings.sample_count = 1 << 19;
    settings.seed = seed;
    const BakedProbes baked = bake(scene, {position}, settings);
    const double mean = baked.radiance[0].coefficients[0].g;
    return {mean, mean * static_cast<double>(baked.standard_error[0])};
}

/// Four standard errors, which themselves are known to a fifth.
void expect_ratio(const Measured& actual, const Measured& expected, double ratio) {
    const double error = std::hypot(actual.error, ratio * expected.error);
    EXPECT_NEAR(actual.mean, ratio * expected.mean, 5.0 * error);
    EXPECT_LT(error, 0.02 * actual.mean);
}

// All light comes through the window once: nothing outside sends it back.

TEST(WindowLight, PaneTransmitsItsFraction) {
    for (const Outside outside : {Outside::Sun, Outside::Sky}) {
        Scene open = window_room();
        add_light(open, outside);
        Scene glazed = open;
        Material pane = wall_material(glm::vec3(0.0f));
        pane.alpha_mode = AlphaMode::Blend;
        pane.base_color.a = 0.4f;
        test::add_quad(glazed, pane, kWindow, kWindowAlong, kUp);
        expect_ratio(light_at(glazed, 1), light_at(open, 2), 0.6);
    }
}

TEST(WindowLight, CutOutScreenTransmitsTheFractionOfItsHoles) {
    // Stripes of 1 cm, half of them holes.
    for (const Outside outside : {Outside::Sun, Outside::Sky}) {
        Scene open = window_room();
        add_light(open, outside);
        Scene screened = open;
        Texture stripes;
        stripes.image = {2, 1, {{0, 0, 0, 255}, {0, 0, 0, 0}}};
        screened.textures.push_back(stripes);
        Material screen = wall_material(glm::vec3(0.0f));
        screen.alpha_mode = AlphaMode::Mask;
        screen.base_color_texture.texture = 0;
        screen.base_color_texture.image_from_mesh[0][0] = 50.0f;
        test::add_quad(screened, screen, kWindow, kWindowAlong, kUp);
        expect_ratio(light_at(screened, 1), light_at(open, 2), 0.5);
    }
}

TEST(WindowLight, MetalFloorReflectsAsADiffuseOneOfItsDiffuseReflectivity) {
    // Half of the colour times the roughness.
    for (const Outside outside : {Outside::Sun, Outside::Sky}) {
        Scene metal = window_room();
        add_light(metal, outside);
        Scene matt = metal;
        Material& floor = metal.materials[metal.meshes[metal.instances[0].mesh].material];
        floor.base_color = glm::vec4(glm::vec3(0.8f), 1.0f);
        floor.metallic = 1.0f;
        floor.roughness = 0.1f;
        matt.materials[matt.meshes[matt.instances[0].mesh].material] =
            wall_material(glm::vec3(0.8f * 0.5f * 0.1f));
        expect_ratio(light_at(metal, 1), light_at(matt, 2), 1.0);
    }
}

TEST(WindowLight, IsTheSameTenKilometresAway) {
    const glm::dvec3 far(1e4, -1e4, 1e4);
    for (const Outside outside : {Outside::Sun, Outside::Sky}) {
        Scene here = window_room();
        add_light(here, outside);
        Scene there = here;
        for (MeshInstance& instance : there.instances) {
            instance.world_from_mesh = glm::translate(glm::dmat4(1.0), far);
        }
        expect_ratio(light_at(there, 1, kProbe + far), light_at(here, 2), 1.0);
    }
}

TEST(WindowLight, FurnaceWithAWindowHasRadianceOne) {
    // Walls emit what they absorb, and the sky has radiance 1.
    Scene scene = window_room(wall_material(glm::vec3(0.5f), glm::vec3(0.5f)));
    scene.environment.radiance = glm::vec3(1.0f);
    const auto traced = TraceScene::make_static(scene);
    ASSERT_TRUE(traced);
    const DirectionSet directions(256);
    // Light sampling alone has rare samples of great weight, next to emissive walls.
    for (const LightStrategy strategy : {LightStrategy::Mis, LightStrategy::BsdfOnly}) {
        SCOPED_TRACE(static_cast<int>(strategy));
        const PathTracer tracer(scene, *traced, {.strategy = strategy});
        double sum = 0.0, squares = 0.0;
        constexpr int kTrials = 64;
        for (int trial = 0; trial < kTrials; ++trial) {
            const uint64_t key = probe_key(static_cast<uint64_t>(trial), kProbe);
            const glm::vec3 origin = traced->render_from_world(kProbe);
            const RadianceSh light = estimate_probe(tracer, origin, key, directions).radiance;
            const double radiance = kBand0 * static_cast<double>(light.coefficients[0].g);
            sum += radiance / kTrials;
            squares += radiance * radiance / kTrials;
        }
        const double error = std::sqrt(std::max(0.0, squares - sum * sum) / (kTrials - 1));
        EXPECT_NEAR(sum, 1.0, 4.0 * error + 1e-5);
        EXPECT_LT(error, 0.005);
    }
}

/// The light of the probe with openings, or without, of the mean of some estimates.
Measured estimated(const Scene& scene, const LightPlan& plan, std::vector<Opening> openings,
                   const std::function<RadianceSh(const ProbeEstimate&)>& light_of) {
    const auto traced = TraceScene::make_static(scene);
    const PathTracer tracer(scene, *traced, {}, plan, std::move(openings));
    const DirectionSet directions(1024);
    double sum = 0.0, squares = 0.0;
    constexpr int kTrials = 64;
    for (int trial = 0; trial < kTrials; ++trial) {
        const uint64_t key = probe_key(static_cast<uint64_t>(trial), kProbe);
        const double light =
            light_of(estimate_probe(tracer, traced->render_from_world(kProbe), key, directions))
                .coefficients[0]
                .g;
        sum += light / kTrials;
        squares += light * light / kTrials;
    }
    return {sum, std::sqrt(std::max(0.0, squares - sum * sum) / (kTrials - 1))};
}

RadianceSh all_light(const ProbeEstimate& estimate) {
    return estimate.radiance;
}

std::vector<Opening> the_window(const Scene& scene) {
    const auto traced = TraceScene::make_static(scene);
    return {{traced->render_from_world(kWindow), kWindowAlong, kUp, {0, 0, 1}}};
}

TEST(WindowLight, IsTheSameWithLessNoiseIfTheWindowIsKnown) {
    for (const Outside outside : {Outside::Sun, Outside::Sky}) {
        Scene scene = window_room();
        add_light(scene, outside);
        const Measured known = estimated(scene, {}, the_window(scene), all_light);
        const Measured unknown = estimated(scene, {}, {}, all_light);
        expect_ratio(known, unknown, 1.0);
        EXPECT_LT(known.error, 0.7 * unknown.error) << static_cast<int>(outside);
    }
}

TEST(WindowLight, APaneInThePlaneOfAnOpeningCountsOnce) {
    // Light that enters at the opening is followed both ways from there.
    for (const Outside outside : {Outside::Sun, Outside::Sky}) {
        Scene scene = window_room();
        add_light(scene, outside);
        Material pane = wall_material(glm::vec3(0.3f));
        pane.alpha_mode = AlphaMode::Blend;
        pane.base_color.a = 0.3f;
        test::add_quad(scene, pane, kWindow, kWindowAlong, kUp);
        expect_ratio(estimated(scene, {}, the_window(scene), all_light),
                     estimated(scene, {}, {}, all_light), 1.0);
    }
}

TEST(WindowLight, LimitsOfBouncesAndLightIgnoreOpenings) {
    Scene scene = window_room();
    add_light(scene, Outside::Sun);
    const auto traced = TraceScene::make_static(scene);
    const DirectionSet directions(64);
    const glm::vec3 origin = traced->render_from_world(kProbe);
    for (const PathSettings& settings : {PathSettings{.bounces = 3}, PathSettings{.clamp = 1.0f},
                                         PathSettings{.strategy = LightStrategy::BsdfOnly}}) {
        const PathTracer with(scene, *traced, settings, {}, the_window(scene));
        const PathTracer without(scene, *traced, settings);
        EXPECT_TRUE(with.openings().is_empty());
        EXPECT_EQ(estimate_probe(with, origin, 1, directions).radiance,
                  estimate_probe(without, origin, 1, directions).radiance);
    }
}

TEST(WindowLight, LayersOfSunAndSkyAreTheirLight) {
    Scene sun = window_room(), sky = sun;
    add_light(sun, Outside::Sun);
    add_light(sky, Outside::Sky);
    Scene both = sun;
    add_light(both, Outside::Sky);
    LightPlan plan;
    plan.layer_count = 2;
    plan.layer_of_light = {0};
    plan.layer_of_sky = 1;
    for (const uint32_t layer : {0u, 1u}) {
        const auto layer_light = [layer](const ProbeEstimate& estimate) {
            RadianceSh light;
            light.coefficients[0].g = static_cast<float>(estimate.light_groups[layer * 27 + 1]);
            return light;
        };
        const Scene& alone = layer == 0 ? sun : sky;
        expect_ratio(estimated(both, plan, the_window(both), layer_light),
                     estimated(alone, {}, {}, all_light), 1.0);
    }
    const auto sum_of_layers = [](const ProbeEstimate& estimate) {
        RadianceSh rest = estimate.radiance;
        rest.coefficients[0].g -=
            static_cast<float>(estimate.light_groups[1] + estimate.light_groups[28]);
        EXPECT_NEAR(rest.coefficients[0].g, 0.0f, 1e-5f * estimate.radiance.coefficients[0].g);
        return rest;
    };
    estimated(both, plan, the_window(both), sum_of_layers);
}

TEST(WindowLight, ASealedRoomBesideItIsBlack) {
    for (const bool is_double_sided : {false, true}) {
        Scene scene = window_room();
        add_light(scene, Outside::Sun);
        add_light(scene, Outside::Sky);
        test::add_point_light(scene, LightMode::Baked, glm::vec3(50.0f), {1, 1, 1}).radius = 0.2f;
        Material dark = test::diffuse(glm::vec3(0.9f));
        dark.is_double_sided = is_double_sided;
        test::add_box(scene, dark, test::Facing::Inward, {2.01f, 0, -2}, {5, 3, 2});
        BakeSettings settings;
        settings.sample_count = 4096;
        for (const double x : {2.0101, 2.1, 3.0, 4.9999}) {
            EXPECT_EQ(bake(scene, {{x, 1.0, 0.5}}, settings).radiance[0], RadianceSh{}) << x;
        }
    }
}

TEST(WindowLight, SameBitsForAnyThreadsAndOtherPositions) {
    Scene scene = window_room();
    add_light(scene, Outside::Sun);
    add_light(scene, Outside::Sky);
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 24; ++i) {
        positions.emplace_back(-1.75 + 0.15 * i, 0.25 + 0.1 * i, 1.75 - 0.1 * i);
    }
    BakeSettings settings;
    settings.sample_count = 256;
    settings.thread_count = 1;
    const BakedProbes one = bake(scene, positions, settings);
    settings.thread_count = 2;
    const BakedProbes two = bake(scene, positions, settings);
    EXPECT_EQ(one.radiance, two.radiance);
    EXPECT_EQ(one.standard_error, two.standard_error);
    EXPECT_EQ(one.ray_count, two.ray_count);
    const BakedProbes reversed = bake(scene, {positions.rbegin(), positions.rend()}, settings);
    for (size_t i = 0; i < positions.size(); ++i) {
        EXPECT_EQ(reversed.radiance[positions.size() - 1 - i], one.radiance[i]) << i;
        EXPECT_EQ(bake(scene, {positions[i]}, settings).radiance[0], one.radiance[i]) << i;
    }
}

}  // namespace
}  // namespace tetralight
