// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <tetralight/reflection/detail/reflection_json.h>
#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

using nlohmann::json;

template <class Vector>
json list_of(const Vector& v) {
    return json::array({v.x, v.y, v.z});
}

TEST(ReflectionJson, HasWhatTheProbesHave) {
    const Reflections reflections = test::make_small_reflections();
    const json document = json::parse(detail::reflection_json(reflections));
    EXPECT_EQ(document["version"], 1);
    EXPECT_EQ(document["units"]["length"], "m");
    EXPECT_EQ(document["roughness"], json::array({0.0, 1.0}));
    ASSERT_EQ(document["probes"].size(), 2u);
    const json& hall = document["probes"][0];
    const ReflectionProbe& probe = reflections.probes[0];
    EXPECT_EQ(hall["name"], "hall \"A\"");
    EXPECT_EQ(hall["position"], list_of(probe.position));
    EXPECT_EQ(hall["importance"], 7);
    EXPECT_EQ(hall["blend_distance"].get<float>(), probe.blend_distance);
    EXPECT_EQ(hall["validity"].get<float>(), probe.validity);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(hall["box"]["center"][i].get<float>(), probe.box_center[i]);
        EXPECT_EQ(hall["box"]["half_size"][i].get<float>(), probe.half_size[i]);
        EXPECT_EQ(hall["box"]["axes"][i][1].get<float>(), probe.axes[static_cast<size_t>(i)].y);
    }
    ASSERT_EQ(hall["irradiance_sh"].size(), 9u);
    EXPECT_EQ(hall["irradiance_sh"][8][2].get<float>(), probe.irradiance.coefficients[8].z);
    EXPECT_EQ(document["probes"][1]["box"], nullptr);  // everywhere
    EXPECT_EQ(document["probes"][1]["name"], "sky\\dome é");
}

TEST(ReflectionJson, IsValidForAnyName) {
    Reflections reflections = test::make_small_reflections();
    for (char c = 1; c < 127; ++c) {
        reflections.names[0] = std::string(1, c) + c;
        const json document = json::parse(detail::reflection_json(reflections));
        EXPECT_EQ(document["probes"][0]["name"], reflections.names[0]);
    }
    reflections.names.clear();
    EXPECT_EQ(json::parse(detail::reflection_json(reflections))["probes"][1]["name"], "");
}

}  // namespace
}  // namespace tetralight
