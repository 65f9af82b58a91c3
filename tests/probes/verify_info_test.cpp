// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/layered_volume.h"

// Numbers of the right type and the wrong meaning: each would make queries or writers fail.

namespace tetralight {
namespace {

using Change = std::function<void(ProbeVolume&)>;

ProbeVolume make_volume() {
    ProbeVolume volume = test::make_layered_volume(20, 2);
    make_compact_probes(volume);
    for (const LightType type : {LightType::Directional, LightType::Point, LightType::Spot,
                                 LightType::Rectangle, LightType::Disc}) {
        Light& light = volume.lights.emplace_back();
        light.type = type;
        volume.light_names += "light\n";
    }
    return volume;
}

/// The field of the error of `verify`, after its code was checked.
std::string field_after(ProbeVolume volume, const Change& change) {
    change(volume);
    const Status status = verify(volume.view());
    EXPECT_FALSE(status);
    if (status) return {};
    EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
    return status.error().field;
}

std::string field_after(const Change& change) {
    return field_after(make_volume(), change);
}

ProbeVolume make_plane() {
    std::vector<glm::dvec3> positions = test::random_positions(20, 3);
    for (glm::dvec3& p : positions) p.y = 0.0;
    return test::make_lit_volume(positions);
}

TEST(VerifyInfo, AcceptsWhatIsRight) {
    for (const ProbeVolume& volume : {make_volume(), make_plane()}) {
        const Status status = verify(volume.view());
        EXPECT_TRUE(status) << error_text(status.error());
    }
}

TEST(VerifyInfo, AxesAreUnitVectorsWhereTheyAreUsed) {
    for (const double factor : {2.0, 1e306, -0.5, 0.0}) {
        EXPECT_EQ(field_after(make_plane(), [&](ProbeVolume& v) { v.info.axis *= factor; }),
                  "info.axis")
            << factor;
    }
    EXPECT_EQ(field_after(make_plane(), [](ProbeVolume& v) { v.info.axis.x = NAN; }), "info.axis");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.axis.y = 1.0; }), "info.axis");
}

TEST(VerifyInfo, TheExtentIsThatOfTheProbes) {
    for (const float extent : {0.0f, -1.0f, 3e38f, NAN, INFINITY}) {
        EXPECT_EQ(field_after([&](ProbeVolume& v) { v.info.extent = extent; }), "info.extent")
            << extent;
    }
}

TEST(VerifyInfo, NumbersAreInRange) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.world_origin.z = 1e30; }),
              "info.world_origin");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.world_origin.z = NAN; }),
              "info.world_origin");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.radial_fraction = 1.5f; }),
              "info.radial_fraction");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.ambient.coefficients[3].y = INFINITY; }),
              "info.ambient");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.compact_scale *= 1.5f; }),
              "info.compact_scale");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.seed_cube.min.x = -1e300; }),
              "info.seed_cube");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.info.seed_cube.scale = NAN; }), "info.seed_cube");
}

TEST(VerifyInfo, LightIsFiniteInEveryDirection) {
    for (const float bright : {3.4e38f, -3.4e38f, 1.1e37f, NAN}) {
        EXPECT_EQ(field_after([&](ProbeVolume& v) { v.info.ambient.coefficients[3].y = bright; }),
                  "info.ambient")
            << bright;
        EXPECT_EQ(field_after([&](ProbeVolume& v) { v.irradiance[2].coefficients[8].z = bright; }),
                  "irradiance[2]")
            << bright;
        EXPECT_EQ(
            field_after([&](ProbeVolume& v) { v.layers[1].ambient.coefficients[0].x = bright; }),
            "layers[1]")
            << bright;
    }
}

TEST(VerifyInfo, HealthIsInRange) {
    const auto health = [](const std::function<void(ProbeHealth&)>& change) {
        return field_after([&](ProbeVolume& v) {
            v.health.resize(v.positions.size());
            change(v.health[4]);
        });
    };
    EXPECT_EQ(health([](ProbeHealth& h) { h.is_dilated = 2; }), "health[4]");
    EXPECT_EQ(health([](ProbeHealth& h) { h.virtual_offset.y = 3.4e38f; }), "health[4]");
}

TEST(VerifyInfo, EveryProbeIsOnARenderingLayer) {
    const auto layers = [](const std::function<void(std::vector<uint32_t>&)>& change) {
        return field_after([&](ProbeVolume& v) {
            v.rendering_layers.assign(v.positions.size(), 0b1001);
            change(v.rendering_layers);
        });
    };
    EXPECT_EQ(layers([](std::vector<uint32_t>& all) { all[4] = 0; }), "rendering_layers[4]");
    EXPECT_EQ(layers([](std::vector<uint32_t>& all) { all.pop_back(); }), "rendering_layers");
}

TEST(VerifyInfo, LightsHaveTheNumbersOfTheirType) {
    const auto light = [](size_t index, const std::function<void(Light&)>& change) {
        return field_after([&](ProbeVolume& v) { change(v.lights[index]); });
    };
    EXPECT_EQ(light(0, [](Light& l) { l.direction = {0, 2, 0}; }), "lights[0]");
    EXPECT_EQ(light(1, [](Light& l) { l.intensity.y = -1.0f; }), "lights[1]");
    EXPECT_EQ(light(1, [](Light& l) { l.range = -1.0f; }), "lights[1]");
    EXPECT_EQ(light(2, [](Light& l) { l.cos_outer_cone = 1.5f; }), "lights[2]");
    EXPECT_EQ(light(2, [](Light& l) { l.cos_inner_cone = 0.1f; }), "lights[2]");
    EXPECT_EQ(light(3, [](Light& l) { l.tangent = l.direction; }), "lights[3]");
    EXPECT_EQ(light(3, [](Light& l) { l.width = -1.0f; }), "lights[3]");
    EXPECT_EQ(light(4, [](Light& l) { l.radius = -1.0f; }), "lights[4]");

    ProbeVolume volume = make_volume();
    volume.lights[1].direction = glm::vec3(0.0f);  // points shine in all directions
    EXPECT_TRUE(verify(volume.view()));
}

TEST(VerifyInfo, LayersAreWithinTheirBounds) {
    for (const float largest : {1e-30f, 0.0f, -1.0f, 3e38f}) {
        EXPECT_EQ(field_after([&](ProbeVolume& v) { v.layers[1].largest = largest; }), "layers[1]")
            << largest;
    }
}

TEST(VerifyInfo, NamesHoldNoControlCharacters) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.group_names = "\x1b[31mred\n"; }), "group_names");
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.layer_names = "sun\n\x07sky\n"; }), "layer_names");
    EXPECT_EQ(field_after([](ProbeVolume& v) {
                  v.group_names =
                      "\xc2\x9b"
                      "31mred\n";
              }),
              "group_names");
}

TEST(VerifyInfo, LayersHaveDifferentNames) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { v.layer_names = "sun\nsun\n"; }), "layer_names");
}

TEST(VerifyInfo, SourcesAreSorted) {
    EXPECT_EQ(field_after([](ProbeVolume& v) { std::swap(v.sources[0], v.sources[1]); }),
              "sources");
}

}  // namespace
}  // namespace tetralight
