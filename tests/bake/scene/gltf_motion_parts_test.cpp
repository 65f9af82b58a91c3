// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_motion_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

using Json = GltfBuilder::Json;
using Names = std::vector<std::string>;

/// A triangle "door" with two animations of its translation, "open" and "close".
GltfBuilder moving_door() {
    GltfBuilder gltf;
    gltf.add_root({{"name", "door"}, {"mesh", gltf.add_triangle()}});
    for (const char* name : {"open", "close"}) {
        const size_t times = gltf.add_floats({0, 2}, "SCALAR");
        const size_t places = gltf.add_floats({0, 0, 0, 1, 0, 0}, "VEC3");
        const Json target = {{"node", 0}, {"path", "translation"}};
        gltf.add("animations", {{"name", name},
                                {"samplers", {{{"input", times}, {"output", places}}}},
                                {"channels", {{{"sampler", 0}, {"target", target}}}}});
    }
    return gltf;
}

Scene read(const GltfBuilder& gltf, const SceneReading& reading = {}) {
    auto scene = gltf.read(reading);
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
    return scene ? *scene : Scene();
}

/// The part of this name and use; an empty one if there is none.
ScenePart part(const Scene& scene, const std::string& name, PartUse use) {
    const auto found = std::ranges::find_if(
        scene.parts, [&](const ScenePart& row) { return row.name == name && row.use == use; });
    return found == scene.parts.end() ? ScenePart() : *found;
}

TEST(GltfMotionParts, WithoutATimeAllAnimationsAreIgnored) {
    const Scene scene = read(moving_door());
    const ScenePart ignored = part(scene, "animations", PartUse::Ignored);
    EXPECT_EQ(ignored.elements, (Names{"animation 0 \"open\"", "animation 1 \"close\""}));
    EXPECT_EQ(ignored.remedy, "--time SECONDS reads the scene at a time of an animation");
    EXPECT_FALSE(ignored.changes_light);
    EXPECT_EQ(part(scene, "animations", PartUse::Read).count, 0u);
}

TEST(GltfMotionParts, WithATimeOneAnimationIsRead) {
    const Scene scene = read(moving_door(), {.time = 1.0, .animation = "close"});
    EXPECT_EQ(part(scene, "animations", PartUse::Read).elements, Names{"animation 1 \"close\""});
    const ScenePart ignored = part(scene, "animations", PartUse::Ignored);
    EXPECT_EQ(ignored.elements, Names{"animation 0 \"open\""});
    EXPECT_EQ(ignored.remedy, "--animation NAME reads this one instead");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMotionParts, WarnsOfWhatTheChosenAnimationMovesAndIsNotRead) {
    for (const char* path : {"color", "pointer"}) {
        GltfBuilder gltf = moving_door();
        gltf.json["animations"][0]["channels"][0]["target"]["path"] = path;
        EXPECT_TRUE(read(gltf).warnings.empty()) << path;
        EXPECT_TRUE(read(gltf, {.time = 1.0, .animation = "close"}).warnings.empty()) << path;
        const Scene scene = read(gltf, {.time = 1.0});
        const std::string name = std::string(path) == "color" ? "animated \"color\""
                                                              : "channels of KHR_animation_pointer";
        const ScenePart ignored = part(scene, name, PartUse::Ignored);
        EXPECT_EQ(ignored.elements, Names{"animation 0 \"open\", channel 0"}) << path;
        EXPECT_TRUE(ignored.changes_light) << path;
        EXPECT_EQ(scene.warnings.size(), 1u) << path;
    }
}

TEST(GltfMotionParts, ChannelsWithoutANodeChangeNothing) {
    GltfBuilder gltf = moving_door();
    gltf.json["animations"][0]["channels"][0]["target"].erase("node");
    const Scene scene = read(gltf, {.time = 1.0});
    EXPECT_EQ(part(scene, "channels without a node", PartUse::Ignored).count, 1u);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfMotionParts, CountsNodesThatSkinsAndMorphTargetsDeform) {
    GltfBuilder gltf = moving_door();
    Json& primitive = gltf.primitive(0);
    primitive["targets"] = {{{"POSITION", gltf.add_floats(std::vector<float>(9, 0.5f), "VEC3")}}};
    EXPECT_EQ(part(read(gltf), "morph targets", PartUse::Read).count, 0u);
    gltf.json["nodes"][0]["weights"] = {0.5};
    EXPECT_EQ(part(read(gltf), "morph targets", PartUse::Read).elements, Names{"node 0 \"door\""});
    EXPECT_EQ(part(read(gltf), "skins", PartUse::Read).count, 0u);
    primitive["attributes"]["JOINTS_0"] =
        gltf.add_accessor(std::vector<uint8_t>(12, 0), "VEC4", 5121);
    primitive["attributes"]["WEIGHTS_0"] =
        gltf.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    gltf.add("skins", {{"joints", {0}}});
    gltf.json["nodes"][0]["skin"] = 0;
    EXPECT_EQ(part(read(gltf), "skins", PartUse::Read).elements, Names{"node 0 \"door\""});
    const char* kMoved = "transforms of skinned nodes";
    EXPECT_EQ(part(read(gltf), kMoved, PartUse::Ignored).count, 0u);
    gltf.json["nodes"][0]["translation"] = {50, 0, 0};
    EXPECT_EQ(part(read(gltf), kMoved, PartUse::Ignored).elements, Names{"node 0 \"door\""});
    EXPECT_TRUE(read(gltf).warnings.empty());
}

}  // namespace
}  // namespace tetralight
