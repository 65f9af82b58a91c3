// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>

#include <tetralight/engines/export_target.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

ExportedVolume exported(const ProbeVolume& volume) {
    auto exported = find_export_target("unity")->make(volume.view(), {.name = "court"});
    EXPECT_TRUE(exported);
    EXPECT_EQ(exported->files.size(), 2u);
    return std::move(*exported);
}

/// Unity's shaders: SHA = (c3, c1, c2, c0 − c6), SHB = (c4, c5, 3 c6, c7), SHC = c8, with
/// dot(SHA, (n, 1)) + dot(SHB, (xy, yz, zz, zx)) + SHC (xx − yy).
double shade(const nlohmann::json& coefficients, size_t probe, size_t channel, glm::dvec3 n) {
    const auto c = [&](size_t i) { return coefficients[27 * probe + 9 * channel + i]; };
    const auto d = [&](size_t i) { return c(i).get<double>(); };
    const double linear = d(3) * n.x + d(1) * n.y + d(2) * n.z + d(0) - d(6);
    const double quadratic =
        d(4) * n.x * n.y + d(5) * n.y * n.z + 3.0 * d(6) * n.z * n.z + d(7) * n.z * n.x;
    return linear + quadratic + d(8) * (n.x * n.x - n.y * n.y);
}

TEST(ExportUnity, ShadesAsWeDo) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(40, 1));
    volume.occlusion.assign(40, glm::vec4(0.25f, 1.0f, 0.0f, 0.5f));
    const auto json = nlohmann::json::parse(exported(volume).files[0].content);
    ASSERT_EQ(json["positions"].size(), 3u * 40);
    ASSERT_EQ(json["coefficients"].size(), 27u * 40);
    ASSERT_EQ(json["occlusion"].size(), 4u * 40);
    EXPECT_EQ(json["occlusion"][4 * 7].get<float>(), 0.25f);
    std::mt19937_64 engine(1);
    for (size_t i = 0; i < 40; ++i) {
        EXPECT_EQ(json["positions"][3 * i].get<float>(), -volume.positions[i].x);
        EXPECT_EQ(json["positions"][3 * i + 1].get<float>(), volume.positions[i].y);
        EXPECT_EQ(json["positions"][3 * i + 2].get<float>(), volume.positions[i].z);
        for (int k = 0; k < 20; ++k) {
            const glm::vec3 normal = test::random_direction(engine);
            const glm::vec3 light =
                evaluate_irradiance(volume.irradiance[i], normal) / std::numbers::pi_v<float>;
            const glm::dvec3 mirrored(-normal.x, normal.y, normal.z);
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(shade(json["coefficients"], i, static_cast<size_t>(channel), mirrored),
                            light[channel], 2e-5);
            }
        }
    }
}

TEST(ExportUnity, WritesVolumesWithoutLightOrProbes) {
    ProbeVolume volume = test::make_lit_volume({{1, 2, 3}});
    volume.irradiance.clear();
    volume.info.ambient = irradiance_from_radiance(constant_radiance(glm::vec3(0.5f)));
    const auto json = nlohmann::json::parse(exported(volume).files[0].content);
    EXPECT_NEAR(json["coefficients"][0].get<double>(), 0.5, 1e-6);
    EXPECT_TRUE(json["occlusion"].empty());
    const auto none = nlohmann::json::parse(exported(ProbeVolume{}).files[0].content);
    EXPECT_TRUE(none["positions"].empty());
}

TEST(ExportUnity, SaysHowFarRoundingMovesProbes) {
    EXPECT_TRUE(exported(test::make_lit_volume(test::random_positions(9, 1))).notes.empty());
    std::vector<glm::dvec3> positions = test::random_positions(9, 1);
    for (glm::dvec3& p : positions) p.x += 1e6;
    const auto notes = exported(test::make_lit_volume(positions)).notes;
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("rounding moves probes by up to 0.0"), std::string::npos);
}

/// Not a compiler: brackets are balanced outside of strings and comments, and every member that the
/// script reads is in the JSON.
TEST(ExportUnity, TheScriptIsBalanced) {
    const ExportedVolume files = exported(test::make_lit_volume(test::random_positions(9, 1)));
    EXPECT_EQ(files.files[1].name, "TetralightProbes.cs");
    const std::string& script = files.files[1].content;
    std::string open;
    bool is_text = false;
    for (size_t i = 0; i < script.size(); ++i) {
        const char c = script[i];
        if (!is_text && script.compare(i, 2, "//") == 0) i = script.find('\n', i);
        if (c == '"') is_text = !is_text;
        if (is_text || c == '"') {
            EXPECT_NE(c, '\n');
            continue;
        }
        if (c == '(' || c == '[' || c == '{') open += c == '(' ? ')' : c == '[' ? ']' : '}';
        if (c != ')' && c != ']' && c != '}') continue;
        ASSERT_FALSE(open.empty());
        ASSERT_EQ(open.back(), c) << script.substr(0, i);
        open.pop_back();
    }
    EXPECT_TRUE(open.empty());
    EXPECT_FALSE(is_text);
    const auto json = nlohmann::json::parse(files.files[0].content);
    for (const char* member : {"format", "version", "positions", "coefficients"}) {
        EXPECT_NE(script.find(std::string(" ") + member + ";"), std::string::npos) << member;
        EXPECT_TRUE(json.contains(member));
    }
}

}  // namespace
}  // namespace tetralight
