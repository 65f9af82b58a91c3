// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reuse_probes.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/walls_metadata.h>
#include <tetralight/probes/recombine.h>
#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

/// A room with a block that some probes lie in, and volumes that adjust others.
class ReuseProbes : public test::PartFixture {
  protected:
    ReuseProbes() {
        Light& lamp = test::add_point_light(scene, LightMode::Mixed, {3, 2, 1}, {1, 1, 1});
        lamp.radius = 0.1f;
        scene.light_names = {"bulb", "lamp"};
        scene.materials[0].emission = {1, 2, 3};
        test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward,
                      {-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f});
        ProbeAdjustment& dimmer = scene.probe_adjustments.emplace_back();
        dimmer.name = "dimmer";
        dimmer.world_from_volume = glm::translate(glm::dmat4(1.0), {0.75, 0.75, 0.0});
        dimmer.intensity = 0.5f;
        dimmer.validity = 0.9f;
        all.bake.sample_count = 32;
        groups[0].positions = test::random_positions(60, 1);
    }

    [[nodiscard]] ProbeVolume bake_all() const {
        auto baked = bake_volume(scene, groups, all);
        EXPECT_TRUE(baked) << error_text(baked.error());
        return std::move(baked->volume);
    }

    [[nodiscard]] PreparedBake prepare_all() const {
        auto prepared = prepare_bake(scene, groups, all);
        EXPECT_TRUE(prepared) << error_text(prepared.error());
        return std::move(*prepared);
    }

    /// Moves, adds and removes some probes, and lets another group ask for dering.
    void edit(uint64_t seed) {
        std::mt19937_64 engine(seed);
        const auto below = [&](size_t count) { return static_cast<size_t>(engine() % count); };
        for (ProbeGroup& group : groups) {
            auto& positions = group.positions;
            for (int i = 0; i < 3; ++i) positions[below(positions.size())].x += 0.125;
            positions.erase(positions.begin() + static_cast<ptrdiff_t>(below(positions.size())));
            const auto added = test::random_positions(2, engine());
            positions.insert(positions.end(), added.begin(), added.end());
        }
        groups[below(2)].dering = below(2) == 0;
    }

    /// Bakes the probes whose light `old` does not have.
    [[nodiscard]] BakedVolume bake_rest(const ProbeVolume& old) {
        PreparedBake prepared = prepare_all();
        const Status status = reuse_probes(old.view(), prepared);
        EXPECT_TRUE(status) << error_text(status.error());
        const auto count = static_cast<uint32_t>(prepared.capture_positions.size());
        const auto baked = bake_range(scene, prepared, {0, count});
        EXPECT_TRUE(baked) << error_text(baked.error());
        const PartialBake& part = baked->partial;
        EXPECT_EQ(part.reused, prepared.reused);
        return finish_bake(std::move(prepared), part.accumulators, part.split_rows);
    }

    /// Edits a few times, each time from the volume before; gives the probes that were re-used.
    size_t edit_and_compare() {
        size_t reused = 0;
        ProbeVolume old = bake_all();
        for (uint64_t seed = 0; seed < 4; ++seed) {
            edit(seed);
            BakedVolume rest = bake_rest(old);
            reused += rest.report.reused_count;
            EXPECT_EQ(probe_file_bytes(rest.volume.view()), probe_file_bytes(bake_all().view()))
                << seed;
            old = std::move(rest.volume);
        }
        return reused;
    }

    /// Why a volume cannot be re-used.
    [[nodiscard]] std::string refusal(const ProbeVolume& old) const {
        PreparedBake prepared = prepare_all();
        const Status status = reuse_probes(old.view(), prepared);
        return status ? "" : error_text(status.error());
    }

    BakeVolumeSettings all;
};

TEST_F(ReuseProbes, GivesTheBytesOfABakeOfAllProbes) {
    EXPECT_GT(edit_and_compare(), 4 * 50u);
}

TEST_F(ReuseProbes, GivesThemWithLayersTransferAndOcclusion) {
    all.lighting.mixed_lighting = MixedLighting::Shadowmask;
    all.lighting.layers = {"light:bulb", "transfer"};
    all.bake.target_error = 0.05;
    all.bake.max_sample_count = 512;
    EXPECT_NE(bake_all().layer_names.find("rest"), std::string::npos);
    EXPECT_GT(edit_and_compare(), 4 * 50u);
}

TEST_F(ReuseProbes, GivesThemWithLayersAndNoTransfer) {
    all.lighting.layers = {"sky"};
    all.dering.window = DeringWindow::Hann;
    EXPECT_GT(edit_and_compare(), 4 * 50u);
}

TEST_F(ReuseProbes, GivesThemWhereProbesAreDilated) {
    all.health.invalid = InvalidProbes::Dilate;
    all.health.virtual_offset = 0.0;
    all.lighting.mixed_lighting = MixedLighting::Shadowmask;
    all.lighting.layers = {"light:bulb"};
    EXPECT_GT(edit_and_compare(), 0u);
}

TEST_F(ReuseProbes, GivesThemWhereRingingIsRemovedFromAll) {
    all.dering = {DeringWindow::Lanczos, true};
    EXPECT_GT(edit_and_compare(), 4 * 50u);
}

TEST_F(ReuseProbes, GivesThemWhereProbesInGeometryStay) {
    all.health.invalid = InvalidProbes::Keep;
    EXPECT_GT(edit_and_compare(), 4 * 50u);
}

TEST_F(ReuseProbes, TakesAllWhenNothingChanged) {
    const ProbeVolume old = bake_all();
    const BakedVolume again = bake_rest(old);
    EXPECT_EQ(again.report.reused_count, old.positions.size());
    EXPECT_EQ(again.report.ray_count, 0u);
    EXPECT_EQ(again.volume, old);
}

TEST_F(ReuseProbes, IsOfOneSceneAndOneSetOfSettings) {
    const ProbeVolume old = bake_all();
    EXPECT_EQ(refusal(old), "");
    const auto after = [&](const auto& change) {
        const Scene old_scene = scene;
        const BakeVolumeSettings old_settings = all;
        change(*this);
        const std::string reason = refusal(old);
        scene = old_scene;
        all = old_settings;
        return reason;
    };
    EXPECT_EQ(after([](auto& t) { t.scene.environment.radiance.x = 1.5f; }),
              "its scene, sky or sun is different");
    EXPECT_EQ(after([](auto& t) { t.scene.probe_adjustments[0].intensity = 0.6f; }),
              "its adjustment volumes are different");
    EXPECT_EQ(after([](auto& t) { t.all.bake.seed = 7; }),
              "its setting seed is 0, that of this bake is 7");
    EXPECT_EQ(after([](auto& t) { t.all.bake.target_error = 0.5; }),
              "its setting target_error is not set, that of this bake is 0.5");
    EXPECT_EQ(after([](auto& t) {
                  t.all.lighting.layers = {"sky", "transfer"};
              }),
              "its layers are none, those of this bake sky, rest, transfer");
}

TEST_F(ReuseProbes, DoesNotDependOnWhatWasFoundOfWalls) {
    ProbeVolume old = bake_all();
    ASSERT_TRUE(read_walls(old.metadata));
    old.metadata = add_walls(old.metadata, {.unclear_cell_count = 12345, .unseen = {}});
    EXPECT_EQ(refusal(old), "");
}

TEST_F(ReuseProbes, IsOfAVolumeThatWasBakedAndLeftAsItWas) {
    ProbeVolume old = bake_all();
    const std::string metadata = old.metadata;
    old.metadata.insert(1, "\"relit\":\"--sky 2\",");
    EXPECT_EQ(refusal(old), "it was relit with \"--sky 2\"");
    old.metadata = "{}";
    EXPECT_EQ(refusal(old), "its metadata has no hash of its scene");
    old.metadata = metadata;
    old.exact_positions.clear();
    EXPECT_EQ(refusal(old), "a section is missing");
    old.irradiance.clear();
    EXPECT_EQ(refusal(old), "it has no light");
}

TEST_F(ReuseProbes, TakesLayersWhateverWeightsTheyHave) {
    all.lighting.layers = {"light:bulb", "sky"};
    ProbeVolume old = bake_all();
    const std::vector<float> weights(old.layers.size(), 0.25f);
    ASSERT_TRUE(recombine(old, weights));
    edit(9);
    EXPECT_EQ(probe_file_bytes(bake_rest(old).volume.view()), probe_file_bytes(bake_all().view()));
}

}  // namespace
}  // namespace tetralight
