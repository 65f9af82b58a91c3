// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/reuse_probes.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_chunks.h>
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

    /// Bakes what `old` has not, with or without a folder of chunks.
    [[nodiscard]] BakedVolume bake_rest(const ProbeVolume& old, const std::string& chunks = "") {
        PreparedBake prepared = prepare_all();
        const Status status = reuse_probes(old.view(), prepared);
        EXPECT_TRUE(status) << error_text(status.error());
        const PreparedBake others = bake_of_others(prepared);
        const auto count = static_cast<uint32_t>(others.capture_positions.size());
        EXPECT_EQ(count + prepared.reused.count(), prepared.capture_positions.size());
        const auto baked = chunks.empty() ? bake_range(scene, others, {0, count}, {})
                                          : bake_in_chunks(scene, others, chunks);
        EXPECT_TRUE(baked) << error_text(baked.error());
        const PartialBake part = spread_others(prepared, baked->partial);
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

TEST_F(ReuseProbes, GoesOnWithFinishedChunks) {
    const ProbeVolume old = bake_all();
    groups[0].positions.push_back({0.7, 0.6, -0.5});
    const std::vector<std::byte> expected = probe_file_bytes(bake_all().view());
    for (int run = 0; run < 2; ++run) {
        EXPECT_EQ(probe_file_bytes(bake_rest(old, path("chunks")).volume.view()), expected);
    }
    PreparedBake prepared = prepare_all();
    ASSERT_TRUE(reuse_probes(old.view(), prepared));
    const auto again =
        bake_in_chunks(scene, bake_of_others(prepared), path("chunks"), [](const BakeProgress&) {
            ADD_FAILURE() << "nothing is left to do";
            return true;
        });
    ASSERT_TRUE(again);
    EXPECT_GT(again->earlier_ray_count, 0u);
}

TEST_F(ReuseProbes, DoesNotTakeChunksOfOtherProbes) {
    const std::vector<std::byte> expected = probe_file_bytes(bake_all().view());
    const std::vector<glm::dvec3> positions = groups[0].positions;
    for (const ptrdiff_t missing : {3, 30}) {  // the one probe that is left to bake
        groups[0].positions.erase(groups[0].positions.begin() + missing);
        const ProbeVolume old = bake_all();
        groups[0].positions = positions;
        EXPECT_EQ(probe_file_bytes(bake_rest(old, path("chunks")).volume.view()), expected);
    }
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
              "it is of another scene, sky or sun");
    EXPECT_EQ(after([](auto& t) { t.scene.probe_adjustments[0].intensity = 0.6f; }),
              "its adjustment volumes are others");
    EXPECT_EQ(after([](auto& t) { t.all.bake.seed = 7; }), "its seed is 0, that of this bake is 7");
    EXPECT_EQ(after([](auto& t) { t.all.bake.target_error = 0.5; }),
              "its target_error is not set, that of this bake is 0.5");
    EXPECT_EQ(after([](auto& t) {
                  t.all.lighting.layers = {"sky", "transfer"};
              }),
              "its layers are none, those of this bake sky, rest, transfer");
}

TEST_F(ReuseProbes, IsOfAVolumeThatWasBakedAndLeftAsItWas) {
    ProbeVolume old = bake_all();
    const std::string metadata = old.metadata;
    old.metadata.insert(1, "\"relit\":\"--sky 2\",");
    EXPECT_EQ(refusal(old), "it was relit with \"--sky 2\"");
    old.metadata = "{}";
    EXPECT_EQ(refusal(old), "it does not say what scene it is of");
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
