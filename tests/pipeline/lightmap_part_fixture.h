// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/lightmap_part.h>
#include <tetralight/pipeline/merge_parts.h>
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace tetralight::test {

/// Small lightmaps of three objects, whole or in parts: two tiles of one floor, which a seam joins,
/// and a box that stands in it, so that some texels are inside geometry.
class LightmapPartFixture : public testing::Test {
  protected:
    LightmapPartFixture() {
        const Material grey = diffuse(glm::vec3(0.5f));
        scene.environment.radiance = {1, 2, 3};
        add_quad(scene, grey, {-1, 0, -1}, {0, 0, 2}, {1, 0, 0}).name = "tile";
        add_quad(scene, grey, {0, 0, -1}, {0, 0, 2}, {1, 0, 0}).name = "next";
        add_box(scene, grey, Facing::Outward, {-0.6f, -0.1f, -0.6f}, {0.6f, 0.5f, 0.6f}).name =
            "box";
        add_sun(scene, LightMode::Baked, glm::vec3(2.0f));
        settings.layout.texels_per_meter = 4.0;
        settings.layout.page_size = 32;
        settings.bake.sample_count = 128;
    }

    [[nodiscard]] PreparedLightmaps prepare() const {
        auto prepared = prepare_lightmaps(scene, settings);
        EXPECT_TRUE(prepared) << error_text(prepared.error());
        return std::move(*prepared);
    }

    [[nodiscard]] TexelBake bake(const PreparedLightmaps& prepared, PlaceRange range) const {
        auto baked = bake_texel_range(scene, prepared, range);
        EXPECT_TRUE(baked) << error_text(baked.error());
        return std::move(*baked);
    }

    /// Bakes a range into a file of the folder and returns its path.
    std::string bake_part(const std::string& name, PlaceRange range) const {
        const PreparedLightmaps prepared = prepare();
        const Status status =
            write_lightmap_part(folder.path(name), prepared, bake(prepared, range));
        EXPECT_TRUE(status) << error_text(status.error());
        return folder.path(name);
    }

    [[nodiscard]] uint32_t texel_count() const {
        return static_cast<uint32_t>(prepare().baked.size());
    }

    /// The file of one bake of all texels.
    [[nodiscard]] std::vector<std::byte> whole() const {
        const auto baked = bake_lightmaps(scene, settings);
        EXPECT_TRUE(baked) << error_text(baked.error());
        return lightmap_file_bytes(baked->lightmaps.view());
    }

    const TempFolder folder;

  public:  // for the lambdas of tests
    Scene scene;
    BakeLightmapsSettings settings;
};

}  // namespace tetralight::test
