// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/layered_volume.h"

// What opening a file verifies of the sections of mixed lighting, layers and transfer.

namespace tetralight {
namespace {

ProbeVolume make_volume() {
    ProbeVolume volume = test::make_layered_volume(6, 2);
    volume.lights.resize(2);
    volume.light_names = "sun\nlamp\n";
    volume.light_states.resize(2);
    volume.occlusion_lights.assign(6, {0, 1, kNoIndex, kNoIndex});
    volume.transfer.resize(6);
    volume.sky.resize(1);
    volume.dering.assign(6, 1);
    return volume;
}

std::string error_after(const std::function<void(ProbeVolume&)>& change) {
    ProbeVolume volume = make_volume();
    change(volume);
    const Status status = verify(volume.view());
    EXPECT_FALSE(status);
    return status ? "" : error_text(status.error());
}

TEST(VerifyLayers, AcceptsWhatIsRight) {
    const Status status = verify(make_volume().view());
    EXPECT_TRUE(status) << error_text(status.error());
}

TEST(VerifyLayers, RefusesCountsThatDoNotAgree) {
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.light_states.resize(3); }),
              "section \"light_states\": 3 elements instead of 2");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.occlusion_lights.pop_back(); }),
              "section \"occlusion_lights\": 5 elements instead of 6");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.layer_irradiance.pop_back(); }),
              "section \"layer_irradiance\": 11 elements instead of 12");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.layer_names = "sun\n"; }),
              "section \"layer_names\": 1 names for 2 layers");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.transfer.pop_back(); }),
              "section \"transfer\": 5 elements instead of 6");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.sky.resize(2); }),
              "section \"sky\": 2 elements instead of 1");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.dering.pop_back(); }),
              "section \"dering\": 5 elements instead of 6");
}

TEST(VerifyLayers, RefusesIndicesAndNumbersOutOfRange) {
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.light_states[1].channel = 4; }),
              "section \"light_states\": element 1: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.light_states[1].layer = 2; }),
              "section \"light_states\": element 1: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) {
                  v.light_states[0].mixed_lighting = static_cast<MixedLighting>(3);
              }),
              "section \"light_states\": element 0: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.occlusion_lights[4][2] = 2; }),
              "section \"occlusion_lights\": element 4: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.layers[1].weight = -1.0f; }),
              "section \"layers\": element 1: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.layers[0].ambient.coefficients[2].y = NAN; }),
              "section \"layers\": element 0: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.layer_irradiance[7].coefficients[8].z = NAN; }),
              "section \"layer_irradiance\": element 7: is not finite, or above 1e+37");
    for (const float wrong : {-0.1f, NAN, INFINITY}) {
        EXPECT_EQ(error_after([=](ProbeVolume& v) {
                      v.layer_errors.assign(v.layer_irradiance.size(), 0.5f);
                      v.layer_errors[7] = wrong;
                  }),
                  "section \"layer_errors\": element 7: is out of range");
    }
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.transfer[3].bounced[8][15].z = INFINITY; }),
              "section \"transfer\": element 3: is not finite, or above 1e+06");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.sky[0].coefficients[15].z = NAN; }),
              "section \"sky\": element 0: is not finite, or above 2e+31");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.light_states[1].fell_back = 1u << 31; }),
              "section \"light_states\": element 1: is out of range");
    EXPECT_EQ(error_after([](ProbeVolume& v) { v.dering[2] = 4; }),
              "section \"dering\": element 2: is out of range");
}

TEST(VerifyLayers, RefusesNamesThatAreNoText) {
    EXPECT_EQ(error_after([](ProbeVolume& v) {
                  v.layer_names = "sun\nlamp";
              }).find("section \"layer_names\""),
              0u);
}

}  // namespace
}  // namespace tetralight
