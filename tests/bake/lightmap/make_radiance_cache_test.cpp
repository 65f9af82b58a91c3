// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/make_radiance_cache.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include <tetralight/bake/bake_accumulators.h>
#include <tetralight/bake/texel_light.h>
#include "tests/support/scenes.h"
#include "tests/support/window_room.h"

namespace tetralight {
namespace {

constexpr double kPi = std::numbers::pi;

const Material kGrey = test::diffuse(glm::vec3(0.5f));

/// The cache of a scene at five texels a metre.
struct Cached {
    LightmapLayout layout;
    std::vector<TexelMap> maps;
    LightmapTexels texels;
    RadianceCache cache;

    explicit Cached(const Scene& scene, const BakeSettings& settings = {},
                    const RadianceCacheSettings& cache_settings = {}) {
        LightmapLayoutSettings layout_settings;
        layout_settings.texels_per_meter = 5.0;
        layout = *make_lightmap_layout(scene, layout_settings);
        maps = make_texel_maps(scene, layout, {});
        const auto traced = TraceScene::make_static(scene, settings.surfaces);
        texels = *make_lightmap_texels(scene, *traced, layout, maps, {});
        cache = *make_radiance_cache(scene, layout, maps, texels, settings, cache_settings);
    }

    /// Irradiance of all valid texels, each sampled by itself, without or with the cache.
    [[nodiscard]] std::vector<glm::dvec3> sampled(const Scene& scene, const BakeSettings& settings,
                                                  bool is_cached) const {
        BakePlaces places;
        std::vector<glm::dvec3> positions;
        std::vector<TexelSurfaces::Texel> surfaces;
        for (size_t i = 0; i < texels.positions.size(); ++i) {
            if (!texels.is_valid(i)) continue;
            positions.push_back(texels.positions[i]);
            surfaces.push_back(texels.surfaces[i]);
        }
        places.positions = positions;
        places.surfaces = {surfaces, texels.origins};
        if (is_cached) places.surfaces.cache = &cache;
        std::vector<ProbeAccumulator> sums(positions.size());
        EXPECT_TRUE(bake_accumulators(scene, places, settings, sums));
        std::vector<glm::dvec3> irradiance;
        for (const ProbeAccumulator& sum : sums)
            irradiance.emplace_back(irradiance_on_normal(sum.radiance().coefficients[2]));
        return irradiance;
    }

    /// The texel of the first instance nearest to a position.
    [[nodiscard]] size_t texel_at(glm::dvec3 position) const {
        size_t best = 0;
        for (size_t i = 0; i < texels.first_texel[1]; ++i) {
            if (glm::distance(texels.positions[i], position) <
                glm::distance(texels.positions[best], position))
                best = i;
        }
        return best;
    }
};

glm::dvec3 mean(const std::vector<glm::dvec3>& values) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double largest_difference(glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 difference = glm::abs(a - b);
    return std::max({difference.x, difference.y, difference.z});
}

/// The window room under a sky and a sun that shines through its window.
Scene sunny_room() {
    Scene scene = test::window_room();
    scene.environment.radiance = glm::vec3(1.0f, 0.8f, 0.5f);
    test::add_sun(scene, LightMode::Baked, glm::vec3(10.0f)).direction =
        glm::normalize(glm::vec3(0.3f, -0.7f, 1.0f));
    return scene;
}

TEST(MakeRadianceCache, InAFurnaceLightIsThatOfTheSeries) {
    // Radiance 1 + 0.5 + 0.25 + … everywhere.
    Scene scene;
    test::add_box(scene, test::diffuse(glm::vec3(0.5f), glm::vec3(1.0f)), test::Facing::Inward,
                  {-1, -1, -1}, {1, 1, 1});
    const Cached cached(scene);
    std::vector<glm::dvec3> sources, reflected;
    for (const auto& texel : cached.cache.irradiance) {
        EXPECT_EQ(texel.sun, glm::vec3(0.0f));
        sources.emplace_back(texel.sources);
        reflected.emplace_back(texel.reflected);
    }
    EXPECT_NEAR(mean(sources).x, kPi, 0.01 * kPi);
    EXPECT_NEAR(mean(reflected).x, kPi, 0.01 * kPi);
    BakeSettings settings;
    settings.sample_count = 256;
    EXPECT_NEAR(mean(cached.sampled(scene, settings, true)).x, 2.0 * kPi, 0.01 * 2.0 * kPi);
}

TEST(MakeRadianceCache, ItsLightIsThatOfTexelsThatAreTracedToTheEnd) {
    const Scene scene = sunny_room();
    const Cached cached(scene);
    std::vector<glm::dvec3> known;
    for (size_t i = 0; i < cached.texels.positions.size(); ++i) {
        const RadianceCache::Irradiance& light = cached.cache.irradiance[i];
        if (cached.texels.is_valid(i)) known.emplace_back(light.direct() + light.reflected);
    }
    BakeSettings settings;
    settings.sample_count = 256;
    const glm::dvec3 traced = mean(cached.sampled(scene, settings, false));
    EXPECT_LT(largest_difference(mean(known), traced), 0.02 * traced.x);
}

TEST(MakeRadianceCache, PathsThatEndThereBringTheSameLight) {
    const Scene scene = sunny_room();
    const Cached cached(scene);
    BakeSettings settings;
    settings.sample_count = 512;
    const glm::dvec3 traced = mean(cached.sampled(scene, settings, false));
    settings.seed = 1;
    const glm::dvec3 read = mean(cached.sampled(scene, settings, true));
    EXPECT_LT(largest_difference(read, traced), 0.01 * traced.x);
}

TEST(MakeRadianceCache, MixedLightsAreKnownWithTheirDirectLight) {
    // What a mixed sun leaves in a texel is what others reflect of it.
    Scene scene = sunny_room();
    scene.environment.radiance = glm::vec3(0.0f);
    scene.lights[0].mode = LightMode::Mixed;
    BakeSettings settings;
    settings.plan.light_modes = {LightMode::Mixed};
    const Cached cached(scene, settings);
    float brightest = 0.0f;
    for (const auto& texel : cached.cache.irradiance) brightest = std::max(brightest, texel.sun.x);
    EXPECT_NEAR(double{brightest}, 10.0 * 0.7 / std::sqrt(0.3 * 0.3 + 0.7 * 0.7 + 1.0), 0.01);
    settings.sample_count = 512;
    const glm::dvec3 traced = mean(cached.sampled(scene, settings, false));
    const glm::dvec3 read = mean(cached.sampled(scene, settings, true));
    EXPECT_GT(traced.x, 0.0);
    EXPECT_LT(largest_difference(read, traced), 0.02 * traced.x);
}

TEST(MakeRadianceCache, LayersAddUpToTheLight) {
    const Scene scene = sunny_room();
    BakeSettings settings;
    settings.plan.layer_of_light = {0};
    settings.plan.layer_of_sky = 1;
    settings.plan.layer_count = 2;
    const Cached cached(scene, settings);
    ASSERT_EQ(cached.cache.layer_count, 2u);
    for (uint32_t i = 0; i < cached.cache.irradiance.size(); ++i) {
        const RadianceCache::Irradiance& all = cached.cache.irradiance[i];
        const auto layers = cached.cache.layers(i);
        const float room = 1e-4f * (1.0f + all.direct().x + all.reflected.x);
        EXPECT_NEAR(all.sun.x, layers[0].sun.x, room);
        EXPECT_EQ(layers[1].sun.x, 0.0f);
        EXPECT_NEAR(all.sources.x, layers[0].sources.x + layers[1].sources.x, room);
        EXPECT_NEAR(all.reflected.x, layers[0].reflected.x + layers[1].reflected.x, room);
    }
}

TEST(MakeRadianceCache, TheSameForAnyNumberOfThreads) {
    const Scene scene = sunny_room();
    BakeSettings settings;
    settings.thread_count = 1;
    const Cached one(scene, settings);
    settings.thread_count = 3;
    const Cached three(scene, settings);
    ASSERT_EQ(one.cache.irradiance.size(), three.cache.irradiance.size());
    EXPECT_EQ(one.cache.is_trusted, three.cache.is_trusted);
    for (size_t i = 0; i < one.cache.irradiance.size(); ++i) {
        EXPECT_EQ(one.cache.irradiance[i].direct(), three.cache.irradiance[i].direct());
        EXPECT_EQ(one.cache.irradiance[i].reflected, three.cache.irradiance[i].reflected);
    }
}

TEST(MakeRadianceCache, TexelsThatAWallCrossesAreNotTrusted) {
    Scene scene;
    test::add_floor(scene, kGrey, 1.0f);
    Material wall = kGrey;
    wall.is_double_sided = true;
    test::add_quad(scene, wall, {0.02f, 0, -1}, {0, 1, 0}, {0, 0, 2});
    const Cached cached(scene);
    EXPECT_FALSE(cached.cache.is_trusted[cached.texel_at({0.02, 0, 0.1})]);
    EXPECT_TRUE(cached.cache.is_trusted[cached.texel_at({0.5, 0, 0.1})]);
    EXPECT_TRUE(cached.cache.is_trusted[cached.texel_at({-0.5, 0, 0.1})]);
}

TEST(MakeRadianceCache, StopsIfItIsCancelled) {
    const Scene scene = sunny_room();
    const Cached cached(scene);
    const auto cancelled = make_radiance_cache(scene, cached.layout, cached.maps, cached.texels, {},
                                               {}, [](const BakeProgress&) { return false; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
}

class FindCachedTexel : public testing::Test {
  protected:
    /// The cached texel of the surface that a ray hits.
    [[nodiscard]] std::optional<uint32_t> find(glm::vec3 origin, glm::vec3 direction) const {
        const glm::vec3 from = traced_->render_from_world(glm::dvec3(origin));
        const auto surface = traced_->intersect({from, direction});
        EXPECT_TRUE(surface);
        return surface ? cached_.cache.find(*surface, from) : std::nullopt;
    }

    static Scene floor() {
        Scene scene;
        Material material = kGrey;
        material.is_double_sided = true;
        test::add_floor(scene, material, 1.0f);
        test::add_floor(scene, material, 1.0f, -5.0f).lightmap.receive_gi = ReceiveGi::Probes;
        return scene;
    }

    const Scene scene_ = floor();
    const Result<TraceScene> traced_ = TraceScene::make_static(scene_);
    const Cached cached_{scene_};
};

TEST_F(FindCachedTexel, IsTheOneAtThePlace) {
    for (const glm::dvec3 place : {glm::dvec3(0.3, 0, 0.5), glm::dvec3(-0.77, 0, 0.13)}) {
        const auto texel = find(glm::vec3(place) + glm::vec3(0, 2, 0), {0, -1, 0});
        ASSERT_TRUE(texel);
        EXPECT_EQ(*texel, cached_.texel_at(place));
    }
}

TEST_F(FindCachedTexel, NoneNearTheStartOfTheRay) {
    EXPECT_TRUE(find({0.3f, 0.81f, 0.5f}, {0, -1, 0}));
    EXPECT_FALSE(find({0.3f, 0.79f, 0.5f}, {0, -1, 0}));  // four texels of 20 cm
}

TEST_F(FindCachedTexel, NoneOnBacksAndOnObjectsWithoutLightmaps) {
    EXPECT_FALSE(find({0.3f, -2, 0.5f}, {0, 1, 0}));
    EXPECT_FALSE(find({0.3f, -2, 0.5f}, {0, -1, 0}));
}

}  // namespace
}  // namespace tetralight
