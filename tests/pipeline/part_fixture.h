// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_range.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight::test {

/// A small bake, whole or in parts, in a folder that goes away with the test.
class PartFixture : public testing::Test {
  protected:
    PartFixture() {
        test::add_box(scene, test::diffuse({0.8f, 0.6f, 0.4f}), test::Facing::Inward, {-2, -2, -2},
                      {2, 2, 2});
        test::add_point_light(scene, LightMode::Baked, {3, 2, 1}, {0.5f, 1.5f, 0.5f});
        scene.environment.radiance = {1, 2, 3};
        groups.resize(2);
        groups[0].name = "hall";
        groups[0].positions = test::random_positions(20, 1);
        groups[1].name = "attic";
        groups[1].positions = test::random_positions(15, 2);
        groups[1].dering = true;
        settings.sample_count = 128;
        std::filesystem::create_directory(folder);
    }

    ~PartFixture() override { std::filesystem::remove_all(folder); }

    [[nodiscard]] PreparedBake prepare() const {
        auto prepared = prepare_bake(scene, groups, {{}, settings, {}, {}, lighting});
        EXPECT_TRUE(prepared) << error_text(prepared.error());
        return std::move(*prepared);
    }

    /// Bakes a range to its end.
    [[nodiscard]] PartialBake bake(const PreparedBake& prepared, PlaceRange range) const {
        auto baked = bake_range(scene, prepared, range);
        EXPECT_TRUE(baked) << error_text(baked.error());
        return std::move(baked->partial);
    }

    /// Bakes a range into a file of the folder and returns its path.
    std::string bake_part(const std::string& name, PlaceRange range) const {
        const PreparedBake prepared = prepare();
        const Status status = write_part(path(name), prepared, bake(prepared, range));
        EXPECT_TRUE(status) << error_text(status.error());
        return path(name);
    }

    [[nodiscard]] std::vector<std::byte> whole() const {
        const auto baked = bake_volume(scene, groups, {{}, settings, {}, {}, lighting});
        EXPECT_TRUE(baked);
        return probe_file_bytes(baked->volume.view());
    }

    [[nodiscard]] std::string path(const std::string& name) const { return folder / name; }

    static constexpr uint32_t kProbeCount = 35;

  public:  // for the lambdas of tests
    Scene scene;
    std::vector<ProbeGroup> groups;
    BakeSettings settings;
    LightingSettings lighting;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("tetralight_parts_" + std::to_string(::getpid()));
};

}  // namespace tetralight::test
