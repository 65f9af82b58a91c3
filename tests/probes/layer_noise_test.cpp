// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/layer_noise.h>

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/layered_volume.h"

namespace tetralight {
namespace {

/// Red irradiance in one coefficient.
IrradianceSh light(int coefficient, float value) {
    IrradianceSh result;
    result.coefficients[coefficient].x = value;
    return result;
}

/// Two layers of 4 probes: 3 and 4, in different coefficients, with errors of 10 % and 20 %.
ProbeVolume make_volume() {
    ProbeVolume volume = test::make_layered_volume(4, 2);
    volume.health.assign(4, {});
    for (size_t i = 0; i < 4; ++i) {
        volume.layer_irradiance[i] = light(0, 3.0f);
        volume.layer_irradiance[4 + i] = light(1, 4.0f);
        volume.health[i].standard_error = 0.3f;
    }
    volume.layer_errors = {0.1f, 0.1f, 0.1f, 0.1f, 0.2f, 0.2f, 0.2f, 0.2f};
    for (Layer& layer : volume.layers) layer.weight = 1.0f;
    return volume;
}

TEST(LayerNoise, IsOverProbesThatTheLayerLights) {
    ProbeVolume volume = make_volume();
    volume.layer_irradiance[3] = light(0, 0.02f);  // the mean is 2.26
    volume.layer_errors[3] = 9.0f;
    volume.layer_errors[1] = 0.5f;
    volume.layer_errors[4] = 0.0f;  // not known
    const auto noise = layer_noise(volume.view());
    ASSERT_EQ(noise.size(), 2u);
    EXPECT_EQ(noise[0], (NoiseStatistics{3, 0.1f, 0.5f, 0.5f}));
    EXPECT_EQ(noise[1], (NoiseStatistics{3, 0.2f, 0.2f, 0.2f}));
}

TEST(LayerNoise, OfVolumesWithoutErrorsIsNotKnown) {
    ProbeVolume volume = make_volume();
    volume.layer_errors.clear();
    EXPECT_TRUE(layer_noise(volume.view()).empty());
    volume.layers[0].weight = 0.0f;
    EXPECT_EQ(relit_error(volume.view(), 1), 0.3f);  // that of the bake is all that is known
}

TEST(LayerNoise, OfARelitVolumeIsThatOfWhatRemains) {
    ProbeVolume volume = make_volume();
    EXPECT_EQ(relit_error(volume.view(), 1), 0.3f);  // as it was baked
    volume.layers[0].weight = 0.0f;
    volume.layers[1].weight = 3.0f;
    EXPECT_NEAR(relit_error(volume.view(), 1), 0.2f, 1e-6f);
    volume.layers[0].weight = 2.0f;  // √((2·3·0.1)² + (3·4·0.2)²) / √(6² + 12²)
    EXPECT_NEAR(relit_error(volume.view(), 1), std::sqrt(0.36 + 5.76) / std::sqrt(180.0), 1e-6);
    EXPECT_EQ(relit_noise(volume.view()).probe_count, 4u);
    volume.layers[0].weight = volume.layers[1].weight = 0.0f;
    EXPECT_EQ(relit_error(volume.view(), 1), 0.0f);
}

}  // namespace
}  // namespace tetralight
