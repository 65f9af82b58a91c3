// SPDX-License-Identifier: Apache-2.0
// What adjustment volumes change of a bake.
#include <tetralight/pipeline/override_probes.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/merge_parts.h>
#include <tetralight/probes/rendering_layers.h>
#include "tests/pipeline/part_fixture.h"
#include "tests/support/probe_groups.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

using test::make_group;

ProbeAdjustment around(const glm::dvec3& center) {
    ProbeAdjustment adjustment;
    adjustment.name = "here";
    adjustment.world_from_volume = glm::translate(glm::dmat4(1.0), center);
    return adjustment;
}

/// The solid box [-1, 1]³ under a white sky.
Scene solid() {
    Scene scene;
    scene.environment.radiance = glm::vec3(1.0f);
    test::add_box(scene, test::diffuse(glm::vec3(0.5f)), test::Facing::Outward, {-1, -1, -1},
                  {1, 1, 1});
    return scene;
}

const glm::dvec3 kDeep(0, 0.1, 0), kRight(3, 0, 0), kLeft(-3, 0, 0);

ProbeVolume bake(const Scene& scene) {
    BakeVolumeSettings settings;
    settings.bake.sample_count = 64;
    settings.health.virtual_offset = 0.0;  // what lies in geometry stays there
    const auto baked =
        bake_volume(scene, std::vector{make_group("a", {kDeep, kRight, kLeft})}, settings);
    EXPECT_TRUE(baked);
    return baked->volume;
}

uint32_t find(const ProbeVolume& volume, const glm::dvec3& position) {
    for (uint32_t i = 0; i < volume.exact_positions.size(); ++i) {
        if (volume.exact_positions[i] == position) return i;
    }
    return kNoIndex;
}

TEST(OverrideProbes, IntensityScalesTheLightOfTheProbesInTheVolume) {
    Scene scene = solid();
    const ProbeVolume plain = bake(scene);
    scene.probe_adjustments = {around(kRight)};
    scene.probe_adjustments[0].intensity = 0.25f;
    const ProbeVolume scaled = bake(scene);
    EXPECT_EQ(scaled.irradiance[find(scaled, kRight)],
              0.25f * plain.irradiance[find(plain, kRight)]);
    EXPECT_EQ(scaled.irradiance[find(scaled, kLeft)], plain.irradiance[find(plain, kLeft)]);
}

TEST(OverrideProbes, IntensityScalesLayersAndTransferToo) {
    ProbeVolume volume;
    volume.positions.resize(2);
    volume.irradiance.resize(2);
    volume.validity.resize(2, 1.0f);
    volume.layer_irradiance.resize(4);  // two layers
    volume.transfer.resize(2);
    for (IrradianceSh& sh : volume.layer_irradiance) sh.coefficients.fill(glm::vec3(4.0f));
    for (ProbeTransfer& transfer : volume.transfer) {
        transfer.direct[0][0] = 8.0f;
        transfer.bounced[1][2] = glm::vec3(2.0f);
    }
    const ProbeVolume plain = volume;
    override_probes(std::vector<ProbeOverride>{{}, {0.25f, -1.0f}}, volume);
    for (const size_t i : {0u, 2u}) {
        EXPECT_EQ(volume.layer_irradiance[i], plain.layer_irradiance[i]);
        EXPECT_EQ(volume.layer_irradiance[i + 1], 0.25f * plain.layer_irradiance[i + 1]);
    }
    EXPECT_EQ(volume.transfer[0], plain.transfer[0]);
    EXPECT_EQ(volume.transfer[1].direct[0][0], 2.0f);
    EXPECT_EQ(volume.transfer[1].bounced[1][2], glm::vec3(0.5f));
}

TEST(OverrideProbes, AForcedlyValidProbeStaysInGeometry) {
    Scene scene = solid();
    EXPECT_EQ(find(bake(scene), kDeep), kNoIndex);
    scene.probe_adjustments = {around(kDeep)};
    scene.probe_adjustments[0].validity = 1.0f;
    const ProbeVolume kept = bake(scene);
    ASSERT_NE(find(kept, kDeep), kNoIndex);
    EXPECT_EQ(kept.validity[find(kept, kDeep)], 1.0f);
    EXPECT_EQ(kept.health[find(kept, kDeep)].virtual_offset, glm::vec3(0.0f));
}

TEST(OverrideProbes, AForcedlyInvalidProbeIsLeftOutOfFreeSpace) {
    Scene scene = solid();
    scene.probe_adjustments = {around(kLeft)};
    scene.probe_adjustments[0].validity = 0.0f;
    const ProbeVolume volume = bake(scene);
    EXPECT_EQ(find(volume, kLeft), kNoIndex);
    EXPECT_NE(find(volume, kRight), kNoIndex);
}

TEST(OverrideProbes, VolumesWithoutProbesChangeNothing) {
    Scene scene = solid();
    const ProbeVolume plain = bake(scene);
    scene.probe_adjustments = {around({50, 0, 0})};
    scene.probe_adjustments[0].intensity = 0.0f;
    EXPECT_TRUE(find_overrides(scene.probe_adjustments, plain.exact_positions).empty());
    EXPECT_EQ(bake(scene), plain);
}

TEST(OverrideProbes, RenderingLayersReplaceThoseOfTheGroup) {
    Scene scene = solid();
    EXPECT_TRUE(bake(scene).rendering_layers.empty());
    scene.probe_adjustments = {around(kRight), around(kRight)};
    scene.probe_adjustments[0].rendering_layers = 0b01;
    scene.probe_adjustments[1].name = "smaller";
    scene.probe_adjustments[1].world_from_volume =
        glm::scale(scene.probe_adjustments[1].world_from_volume, glm::dvec3(0.5));
    scene.probe_adjustments[1].rendering_layers = 0b10;
    const ProbeVolume volume = bake(scene);
    EXPECT_EQ(volume.rendering_layers[find(volume, kRight)], 0b10u);
    EXPECT_EQ(volume.rendering_layers[find(volume, kLeft)], kAllRenderingLayers);
}

TEST(OverrideProbes, RenderingLayersChangeNoLight) {
    Scene scene = solid();
    const ProbeVolume plain = bake(scene);
    scene.probe_adjustments = {around(kRight)};
    scene.probe_adjustments[0].rendering_layers = 0b01;
    ProbeVolume changed = bake(scene);
    ASSERT_EQ(changed.rendering_layers.size(), plain.positions.size());
    changed.rendering_layers.clear();
    EXPECT_EQ(changed, plain);
}

class OverriddenParts : public test::PartFixture {};

TEST_F(OverriddenParts, JoinToTheBytesOfOneBake) {
    ProbeAdjustment half = around({0, 0, 0});
    half.world_from_volume = glm::scale(glm::dmat4(1.0), glm::dvec3(3.0, 100.0, 100.0));
    half.intensity = 2.0f;
    half.validity = 1.0f;
    scene.probe_adjustments = {half};
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {12, kProbeCount});
    const auto merged = merge_parts({a, b});
    ASSERT_TRUE(merged) << error_text(merged.error());
    EXPECT_EQ(probe_file_bytes(merged->volume.view()), whole());
}

TEST_F(OverriddenParts, KeepTheRenderingLayersOfAWholeBake) {
    groups[0].rendering_layers = 0b01;
    ProbeAdjustment near = around(groups[1].positions[0]);
    near.world_from_volume = glm::scale(near.world_from_volume, glm::dvec3(1e-3));
    near.rendering_layers = 0b10;
    scene.probe_adjustments = {near};
    const std::string a = bake_part("a", {0, 12}), b = bake_part("b", {12, kProbeCount});
    const auto merged = merge_parts({a, b});
    ASSERT_TRUE(merged) << error_text(merged.error());
    EXPECT_EQ(probe_file_bytes(merged->volume.view()), whole());
    std::map<uint32_t, int> counts;
    for (const uint32_t layers : merged->volume.rendering_layers) ++counts[layers];
    EXPECT_EQ(counts, (std::map<uint32_t, int>{{0b01, 20}, {0b10, 1}, {kAllRenderingLayers, 14}}));
}

}  // namespace
}  // namespace tetralight
