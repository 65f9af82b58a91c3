// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/cycles_referee.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>
#include <tetralight/verify/html.h>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string>
#include <vector>
#include "tests/support/blender.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using nlohmann::json;

constexpr double kBase = 0.5, kRoughness = 0.6;
constexpr std::array<double, 3> kEmission{0.5, 1.0, 0.25};

template <class T>
std::string uri_of(const std::vector<T>& values) {
    return data_uri("application/octet-stream", std::as_bytes(std::span(values)));
}

/// A closed cube around the origin whose front faces look inwards: all of it emits and reflects.
std::string room_gltf() {
    std::vector<float> positions;
    for (int i = 0; i < 8; ++i) {
        for (const int bit : {1, 2, 4}) positions.push_back((i & bit) != 0 ? 1.0f : -1.0f);
    }
    const std::vector<uint16_t> indices{0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                        2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5};
    std::vector<uint16_t> inward;
    for (size_t i = 0; i < indices.size(); i += 3) {
        // The normal of corners a, b, c has to point to the origin.
        const auto corner = [&](size_t k) {
            const float* p = &positions[size_t{indices[i + k]} * 3];
            return glm::vec3(p[0], p[1], p[2]);
        };
        const glm::vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        const bool is_inward = glm::dot(normal, corner(0)) < 0.0f;
        inward.insert(inward.end(), {indices[i], indices[i + (is_inward ? 1 : 2)],
                                     indices[i + (is_inward ? 2 : 1)]});
    }
    const size_t position_bytes = positions.size() * 4, index_bytes = inward.size() * 2;
    const json gltf{{"asset", {{"version", "2.0"}}},
                    {"scene", 0},
                    {"scenes", {{{"nodes", {0}}}}},
                    {"nodes", {{{"mesh", 0}}}},
                    {"meshes",
                     {{{"primitives",
                        {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
                    {"materials",
                     {{{"pbrMetallicRoughness",
                        {{"baseColorFactor", {kBase, kBase, kBase, 1.0}},
                         {"metallicFactor", 0.0},
                         {"roughnessFactor", kRoughness}}},
                       {"emissiveFactor", kEmission}}}},
                    {"accessors",
                     {{{"bufferView", 0},
                       {"componentType", 5126},
                       {"count", 8},
                       {"type", "VEC3"},
                       {"min", {-1, -1, -1}},
                       {"max", {1, 1, 1}}},
                      {{"bufferView", 1},
                       {"componentType", 5123},
                       {"count", inward.size()},
                       {"type", "SCALAR"}}}},
                    {"bufferViews",
                     {{{"buffer", 0}, {"byteLength", position_bytes}},
                      {{"buffer", 1}, {"byteLength", index_bytes}}}},
                    {"buffers",
                     {{{"byteLength", position_bytes}, {"uri", uri_of(positions)}},
                      {{"byteLength", index_bytes}, {"uri", uri_of(inward)}}}}};
    return gltf.dump();
}

CyclesJob job_at(const glm::dvec3& position, std::string scene_path) {
    CyclesJob job;
    job.scene_path = std::move(scene_path);
    job.positions = {position};
    job.target_errors = {0.01};
    job.thread_count = 2;
    return job;
}

/// In a closed room of equal surfaces all radiance is emission / (1 − albedo).
TEST(CyclesReferee, LightsAFurnace) {
    if (!test::has_blender()) GTEST_SKIP() << "Blender is not installed";
    const TempFolder folder;
    Scene scene;
    const auto result = trace_by_cycles(
        scene, {}, job_at({0.2, -0.1, 0.3}, folder.write("a room.gltf", room_gltf())));
    ASSERT_TRUE(result) << error_text(result.error());
    const double albedo = 0.96 * kBase + 0.04 * 0.5 * kRoughness;
    ASSERT_EQ(result->lights.size(), 1u);
    for (int c = 0; c < 3; ++c) {
        // The mean irradiance of constant radiance L is π L.
        const double expected =
            std::numbers::pi * kEmission[static_cast<size_t>(c)] / (1.0 - albedo);
        const TracedLight& light = result->lights[0];
        EXPECT_NEAR(light.mean[c], expected, 4.0 * light.error[c] + 1e-3 * expected) << c;
    }
    EXPECT_EQ(result->referee.rfind("Cycles ", 0), 0u);
}

TEST(CyclesReferee, SaysWhatBlenderDoesNotImport) {
    if (!test::has_blender()) GTEST_SKIP() << "Blender is not installed";
    const TempFolder folder;
    const auto result =
        trace_by_cycles(Scene{}, {}, job_at({0, 0, 0}, folder.write("bad.gltf", "{}")));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Unsupported);
}

TEST(CyclesReferee, NamesBlenderWhereItIsMissing) {
    CyclesJob job = job_at({0, 0, 0}, "room.gltf");
    job.blender = "/nowhere/blender";
    const auto result = trace_by_cycles(Scene{}, {}, job);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().field, "blender");
    EXPECT_NE(error_text(result.error()).find("/nowhere/blender"), std::string::npos);
}

TEST(CyclesReferee, RefusesDirectLight) {
    Scene scene;
    scene.lights.resize(1);
    scene.light_names = {"lamp"};
    const auto result = trace_by_cycles(scene, {LightMode::Baked}, job_at({0, 0, 0}, "room.gltf"));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().field, "lights");
    EXPECT_NE(error_text(result.error()).find("lamp"), std::string::npos);
}

/// Rounds with mean irradiances 1 and 3: the mean is 2, its standard error √2 / √2.
TEST(CyclesReferee, ErrorsFollowFromRounds) {
    std::vector<RadianceSh> rounds(2);
    // Mean irradiance π L of radiance L, whose first coefficient is L √(4π).
    const double radiance = std::numbers::inv_pi;
    const auto first = static_cast<float>(radiance * std::sqrt(4.0 * std::numbers::pi));
    rounds[0].coefficients[0] = glm::vec3(first);
    rounds[1].coefficients[0] = glm::vec3(3.0f * first);
    const TracedLight light = mean_of_rounds(rounds, 7);
    EXPECT_NEAR(light.mean.x, 2.0, 1e-6);
    EXPECT_NEAR(light.error.y, 1.0, 1e-6);
    EXPECT_EQ(light.sample_count, 7u);
}

}  // namespace
}  // namespace tetralight
