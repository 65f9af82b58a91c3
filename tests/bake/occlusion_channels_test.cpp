// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/occlusion_channels.h>

#include <gtest/gtest.h>

#include <algorithm>

#include <tetralight/bake/lights/light_volume.h>

namespace tetralight {
namespace {

Light lamp(float x, float range, float power = 1.0f) {
    Light light;
    light.type = LightType::Point;
    light.position = {x, 0, 0};
    light.range = range;
    light.intensity = glm::vec3(power);
    return light;
}

Light spot(float x, glm::vec3 direction, float half_angle_cosine, float range) {
    Light light = lamp(x, range);
    light.type = LightType::Spot;
    light.direction = direction;
    light.cos_outer_cone = half_angle_cosine;
    return light;
}

Light sun(float power = 1.0f) {
    Light light;
    light.intensity = glm::vec3(power);
    return light;
}

Light with_mode(Light light, LightMode mode) {
    light.mode = mode;
    return light;
}

Light with_type(Light light, LightType type) {
    light.type = type;
    return light;
}

std::vector<std::string> names_of(const std::vector<Light>& lights) {
    std::vector<std::string> names;
    for (size_t i = 0; i < lights.size(); ++i) names.push_back("light " + std::to_string(i));
    return names;
}

OcclusionChannels assign(const std::vector<Light>& lights,
                         MixedLighting mode = MixedLighting::Shadowmask) {
    return assign_channels(lights, names_of(lights), mode);
}

constexpr uint32_t kNone = kNoIndex;

struct Case {
    const char* name;
    std::vector<Light> lights;
    std::vector<uint32_t> channels;
    std::vector<bool> fell_back;
};

TEST(OcclusionChannels, TableOfCases) {
    const Light realtime = with_mode(lamp(0, 5), LightMode::Realtime);
    const Light baked = with_mode(lamp(0, 5), LightMode::Baked);
    const std::vector<Case> cases{
        {"none", {}, {}, {}},
        {"one", {lamp(0, 1)}, {0}, {false}},
        {"two that overlap", {lamp(0, 2), lamp(1, 2)}, {0, 1}, {false, false}},
        {"two apart share", {lamp(0, 1), lamp(5, 1)}, {0, 0}, {false, false}},
        {"a chain takes two",
         {lamp(0, 2), lamp(3, 2), lamp(6, 2), lamp(9, 2)},
         {0, 1, 0, 1},
         {false, false, false, false}},
        {"the brighter one chooses first", {lamp(0, 2, 1), lamp(1, 2, 9)}, {1, 0}, {false, false}},
        {"suns choose before all", {lamp(0, 2, 99), sun(1)}, {1, 0}, {false, false}},
        {"a sun overlaps everything", {lamp(0, 1), sun(), lamp(9, 1)}, {1, 0, 1}, {0, 0, 0}},
        {"lights without a range too", {lamp(0, 0), lamp(99, 1)}, {0, 1}, {false, false}},
        {"the weakest of five falls back",
         {lamp(0, 9, 5), lamp(0, 9, 4), lamp(0, 9, 1), lamp(0, 9, 3), lamp(0, 9, 2)},
         {0, 1, kNone, 2, 3},
         {false, false, true, false, false}},
        {"what fell back is in nobody's way",
         {lamp(0, 9, 9), lamp(0, 9, 8), lamp(0, 9, 7), lamp(0, 9, 6), lamp(5, 9, 5), lamp(15, 2)},
         {0, 1, 2, 3, kNone, 0},
         {false, false, false, false, true, false}},
        {"other modes take none", {realtime, baked, lamp(0, 5)}, {kNone, kNone, 0}, {0, 0, 0}},
        {"area lights take none",
         {with_type(lamp(0, 5), LightType::Disc), with_type(lamp(0, 5), LightType::Rectangle)},
         {kNone, kNone},
         {false, false}},
    };
    for (const Case& c : cases) {
        const OcclusionChannels result = assign(c.lights);
        EXPECT_EQ(result.of_light, c.channels) << c.name;
        EXPECT_EQ(result.fell_back, c.fell_back) << c.name;
    }
}

TEST(OcclusionChannels, ModeIndirectHasNone) {
    const auto result = assign({lamp(0, 1), sun()}, MixedLighting::Indirect);
    EXPECT_EQ(result.of_light, (std::vector<uint32_t>{kNone, kNone}));
    const std::vector<Light> lights{lamp(0, 1), sun()};
    EXPECT_EQ(assign(lights, MixedLighting::Subtractive), assign(lights));
}

TEST(OcclusionChannels, StayWhenUnrelatedLightsChange) {
    const std::vector<Light> lights{lamp(0, 2, 1), lamp(1, 2, 2), lamp(2, 2, 3)};
    const auto before = assign(lights).of_light;
    std::vector<Light> more = lights;
    more.insert(more.begin(), lamp(50, 3, 100));  // brighter, and first in the scene
    more.push_back(lamp(51, 3, 2));
    more.push_back(with_mode(sun(50), LightMode::Baked));
    const auto after = assign(more).of_light;
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin() + 1));
    more[0].intensity = glm::vec3(0.1f);
    more[0].position.x += 3.0f;
    const auto later = assign(more).of_light;
    EXPECT_TRUE(std::equal(before.begin(), before.end(), later.begin() + 1));
}

TEST(OcclusionChannels, DoNotDependOnTheOrderOfTheScene) {
    std::vector<Light> lights{lamp(0, 4, 1), lamp(1, 4, 2), lamp(2, 4, 3), lamp(3, 4, 4),
                              lamp(4, 4, 5)};
    std::vector<std::string> names = names_of(lights);
    const auto before = assign_channels(lights, names, MixedLighting::Shadowmask);
    std::reverse(lights.begin(), lights.end());
    std::reverse(names.begin(), names.end());
    const auto after = assign_channels(lights, names, MixedLighting::Shadowmask);
    EXPECT_TRUE(
        std::equal(before.of_light.rbegin(), before.of_light.rend(), after.of_light.begin()));
}

TEST(OcclusionChannels, ProbesTakeTheLightOfTheContainingOrNearestVolume) {
    const std::vector<Light> lights{lamp(0, 2), lamp(10, 2), sun()};
    const std::vector<uint32_t> channels{1, 1, 0};
    const auto at = [&](double x) { return occlusion_lights_at({x, 0, 0}, lights, channels); };
    EXPECT_EQ(at(0.5), (OcclusionLights{2, 0, kNone, kNone}));
    EXPECT_EQ(at(9.0), (OcclusionLights{2, 1, kNone, kNone}));
    EXPECT_EQ(at(4.9)[1], 0u);
    EXPECT_EQ(at(5.1)[1], 1u);
}

// --- Volumes of lights ---------------------------------------------------------------------------

TEST(LightVolume, ConesOverlapOnlyWhereTheyIntersect) {
    const glm::vec3 right(1, 0, 0), left(-1, 0, 0);
    const float narrow = 0.9f;
    EXPECT_TRUE(may_overlap(spot(0, right, narrow, 5), spot(4, left, narrow, 5)));
    EXPECT_FALSE(may_overlap(spot(0, left, narrow, 5), spot(4, right, narrow, 5)));
    EXPECT_FALSE(may_overlap(spot(0, right, narrow, 5), lamp(-2, 1.5f)));
    EXPECT_TRUE(may_overlap(spot(0, right, narrow, 5), lamp(-2, 2.5f)));
    EXPECT_FALSE(may_overlap(spot(0, right, narrow, 0), lamp(-2, 1.5f)));  // an endless cone
    EXPECT_TRUE(may_overlap(spot(0, right, narrow, 0), lamp(200, 1.5f)));
    EXPECT_FALSE(may_overlap(spot(0, right, narrow, 5), lamp(8, 2.5f)));
}

TEST(LightVolume, IntersectingVolumesAlwaysOverlap) {
    uint64_t state = 1;
    const auto next = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<float>(state >> 40) / static_cast<float>(1 << 24);
    };
    const auto random_light = [&] {
        const glm::vec3 direction(next() - 0.5f, next() - 0.5f, next() - 0.5f);
        Light light = spot(0, glm::normalize(direction), next(), 0.5f + 3.0f * next());
        light.position = {4 * next(), 4 * next(), 4 * next()};
        if (next() < 0.3f) light.type = LightType::Point;
        return light;
    };
    for (int round = 0; round < 300; ++round) {
        const Light a = random_light(), b = random_light();
        bool has_common_point = false;
        for (int i = 0; i < 2000 && !has_common_point; ++i) {
            const glm::dvec3 p(8 * next() - 2, 8 * next() - 2, 8 * next() - 2);
            has_common_point = distance_to_volume(a, p) <= 0.0f && distance_to_volume(b, p) <= 0.0f;
        }
        EXPECT_TRUE(may_overlap(a, b) || !has_common_point) << round;
    }
}

TEST(LightVolume, DistanceIsThatToTheSphereOrTheCone) {
    EXPECT_FLOAT_EQ(distance_to_volume(lamp(1, 2), {5, 0, 0}), 2.0f);
    EXPECT_FLOAT_EQ(distance_to_volume(lamp(1, 2), {1, 0, 0}), -2.0f);
    const Light cone = spot(0, {1, 0, 0}, 0.8f, 10);
    EXPECT_FLOAT_EQ(distance_to_volume(cone, {0, 5, 0}), 4.0f);
    EXPECT_FLOAT_EQ(distance_to_volume(cone, {12, 0, 0}), 2.0f);
    EXPECT_LT(distance_to_volume(sun(), {1e6, 0, 0}), -1e30f);
}

}  // namespace
}  // namespace tetralight
