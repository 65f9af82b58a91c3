// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/live_light.h>

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/layered_volume.h"

namespace tetralight {
namespace {

/// Layer k has constant light of 2^k at every probe.
ProbeVolume constant_layers(size_t probe_count) {
    ProbeVolume volume = test::make_layered_volume(probe_count, 3);
    for (size_t k = 0; k < 3; ++k) {
        IrradianceSh light;
        light.coefficients.fill(glm::vec3(static_cast<float>(1u << k)));
        const size_t count = volume.positions.size();
        for (size_t i = 0; i < count; ++i) volume.layer_irradiance[k * count + i] = light;
        volume.layers[k].largest = light.coefficients[0].x;
    }
    return volume;
}

float light_of(const ProbeVolumeView& view, size_t probe) {
    return compact_irradiance(view.compact[probe], view.info.compact_scale).coefficients[0].x;
}

TEST(LiveLight, BeginsWithTheLightOfTheVolume) {
    ProbeVolume volume = constant_layers(50);
    volume.layers[1].weight = 0.5f;
    const auto live = LiveLight::make(volume.view());
    ASSERT_TRUE(live) << error_text(live.error());
    const auto reading = live->read();
    EXPECT_EQ(light_of(reading.view(), 7), 6.0f);
    EXPECT_EQ(reading.view().layers[1].weight, 0.5f);
}

TEST(LiveLight, PublishesNothingBeforeTheLastProbe) {
    const ProbeVolume volume = constant_layers(50);
    auto live = LiveLight::make(volume.view());
    ASSERT_TRUE(live);
    ASSERT_TRUE(live->begin(std::vector<float>{0.0f, 0.0f, 1.0f}));
    for (uint32_t done = 0; done < 40; done += 10) {
        EXPECT_FALSE(live->step(10));
        for (size_t i = 0; i < 50; ++i) EXPECT_EQ(light_of(live->read().view(), i), 7.0f);
    }
    EXPECT_TRUE(live->step(10));
    for (size_t i = 0; i < 50; ++i) EXPECT_EQ(light_of(live->read().view(), i), 4.0f);
    EXPECT_TRUE(live->step(10));  // nothing to do
}

TEST(LiveLight, WaitsForReadersOfTheSetThatItWouldOverwrite) {
    const ProbeVolume volume = constant_layers(50);
    auto live = LiveLight::make(volume.view());
    ASSERT_TRUE(live);
    const auto change = [&](float weight) {
        ASSERT_TRUE(live->begin(std::vector<float>{weight, 0.0f, 0.0f}));
    };
    change(2.0f);
    {
        const auto old = live->read();
        EXPECT_TRUE(live->step(50));  // into the other set
        change(3.0f);
        EXPECT_FALSE(live->step(50));  // that is read
        EXPECT_EQ(light_of(old.view(), 3), 7.0f);
        EXPECT_EQ(light_of(live->read().view(), 3), 2.0f);
    }
    EXPECT_TRUE(live->step(50));
    EXPECT_EQ(light_of(live->read().view(), 3), 3.0f);
}

TEST(LiveLight, QueriesReadTheNewLightInHalfPrecision) {
    const ProbeVolume volume = constant_layers(50);
    auto live = LiveLight::make(volume.view());
    ASSERT_TRUE(live && live->begin(std::vector<float>{1.0f, 0.0f, 0.5f}));
    ASSERT_TRUE(live->step(50));
    const auto reading = live->read();
    const glm::vec3 position(0.1f, 0.0f, 0.2f);
    const auto answer = interpolate(reading.view(), locate(reading.view(), position));
    EXPECT_NEAR(answer.irradiance.coefficients[4].y, 3.0f, 1e-5f);
}

TEST(LiveLight, RefusesWhatRecombineRefuses) {
    const ProbeVolume volume = constant_layers(5);
    auto live = LiveLight::make(volume.view());
    ASSERT_TRUE(live);
    EXPECT_FALSE(live->begin(std::vector<float>{1.0f, -1.0f, 1.0f}));
    EXPECT_FALSE(LiveLight::make(test::make_lit_volume(test::random_positions(5, 1)).view()));
}

/// For ThreadSanitizer too: nobody ever sees two lights in one reading.
TEST(LiveLight, ReadersOnOtherThreadsSeeWholeLightsOnly) {
    const ProbeVolume volume = constant_layers(200);
    auto live = LiveLight::make(volume.view());
    ASSERT_TRUE(live);
    std::atomic<bool> is_over = false;
    std::atomic<uint32_t> mixed_count = 0;
    const auto watch = [&] {
        while (!is_over.load()) {
            const auto reading = live->read();
            const float first = light_of(reading.view(), 0);
            for (size_t i = 0; i < 200; i += 7) {
                if (light_of(reading.view(), i) != first) ++mixed_count;
            }
        }
    };
    std::thread a(watch), b(watch);
    for (int change = 0; change < 300; ++change) {
        const auto weight = static_cast<float>(change % 17);
        ASSERT_TRUE(live->begin(std::vector<float>{weight, 0.0f, 0.0f}));
        for (int i = 0; i < 1000 && !live->step(37); ++i) std::this_thread::yield();
    }
    is_over = true;
    a.join();
    b.join();
    EXPECT_EQ(mixed_count.load(), 0u);
}

}  // namespace
}  // namespace tetralight
