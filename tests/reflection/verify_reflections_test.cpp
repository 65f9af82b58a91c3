// SPDX-License-Identifier: Apache-2.0
#include <tetralight/reflection/reflection_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <tetralight/base/error_text.h>
#include "tests/reflection/reflection_fixture.h"

namespace tetralight {
namespace {

const float kNan = std::nanf(""), kInfinity = HUGE_VALF;

/// The field of the error after a change; empty if there is none.
std::string wrong_field(const std::function<void(Reflections&)>& change) {
    Reflections reflections = test::make_small_reflections();
    change(reflections);
    const Status status = verify(reflections.view());
    if (status) return {};
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    EXPECT_NE(error_text(status.error()).find(status.error().field), std::string::npos);
    return status.error().field;
}

std::string wrong_member(const std::function<void(ReflectionProbe&)>& change) {
    return wrong_field([&](Reflections& r) { change(r.probes[0]); });
}

TEST(VerifyReflections, AcceptsSoundProbes) {
    EXPECT_EQ(wrong_field([](Reflections&) {}), "");
    EXPECT_EQ(wrong_member([](ReflectionProbe& p) { p.blend_distance = 0.0f; }), "");
    EXPECT_EQ(wrong_member([](ReflectionProbe& p) { p.axes[0] = -p.axes[0]; }), "");
    EXPECT_EQ(wrong_member([](ReflectionProbe& p) { p.axes[0] *= 1.0004f; }), "");
}

TEST(VerifyReflections, NamesTheMemberOfTheProbe) {
    using Probe = ReflectionProbe;
    EXPECT_EQ(wrong_member([](Probe& p) { p.position.y = kNan; }), "probes[0].position");
    EXPECT_EQ(wrong_member([](Probe& p) { p.box_center.x = kInfinity; }), "probes[0].box_center");
    EXPECT_EQ(wrong_member([](Probe& p) { p.half_size.z = 0.0f; }), "probes[0].half_size");
    EXPECT_EQ(wrong_member([](Probe& p) { p.half_size.z = kInfinity; }), "probes[0].half_size");
    EXPECT_EQ(wrong_member([](Probe& p) { p.half_size.x = kNan; }), "probes[0].half_size");
    EXPECT_EQ(wrong_member([](Probe& p) { p.axes[1] *= 1.01f; }), "probes[0].axes");
    EXPECT_EQ(wrong_member([](Probe& p) { p.axes[1] = p.axes[2]; }), "probes[0].axes");
    EXPECT_EQ(wrong_member([](Probe& p) { p.axes[2].x = kNan; }), "probes[0].axes");
    EXPECT_EQ(wrong_member([](Probe& p) { p.blend_distance = -1.0f; }), "probes[0].blend_distance");
    EXPECT_EQ(wrong_member([](Probe& p) { p.blend_distance = kInfinity; }),
              "probes[0].blend_distance");
    EXPECT_EQ(wrong_member([](Probe& p) { p.validity = 1.5f; }), "probes[0].validity");
    EXPECT_EQ(wrong_member([](Probe& p) { p.validity = kNan; }), "probes[0].validity");
    EXPECT_EQ(wrong_member([](Probe& p) { p.irradiance.coefficients[8].z = kNan; }),
              "probes[0].irradiance");
    EXPECT_EQ(wrong_member([](Probe& p) { p.reserved[2] = 1; }), "probes[0].reserved");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.probes[1].position.x = kNan; }),
              "probes[1].position");
}

TEST(VerifyReflections, SizesMustAgree) {
    EXPECT_EQ(wrong_field([](Reflections& r) { r.size = 3; }), "size");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.size = 0; }), "size");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.size = 2 * kLargestCubeSize; }), "size");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels.clear(); }), "level_count");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels.resize(4); }), "level_count");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels.resize(3); }), "levels[2]");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels[1].pop_back(); }), "levels[1]");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.probes.pop_back(); }), "levels[0]");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.probes.clear(); }), "probes");
}

TEST(VerifyReflections, TexelsAreFiniteAndMetadataIsText) {
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels[0][7][1] = 0x7c00; }), "levels[0]");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels[1][7][3] = 0xffff; }), "levels[1]");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.levels[1][7][0] = 0x7bff; }), "");
    EXPECT_EQ(wrong_field([](Reflections& r) { r.metadata = "\x01"; }), "metadata");
}

TEST(VerifyReflections, ChecksLayers) {
    const auto field = [](const std::function<void(Reflections&)>& change) {
        Reflections reflections = test::make_layered_reflections();
        change(reflections);
        const Status status = verify(reflections.view());
        return status ? std::string() : status.error().field;
    };
    EXPECT_EQ(field([](Reflections&) {}), "");
    EXPECT_EQ(field([](Reflections& r) { r.layer_names = "sun\n"; }), "layer_names");
    EXPECT_EQ(field([](Reflections& r) { r.layers[1].weight = -1.0f; }), "layers[1].weight");
    EXPECT_EQ(field([](Reflections& r) { r.layers[0].weight = kNan; }), "layers[0].weight");
    EXPECT_EQ(field([](Reflections& r) { r.layers[0].reserved[2] = 1; }), "layers[0].reserved");
    EXPECT_EQ(field([](Reflections& r) { r.layer_irradiance.pop_back(); }), "layer_irradiance");
    EXPECT_EQ(field([](Reflections& r) { r.layer_irradiance[3].coefficients[1].x = kNan; }),
              "layer_irradiance[3]");
    EXPECT_EQ(field([](Reflections& r) { r.layer_levels[1].pop_back(); }), "layer_levels[1]");
    EXPECT_EQ(field([](Reflections& r) { r.layer_levels[0][5][2] = 0x7c00; }), "layer_levels[0]");
    EXPECT_EQ(field([](Reflections& r) { r.layers.clear(); }), "layer_names");
}

}  // namespace
}  // namespace tetralight
