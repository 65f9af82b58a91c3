// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/stored_cache.h>

#include "tests/pipeline/lightmap_part_fixture.h"

namespace tetralight {
namespace {

class StoredCache : public test::LightmapPartFixture {
  protected:
    [[nodiscard]] BakeStore store() const {
        auto opened = BakeStore::open(folder.path("cache"));
        EXPECT_TRUE(opened) << error_text(opened.error());
        return std::move(*opened);
    }

    /// Whether a bake makes its cache: a bake that is cancelled at its first ray has none to read.
    [[nodiscard]] bool is_made() const {
        BakeStore caches = store();
        const auto cache = stored_radiance_cache(scene, prepare(), &caches,
                                                 [](const BakeProgress&) { return false; });
        EXPECT_TRUE(cache || cache.error().code == ErrorCode::Cancelled);
        return !cache;
    }

    void keep() const {
        BakeStore caches = store();
        const auto cache = stored_radiance_cache(scene, prepare(), &caches);
        EXPECT_TRUE(cache) << error_text(cache.error());
    }
};

TEST_F(StoredCache, IsMadeOnceForABake) {
    EXPECT_TRUE(is_made());
    keep();
    EXPECT_FALSE(is_made());
}

TEST_F(StoredCache, HasTheLightOfOneThatIsMade) {
    settings.lighting.layers = {"sky"};
    keep();
    BakeStore caches = store();
    const auto read = stored_radiance_cache(scene, prepare(), &caches);
    const auto made = stored_radiance_cache(scene, prepare(), nullptr);
    ASSERT_TRUE(read && made);
    EXPECT_EQ(read->is_trusted, made->is_trusted);
    EXPECT_EQ(read->layer_count, made->layer_count);
    EXPECT_EQ(read->has_reflected, made->has_reflected);
    EXPECT_EQ(read->maps.size(), made->maps.size());
    EXPECT_EQ(read->instances.size(), made->instances.size());
    ASSERT_EQ(read->irradiance.size(), made->irradiance.size());
    for (size_t i = 0; i < made->irradiance.size(); ++i)
        EXPECT_EQ(read->irradiance[i].reflected, made->irradiance[i].reflected);
    ASSERT_EQ(read->layer_irradiance.size(), made->layer_irradiance.size());
}

TEST_F(StoredCache, OfAnotherSceneOrSettingsIsMade) {
    keep();
    settings.bake.seed = 1;
    EXPECT_TRUE(is_made());
    settings.bake.seed = 0;
    scene.lights[0].intensity *= 2.0f;
    EXPECT_TRUE(is_made());
}

TEST_F(StoredCache, AnEmptyRangeMakesIt) {
    BakeStore caches = store();
    BakeStorage storage;
    storage.cache = &caches;
    const auto bake = bake_texel_range(scene, prepare(), {0, 0}, storage);
    ASSERT_TRUE(bake) << error_text(bake.error());
    EXPECT_FALSE(is_made());
}

TEST_F(StoredCache, PartsThatReadItGiveTheBytesOfOneBake) {
    const PreparedLightmaps prepared = prepare();
    const uint32_t count = texel_count();
    std::vector<std::string> parts;
    for (const PlaceRange range : {PlaceRange{0, 0}, PlaceRange{0, 30}, PlaceRange{30, count}}) {
        BakeStore caches = store();
        BakeStorage storage;
        storage.cache = &caches;
        const auto bake = bake_texel_range(scene, prepared, range, storage);
        ASSERT_TRUE(bake) << error_text(bake.error());
        parts.push_back(folder.path("part" + std::to_string(parts.size())));
        ASSERT_TRUE(write_lightmap_part(parts.back(), prepared, *bake));
    }
    const auto merged = merge_lightmap_parts(parts);
    ASSERT_TRUE(merged) << error_text(merged.error());
    EXPECT_EQ(lightmap_file_bytes(merged->lightmaps.view()), whole());
}

}  // namespace
}  // namespace tetralight
