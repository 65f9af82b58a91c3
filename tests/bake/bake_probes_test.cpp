// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/bake_probes.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

BakeSettings few_samples(uint32_t thread_count = 0) {
    BakeSettings settings;
    settings.sample_count = 64;
    settings.thread_count = thread_count;
    return settings;
}

BakedProbes bake(const Scene& scene, const std::vector<glm::dvec3>& positions,
                 const BakeSettings& settings = few_samples()) {
    auto baked = bake_probes(scene, positions, settings);
    EXPECT_TRUE(baked) << error_text(baked.error());
    return std::move(*baked);
}

float validity_at(const Scene& scene, const glm::dvec3& position, uint32_t sample_count = 256) {
    BakeSettings settings;
    settings.sample_count = sample_count;
    return bake(scene, {position}, settings).validity[0];
}

/// A room with a lamp, a box that throws shadows and a glass panel: all that uses random numbers.
Scene busy_scene() {
    Scene scene;
    test::add_box(scene, test::diffuse({0.8f, 0.6f, 0.4f}), test::Facing::Inward, {-2, -2, -2},
                  {2, 2, 2});
    test::add_box(scene, test::diffuse({0.2f, 0.6f, 0.9f}, {0.1f, 0, 0}), test::Facing::Outward,
                  {-1, -2, -1}, {0, -1, 0});
    Material glass = test::diffuse(glm::vec3(0.3f));
    glass.base_color.a = 0.5f;
    glass.alpha_mode = AlphaMode::Blend;
    glass.is_double_sided = true;
    test::add_floor(scene, glass, 1.0f, 0.5f);
    test::add_point_light(scene, LightMode::Baked, {3, 2, 1}, {0.5f, 1.5f, 0.5f});
    return scene;
}

TEST(BakeProbes, SameBitsForAnyNumberOfThreadsAndEveryRun) {
    const Scene scene = busy_scene();
    const auto positions = test::random_positions(40, 1, 1.9);
    const BakedProbes one = bake(scene, positions, few_samples(1));
    const BakedProbes two = bake(scene, positions, few_samples(2));
    const BakedProbes again = bake(scene, positions, few_samples(2));
    EXPECT_EQ(one.radiance, two.radiance);
    EXPECT_EQ(one.validity, two.validity);
    EXPECT_EQ(one.standard_error, two.standard_error);
    EXPECT_EQ(one.ray_count, two.ray_count);
    EXPECT_EQ(two.radiance, again.radiance);
}

TEST(BakeProbes, OtherPositionsAndTheirOrderDoNotMatter) {
    const Scene scene = busy_scene();
    const auto positions = test::random_positions(20, 2, 1.9);
    const BakedProbes all = bake(scene, positions);
    for (size_t i = 0; i < positions.size(); ++i) {
        EXPECT_EQ(bake(scene, {positions[i]}).radiance[0], all.radiance[i]);
    }
    const BakedProbes reversed = bake(scene, {positions.rbegin(), positions.rend()});
    EXPECT_TRUE(std::equal(all.radiance.begin(), all.radiance.end(), reversed.radiance.rbegin()));
}

TEST(BakeProbes, SeedChangesTheNoise) {
    BakeSettings other = few_samples();
    other.seed = 1;
    const auto positions = test::random_positions(1, 3);
    EXPECT_NE(bake(busy_scene(), positions).radiance,
              bake(busy_scene(), positions, other).radiance);
}

TEST(BakeProbes, MinusZeroIsZero) {
    EXPECT_EQ(bake(busy_scene(), {{0.0, 0.5, 0.0}}).radiance,
              bake(busy_scene(), {{-0.0, 0.5, -0.0}}).radiance);
}

TEST(BakeProbes, InsideASolidValidityIsZeroAndItIsDark) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(1.0f), glm::vec3(9.0f)), test::Facing::Outward,
                  {-1, -1, -1}, {1, 1, 1});
    const BakedProbes baked = bake(scene, {{0, 0, 0}, {0.9, -0.9, 0.9}});
    EXPECT_EQ(baked.validity, (std::vector<float>{0.0f, 0.0f}));
    EXPECT_EQ(baked.radiance[0], RadianceSh{});
}

TEST(BakeProbes, OutsideASolidAndInTheOpenValidityIsOne) {
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(1.0f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    EXPECT_EQ(validity_at(scene, {0, 1.01, 0}), 1.0f);
    EXPECT_EQ(validity_at(Scene{}, {0, 0, 0}), 1.0f);
}

TEST(BakeProbes, ValidityIsReducedByTheFractionOfBackFaces) {
    // A square of half size 1 at distance 1 is one face of a cube around the probe: 1/6 of all
    // directions. 16384 even directions: the discrepancy is about 16384^(-3/4) = 7e-4.
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(1.0f)), 1.0f, 1.0f);
    EXPECT_NEAR(validity_at(scene, {0, 0, 0}, 16384), 5.0f / 6.0f, 2e-3f);
}

TEST(BakeProbes, DoubleSidedSurfacesDoNotLowerValidity) {
    Scene scene;
    Material material = test::diffuse(glm::vec3(1.0f));
    material.is_double_sided = true;
    test::add_box(scene, material, test::Facing::Outward, {-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(validity_at(scene, {0, 0, 0}), 1.0f);
}

TEST(BakeProbes, FarFromTheSceneAProbeSeesOnlySky) {
    Scene scene = busy_scene();
    scene.environment.radiance = {1, 2, 3};
    scene.lights.clear();
    const BakedProbes baked = bake(scene, {{1e7, 0, 0}, {0, -1e12, 1e12}});
    const float l0 = constant_radiance({1, 2, 3}).coefficients[0].y;
    for (const RadianceSh& light : baked.radiance) {
        EXPECT_NEAR(light.coefficients[0].y, l0, 1e-4f);
    }
    EXPECT_EQ(baked.validity, (std::vector<float>{1.0f, 1.0f}));
}

TEST(BakeProbes, MovingInstancesAreNotBaked) {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(1.0f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1})
        .contributes_gi = false;
    EXPECT_EQ(validity_at(scene, {0, 0, 0}), 1.0f);
}

TEST(BakeProbes, AmbientIsTheSkyAlone) {
    Scene scene = busy_scene();
    scene.environment.radiance = {1, 2, 3};
    EXPECT_EQ(bake(scene, {}).ambient, constant_radiance({1, 2, 3}));
}

TEST(BakeProbes, CallbackThatReturnsFalseCancels) {
    const auto positions = test::random_positions(200, 4);
    const auto baked = bake_probes(busy_scene(), positions, few_samples(),
                                   [](const BakeProgress&) { return false; });
    ASSERT_FALSE(baked);
    EXPECT_EQ(baked.error().code, ErrorCode::Cancelled);
}

TEST(BakeProbes, ProgressGrowsAndReachesTheTotal) {
    const auto positions = test::random_positions(200, 5);
    std::vector<BakeProgress> reports;
    std::atomic<int> callers = 0;
    const auto baked =
        bake_probes(busy_scene(), positions, few_samples(2), [&](const BakeProgress& progress) {
            EXPECT_EQ(++callers, 1);  // never two at a time
            reports.push_back(progress);
            --callers;
            return true;
        });
    ASSERT_TRUE(baked);
    for (size_t i = 1; i < reports.size(); ++i) {
        EXPECT_GE(reports[i].probes_done, reports[i - 1].probes_done);
    }
    ASSERT_FALSE(reports.empty());
    EXPECT_EQ(reports.back().probes_done, 200u);
    EXPECT_EQ(reports.back().probe_count, 200u);
    EXPECT_EQ(reports.back().ray_count, baked->ray_count);
}

TEST(BakeProbes, WithoutSurfacesEachSampleIsOneRay) {
    EXPECT_EQ(bake(Scene{}, {{0, 0, 0}, {1, 2, 3}}).ray_count, 128u);
}

TEST(BakeProbes, NoSamplesAreAnError) {
    BakeSettings settings;
    settings.sample_count = 0;
    const auto baked = bake_probes(Scene{}, {}, settings);
    ASSERT_FALSE(baked);
    EXPECT_EQ(error_text(baked.error()), "samples: must be at least 1");
}

TEST(BakeProbes, APositionThatIsNotFiniteIsAnErrorThatNamesTheProbe) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        const std::vector<glm::dvec3> positions = {{0, 0, 0}, {1, 2, 3}, {0, bad, 1}};
        const auto baked = bake_probes(Scene{}, positions, few_samples());
        ASSERT_FALSE(baked);
        const std::string& message = error_text(baked.error());
        EXPECT_EQ(message.find("probe 2: position is not finite (0, "), 0u) << message;
    }
}

TEST(BakeProbes, LightBeyondTheRangeOfFloatIsAnErrorThatNamesTheProbe) {
    Scene scene;
    test::add_point_light(scene, LightMode::Baked, glm::vec3(1e38f), {0, 0, 0});
    const std::vector<glm::dvec3> positions{{1e6, 0, 0}, {0.01, 0, 0}};
    const auto baked = bake_probes(scene, positions, {});
    ASSERT_FALSE(baked);
    EXPECT_TRUE(
        error_text(baked.error()).starts_with("probe 1 at (0.01, 0, 0): its light is too bright"))
        << error_text(baked.error());
}

TEST(BakeProbes, NamesALightWhoseIntensityIsNotANumber) {
    Scene scene;
    test::add_sun(scene, LightMode::Baked, {1, std::nanf(""), 1});
    const glm::dvec3 position(0.0);
    const auto baked = bake_probes(scene, std::span(&position, 1), {});
    ASSERT_FALSE(baked);
    EXPECT_EQ(error_text(baked.error()),
              "light 0 \"light\": intensity nan is negative or not finite");
}

}  // namespace
}  // namespace tetralight
