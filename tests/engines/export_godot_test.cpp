// SPDX-License-Identifier: Apache-2.0
// Godot's resource, read by its text and evaluated as Godot's source does.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include <tetralight/base/error_text.h>
#include <tetralight/engines/export_target.h>
#include "tests/engines/godot_reader.h"
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

using test::GodotProbes;

ExportedVolume exported(const ProbeVolume& volume, const std::string& name = "court") {
    auto exported = find_export_target("godot")->make(volume.view(), {.name = name});
    EXPECT_TRUE(exported);
    EXPECT_EQ(exported->files.size(), 2u);
    return std::move(*exported);
}

/// Light that no interpolation over other cells gives.
ProbeVolume random_light(std::vector<glm::dvec3> positions, uint64_t seed) {
    ProbeVolume volume = test::make_lit_volume(std::move(positions));
    std::mt19937_64 engine(seed);
    for (IrradianceSh& light : volume.irradiance) {
        for (glm::vec3& c : light.coefficients) c = test::random_direction(engine);
        light.coefficients[0] += 3.0f;
    }
    return volume;
}

/// The largest difference of irradiance at places, ÷ the largest irradiance of the probes.
double worst_difference(const ProbeVolume& volume, const GodotProbes& godot,
                        const std::vector<glm::dvec3>& places) {
    std::mt19937_64 engine(3);
    double worst = 0.0;
    for (const glm::dvec3& place : places) {
        const glm::vec3 normal = test::random_direction(engine);
        const auto shown = godot.light(glm::vec3(place - volume.info.world_origin), normal);
        const glm::vec3 light =
            evaluate_irradiance(light_at(volume.view(), place, Walls::Ignore), normal);
        for (int channel = 0; channel < 3; ++channel) {
            const double difference =
                std::numbers::pi * shown[static_cast<size_t>(channel)] - light[channel];
            worst = std::max(worst, std::abs(difference));
        }
    }
    return worst / largest_irradiance(volume.view());
}

TEST(ExportGodot, ShowsTheLightInsideTheHull) {
    std::vector<glm::dvec3> lattice;
    for (int i = 0; i < 216; ++i) lattice.emplace_back(i % 6, i / 6 % 6, 0.7 * (i / 36));
    for (const auto& positions : {test::random_positions(400, 2), lattice}) {
        const ProbeVolume volume = random_light(positions, 4);
        const GodotProbes godot(exported(volume).files[0].content);
        const auto places = random_places(volume.view(), 10'000);
        ASSERT_EQ(places.size(), 10'000u);
        EXPECT_LE(worst_difference(volume, godot, places), 1e-5);
    }
}

TEST(ExportGodot, HoldsArraysOfOneLength) {
    const ProbeVolume volume = random_light(test::random_positions(50, 1), 1);
    const GodotProbes godot(exported(volume).files[0].content);
    EXPECT_EQ(godot.points.size(), 3u * (volume.positions.size() + 8));
    EXPECT_EQ(godot.sh.size(), 36u * (volume.positions.size() + 8));
    EXPECT_EQ(godot.tetrahedra.size() % 4, 0u);
    EXPECT_EQ(godot.bsp.size() % 6, 0u);
    EXPECT_EQ(godot.interior, "false,");
    EXPECT_EQ(godot.baked_exposure, "1.0,");
    for (size_t node = 0; node < godot.bsp.size() / 6; ++node) {
        for (const double child : {godot.bsp[6 * node + 4], godot.bsp[6 * node + 5]}) {
            if (child >= 0.0) {
                EXPECT_GT(child, static_cast<double>(node));
            }
        }
    }
}

/// Corners of the bounds have the light of the volume, and what is between is between.
TEST(ExportGodot, OutsideIsFilledUpToTheBounds) {
    const ProbeVolume volume = random_light(test::random_positions(100, 11), 5);
    const GodotProbes godot(exported(volume).files[0].content);
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 8; ++i) {
        corners.push_back(godot.low + glm::dvec3(i & 1, i >> 1 & 1, i >> 2) * godot.size);
    }
    EXPECT_LE(worst_difference(volume, godot, corners), 1e-5);
    std::mt19937_64 engine(8);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const double largest = largest_irradiance(volume.view());
    for (int i = 0; i < 10'000; ++i) {
        const double x = share(engine), y = share(engine), z = share(engine);
        const glm::vec3 place(godot.low + glm::dvec3(x, y, z) * godot.size);
        ASSERT_GE(godot.find(place), 0);
        const auto light = godot.light(place, test::random_direction(engine));
        for (const double channel : light) {
            // 14 normals do not find the largest irradiance of all.
            EXPECT_LE(std::abs(std::numbers::pi * channel), 1.2 * largest);
        }
    }
}

TEST(ExportGodot, WritesVolumesOfEveryDimension) {
    const std::vector<glm::dvec3> volumes[] = {
        {{0, 1, 0}, {4, 1, 0}, {0, 1, 5}, {6, 1, 7}, {1, 1, 2}},
        {{0, 1, 0}, {4, 2, 1}, {8, 3, 2}, {2, 1.5, 0.5}},
        {{1, 2, 3}}};
    for (const auto& positions : volumes) {
        const ProbeVolume volume = random_light(positions, 6);
        const ExportedVolume files = exported(volume);
        const GodotProbes godot(files.files[0].content);
        const auto places = random_places(volume.view(), 1000);
        EXPECT_FALSE(places.empty());
        EXPECT_LE(worst_difference(volume, godot, places), 1e-5);
    }
    const auto none = find_export_target("godot")->make(ProbeVolume{}.view(), {});
    ASSERT_FALSE(none);
    EXPECT_EQ(error_text(none.error().message), "has no probes; Godot needs at least one");
}

TEST(ExportGodot, VolumesWithoutLightShowTheAmbientLight) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(20, 1));
    volume.irradiance.clear();
    volume.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(0.25f)));
    const GodotProbes godot(exported(volume).files[0].content);
    const auto light = godot.light(glm::vec3(0.1f), glm::vec3(0, 1, 0));
    for (const double channel : light) EXPECT_NEAR(channel, 0.25, 1e-6);
}

TEST(ExportGodot, MeasuresItsDifference) {
    const ExportedVolume files = exported(random_light(test::random_positions(300, 3), 2));
    ASSERT_TRUE(files.difference);
    EXPECT_EQ(files.difference->place_count, kDifferencePlaces);
    EXPECT_LE(files.difference->without_walls.p99, 1e-5);
    EXPECT_EQ(files.notes.size(), 1u);
}

TEST(ExportGodot, PositionsFarAwayAreRelativeToTheirOrigin) {
    std::vector<glm::dvec3> positions = test::random_positions(60, 3);
    for (glm::dvec3& p : positions) p += glm::dvec3(1e7, 0, -3e6);
    const ProbeVolume volume = random_light(positions, 9);
    const ExportedVolume files = exported(volume);
    ASSERT_EQ(files.notes.size(), 2u);
    EXPECT_NE(files.notes[1].find("put a LightmapGI node there"), std::string::npos);
    const GodotProbes godot(files.files[0].content);
    // Positions of queries are floats, of steps of 1 m there: the places of the probes' own floats.
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(static_cast<float>(godot.points[3 * i + static_cast<size_t>(axis)]),
                      volume.positions[i][axis]);
        }
    }
    EXPECT_NE(files.files[1].content.find("const ORIGIN := Vector3(1"), std::string::npos);
}

TEST(ExportGodot, TheScriptNamesTheResource) {
    const ExportedVolume files =
        exported(test::make_lit_volume(test::random_positions(8, 1)), "a \"b\"\n");
    EXPECT_EQ(files.files[0].name, "a \"b\"\n.tres");
    EXPECT_EQ(files.files[1].name, "a \"b\"\n.gd");
    const std::string& script = files.files[1].content;
    EXPECT_NE(script.find("preload(\"a \\\"b\\\"\\u000a.tres\")"), std::string::npos);
    for (const char* call : {"lightmap_set_probe_capture_data", "lightmap_set_probe_bounds",
                             "lightmap_set_probe_interior"}) {
        EXPECT_NE(script.find(call), std::string::npos);
    }
    EXPECT_NE(script.find("Vector3(0, 0, 0)"), std::string::npos);
}

}  // namespace
}  // namespace tetralight
