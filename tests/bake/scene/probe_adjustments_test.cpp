// SPDX-License-Identifier: Apache-2.0
// Adjustment volumes from files: JSON and glTF nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tetralight/bake/scene/probe_adjustments_json.h>
#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

Result<std::vector<ProbeAdjustment>> read(const std::string& text) {
    const TempFolder folder;
    auto result = read_probe_adjustments(folder.write("a.json", std::as_bytes(std::span(text))));
    if (result) return result;
    const std::string& message = error_text(result.error());
    return Error{result.error().code, message.substr(message.find("a.json: ") + 8)};
}

std::string error_of(const std::string& text) {
    const auto result = read(text);
    return result ? "(no error)" : error_text(result.error());
}

std::string one(const std::string& keys) {
    return R"({"adjustments": [{"name": "a", )" + keys + "}]}";
}

TEST(ProbeAdjustments, AreReadFromJson) {
    const auto all = read(R"({"adjustments": [
        {"name": "a", "shape": "box", "center": [1, 2, 3], "size": [2, 4, 6], "forbid": true},
        {"name": "b", "shape": "sphere", "radius": 2, "spacing": 0.5, "validity": 1,
         "intensity": 0.25}]})");
    ASSERT_TRUE(all) << error_text(all.error());
    ASSERT_EQ(all->size(), 2u);
    EXPECT_EQ((*all)[0].forbids_probes, true);
    EXPECT_TRUE(contains((*all)[0], {1.9, 3.9, 5.9}));
    EXPECT_FALSE(contains((*all)[0], {2.1, 2, 3}));
    EXPECT_DOUBLE_EQ(volume_of((*all)[0]), 48.0);
    EXPECT_EQ((*all)[1].spacing, 0.5);
    EXPECT_EQ((*all)[1].validity, 1.0f);
    EXPECT_EQ((*all)[1].intensity, 0.25f);
    EXPECT_TRUE(contains((*all)[1], {1.1, 1.1, 1.1}));
    EXPECT_FALSE(contains((*all)[1], {1.2, 1.2, 1.2}));
    EXPECT_NEAR(volume_of((*all)[1]), 32.0 / 3.0 * std::numbers::pi, 1e-12);
}

TEST(ProbeAdjustments, OfEachSettingTheSmallestVolumeWins) {
    const auto all = read(R"({"adjustments": [
        {"name": "large", "shape": "box", "size": [9, 9, 9], "intensity": 2, "validity": 0,
         "rendering_layers": [0]},
        {"name": "small", "shape": "sphere", "radius": 1, "intensity": 3, "forbid": true,
         "rendering_layers": [1, 2]}]})");
    ASSERT_TRUE(all);
    const AdjustmentAt middle = adjustment_at(*all, {0, 0, 0});
    EXPECT_EQ(middle.intensity, 3.0f);
    EXPECT_EQ(middle.validity, 0.0f);
    EXPECT_TRUE(middle.forbids_probes);
    EXPECT_EQ(middle.rendering_layers, 0b110u);
    const AdjustmentAt beside = adjustment_at(*all, {2, 0, 0});
    EXPECT_EQ(beside.intensity, 2.0f);
    EXPECT_FALSE(beside.forbids_probes);
    EXPECT_EQ(beside.rendering_layers, 0b1u);
    EXPECT_EQ(adjustment_at(*all, {9, 0, 0}).intensity, 1.0f);
    EXPECT_FALSE(adjustment_at(*all, {9, 0, 0}).rendering_layers);
}

TEST(ProbeAdjustments, ErrorsNameTheVolumeAndTheValue) {
    const std::string place = "adjustment volume \"a\": ";
    EXPECT_EQ(error_of(one(R"("shape": "cone", "forbid": true)")),
              place + "shape \"cone\" is not \"box\" or \"sphere\"");
    EXPECT_EQ(error_of(one(R"("forbid": true)")), place + "shape is missing");
    EXPECT_EQ(error_of(one(R"("shape": "box", "radius": 1, "forbid": true)")),
              place + "radius does not fit the shape");
    EXPECT_EQ(error_of(one(R"("shape": "box", "spacing": 0)")),
              place + "spacing 0 is not a positive length");
    EXPECT_EQ(error_of(one(R"("shape": "box", "validity": 1.5)")),
              place + "validity 1.5 is not from 0 to 1");
    EXPECT_EQ(error_of(one(R"("shape": "box", "intensity": -1)")),
              place + "intensity -1 is negative or not finite");
    for (const char* layers : {"[]", "[32]", "[-1]", "[0.5]", "[\"a\"]", "3", "null"}) {
        EXPECT_EQ(
            error_of(one(R"("shape": "box", "rendering_layers": )" + std::string(layers))),
            place + "rendering_layers is not a list of rendering layers, 0 to 31 (" + layers + ")");
    }
    EXPECT_EQ(error_of(one(R"("shape": "box", "size": [1, 2], "forbid": true)")),
              place + "size is not three numbers ([1,2])");
    EXPECT_EQ(error_of(one(R"("shape": "box", "forbids": true)")),
              place + "unknown key \"forbids\"");
    EXPECT_EQ(error_of(R"({"adjustments": 7})"), "adjustments is missing or not an array");
    EXPECT_EQ(error_of(R"({"adjustments": [{"shape": "box"}]})"), "adjustment 0: has no name");
    EXPECT_EQ(error_of(R"({"adjustments": [{"name": "a", "shape": "box", "forbid": true},
                                           {"name": "a", "shape": "box", "forbid": true}]})"),
              "two adjustment volumes are named \"a\"");
    EXPECT_EQ(error_of(one(R"("shape": "box", "forbid": true, "forbid": false)")),
              "\"forbid\" is given twice in one object");
    EXPECT_NE(error_of("{"), "(no error)");
}

TEST(ProbeAdjustments, AreReadFromGltfNodes) {
    GltfBuilder gltf;
    gltf.add_root({{"name", "cellar"},
                   {"translation", {0, -2, 0}},
                   {"scale", {2, 1, 1}},
                   {"extras",
                    {{"probe_adjustment",
                      {{"shape", "box"},
                       {"size", {4, 3, 4}},
                       {"forbid", true},
                       {"rendering_layers", {2}}}}}}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->probe_adjustments.size(), 1u);
    const ProbeAdjustment& cellar = scene->probe_adjustments[0];
    EXPECT_EQ(cellar.name, "cellar");
    EXPECT_EQ(cellar.forbids_probes, true);
    EXPECT_EQ(cellar.rendering_layers, 0b100u);
    EXPECT_DOUBLE_EQ(volume_of(cellar), 8.0 * 3.0 * 4.0);
    EXPECT_TRUE(contains(cellar, {3.9, -3.4, 0}));
    EXPECT_FALSE(contains(cellar, {0, 0, 0}));
}

TEST(ProbeAdjustments, OfGltfNodesAreCheckedToo) {
    const auto error_with = [](const nlohmann::json& extras) {
        GltfBuilder gltf;
        gltf.add_root({{"name", "cellar"}, {"extras", {{"probe_adjustment", extras}}}});
        const auto scene = gltf.read();
        return scene ? std::string("(no error)") : error_text(scene.error());
    };
    const auto has = [](const std::string& message, const char* part) {
        return message.find(part) != std::string::npos;
    };
    EXPECT_TRUE(has(error_with({{"shape", "cone"}}), "\"cone\" is not \"box\" or \"sphere\""));
    EXPECT_TRUE(has(error_with({{"shape", "box"}}), "\"cellar\": it adjusts nothing"));
    EXPECT_TRUE(has(error_with({{"shape", "box"}, {"spacing", "x"}}), "spacing"));
    EXPECT_TRUE(has(error_with({{"forbid", true}}), "shape"));
}

}  // namespace
}  // namespace tetralight
