// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/relight.h>

#include <gtest/gtest.h>

#include <limits>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/dering.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/sh_minimum.h>
#include "tests/support/layered_volume.h"

namespace tetralight {
namespace {

/// What sees all of the sky and nothing else.
ProbeTransfer open_transfer() {
    ProbeTransfer transfer;
    RadianceSh unit;
    for (size_t j = 0; j < 9; ++j) {
        unit = {};
        unit.coefficients[j] = glm::vec3(1.0f);
        transfer.direct[j][j] = irradiance_from_radiance(unit).coefficients[j].x;
        transfer.bounced[j][j] = glm::vec3(0.25f, 0.5f, 0.0f);
    }
    return transfer;
}

/// Layers "sun", "sky" and "rest", and probes in the open.
ProbeVolume make_volume() {
    ProbeVolume volume = test::make_layered_volume(20, 3);
    volume.layer_names = "sun\nsky\nrest\n";
    volume.transfer.assign(20, open_transfer());
    volume.sky.resize(1);
    volume.lights.resize(1);
    volume.light_names = "sun\n";
    volume.light_states.resize(1);
    volume.light_states[0] = {MixedLighting::Shadowmask, 2, 0, 0};
    volume.occlusion_lights.assign(20, {kNoIndex, kNoIndex, 0, kNoIndex});
    volume.occlusion.assign(20, glm::vec4(0.5f));
    make_compact_probes(volume);
    EXPECT_TRUE(verify(volume.view()));
    return volume;
}

/// Lazily opened files are not verified.
TEST(Relight, RefusesSectionsThatDoNotFit) {
    const DistantLight sky = distant_sun(glm::vec3(0, 1, 0), {1, 2, 3});
    ProbeVolume volume = make_volume();
    volume.layers.resize(1);
    EXPECT_EQ(relight_sky(volume, sky).error().code, ErrorCode::NotFound);
    volume = make_volume();
    volume.irradiance.resize(1);
    EXPECT_EQ(relight_sky(volume, sky).error().field, "irradiance");
    volume = make_volume();
    volume.compact.resize(1);
    const Status status = relight_sun(volume, {0.0f, -1.0f, 0.0f}, glm::vec3(1.0f));
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    EXPECT_EQ(status.error().field, "compact");
}

TEST(Relight, SkyLayerBecomesTheTransferOfTheNewSky) {
    ProbeVolume volume = make_volume();
    DistantLight sky = distant_sun(glm::vec3(0, 1, 0), {1, 2, 3});
    volume.layer_errors.assign(60, 0.5f);
    ASSERT_TRUE(relight_sky(volume, sky));
    for (size_t i = 0; i < 60; ++i) {  // those of the new light are not known
        EXPECT_EQ(volume.layer_errors[i], i / 20 == 1 ? 0.0f : 0.5f);
    }
    const IrradianceSh expected = transfer_light(volume.transfer[0], sky);
    for (size_t i = 0; i < 20; ++i) EXPECT_EQ(volume.layer_irradiance[20 + i], expected);
    EXPECT_EQ(volume.irradiance[3],
              volume.layer_irradiance[3] + expected + volume.layer_irradiance[43]);
    EXPECT_EQ(volume.sky[0], sky);
    EXPECT_EQ(count_wrong_compact_probes(volume.view()), 0u);
    const Status status = verify(volume.view());
    EXPECT_TRUE(status) << error_text(status.error());
}

TEST(Relight, KeepsTheWeightsAndDimsTheAmbientLight) {
    ProbeVolume volume = make_volume();
    ASSERT_TRUE(recombine(volume, std::vector<float>{0.0f, 0.5f, 0.0f}));
    const DistantLight sky = distant_sun(glm::vec3(0, 1, 0), glm::vec3(1.0f));
    ASSERT_TRUE(relight_sky(volume, sky));
    EXPECT_EQ(volume.irradiance[3],
              0.5f * transfer_light(volume.transfer[0], sky) + 0.0f * volume.layer_irradiance[43]);
    const IrradianceSh open =
        irradiance_from_radiance(radiance_from_directional_light({0, 1, 0}, glm::vec3(1.0f)));
    EXPECT_EQ(volume.info.ambient.coefficients[1], 0.5f * open.coefficients[1]);
}

TEST(Relight, MixedSunsGiveTheirBouncesAndBakedOnesAll) {
    ProbeVolume volume = make_volume();
    const glm::vec3 down(0, -1, 0);
    const DistantLight sun = distant_sun({0, 1, 0}, glm::vec3(2.0f));
    ASSERT_TRUE(relight_sun(volume, down, glm::vec3(2.0f)));
    EXPECT_EQ(volume.layer_irradiance[5], transfer_bounces(volume.transfer[5], sun));
    volume.lights[0].mode = LightMode::Baked;
    volume.lights[0].indirect_multiplier = 0.0f;
    ASSERT_TRUE(relight_sun(volume, down, glm::vec3(2.0f)));
    EXPECT_EQ(volume.layer_irradiance[5], transfer_direct(volume.transfer[5], sun));
    EXPECT_EQ(volume.lights[0].direction, down);
    EXPECT_EQ(volume.lights[0].intensity, glm::vec3(2.0f));
}

TEST(Relight, AMovedSunLosesItsOcclusion) {
    ProbeVolume volume = make_volume();
    ASSERT_TRUE(relight_sun(volume, {0, -1, 0}, glm::vec3(1.0f)));
    EXPECT_EQ(volume.light_states[0].channel, kNoIndex);
    EXPECT_EQ(volume.occlusion_lights[7][2], kNoIndex);
}

TEST(Relight, KeepsProbesFreeOfRingingThatWere) {
    ProbeVolume volume = make_volume();
    volume.dering.assign(20, 0);
    volume.dering[4] = 1 + static_cast<uint8_t>(DeringWindow::Mildest);
    const DistantLight sun = distant_sun({0, 1, 0}, glm::vec3(1.0f));
    ASSERT_TRUE(relight_sky(volume, sun));
    const auto least = [&](size_t i) { return minimum_irradiance(volume.layer_irradiance[i]).z; };
    EXPECT_LT(least(20 + 3), 0.0);
    EXPECT_GE(least(20 + 4), 0.0);
}

TEST(Relight, ProbesFreeOfRingingAreNeverNegative) {
    // Probes that see the upper half of the sky, projected to four bands, and a sun far below the
    // horizon, of which those make less than nothing.
    ProbeVolume volume = make_volume();
    ProbeTransfer half;
    half.direct[0][0] = 1.0f;
    half.direct[0][1] = 1.0f;  // towards +Y
    volume.transfer.assign(20, half);
    const DistantLight below = distant_sun({0, -1, 0}, {3.0f, 2.0f, 1.0f});
    ASSERT_TRUE(relight_sky(volume, below));
    const auto mean = [&] { return volume.layer_irradiance[20 + 4].coefficients[0]; };
    ASSERT_LT(mean().x, 0.0f);
    volume.dering.assign(20, 1 + static_cast<uint8_t>(DeringWindow::Mildest));
    ASSERT_TRUE(relight_sky(volume, below));
    EXPECT_EQ(volume.layer_irradiance[20 + 4], IrradianceSh{});
}

TEST(Relight, SaysWhatIsMissing) {
    ProbeVolume volume = make_volume();
    const auto sky_error = [&] { return error_text(relight_sky(volume, {}).error()); };
    DistantLight bad;
    bad.coefficients[3].y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error_text(relight_sky(volume, bad).error()), "the sky is not finite");
    volume.light_states[0].layer = kNoIndex;
    EXPECT_EQ(error_text(relight_sun(volume, {0, -1, 0}, glm::vec3(1.0f)).error()),
              "layer \"sun\" holds 0 suns; only one alone can be moved");
    volume.layer_names = "sun\nclouds\nrest\n";
    EXPECT_EQ(sky_error(), "the volume holds no layer \"sky\" to relight");
    volume.transfer.clear();
    EXPECT_EQ(
        sky_error(),
        "the volume holds no transfer of distant light (bake it with the layers sky and transfer)");
}

}  // namespace
}  // namespace tetralight
