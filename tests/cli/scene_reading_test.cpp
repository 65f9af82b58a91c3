// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/scene_reading.h>

#include <tetralight/base/error_text.h>
#include <tetralight/settings/read_values.h>
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

using cli::scene_reading;
using settings::Values;

Values values_of(const settings::Table& table, settings::Json json) {
    auto values = settings::values_from_json(table, json, settings::Access::Command);
    EXPECT_TRUE(values);
    return values ? *values : Values(table, settings::Form::Json);
}

TEST(SceneReadingSettings, DefaultsAreThoseOfTheLibrary) {
    const SceneReading reading =
        scene_reading(values_of(settings::kExplain, {{"scene", "s.glb"}}), NormalMaps::Read);
    const SceneReading library;
    EXPECT_EQ(reading.scene, library.scene);
    EXPECT_EQ(reading.time, library.time);
    EXPECT_EQ(reading.animation, library.animation);
    EXPECT_EQ(reading.light_unit, library.light_unit);
    EXPECT_EQ(reading.normal_maps, NormalMaps::Read);
}

TEST(SceneReadingSettings, EverySettingIsTaken) {
    const SceneReading reading =
        scene_reading(values_of(settings::kExplain, {{"scene", "s.glb"},
                                                     {"scene_name", "night"},
                                                     {"time", 0},
                                                     {"animation", "1"},
                                                     {"light_unit", "watt"}}));
    EXPECT_EQ(reading.scene, "night");
    EXPECT_EQ(reading.time, 0.0);
    EXPECT_EQ(reading.animation, "1");
    EXPECT_EQ(reading.light_unit, LightUnit::Watt);
}

TEST(SceneReadingSettings, ASkyOfTheCommandIsKnown) {
    Json settings = {{"scene", "s.glb"}, {"output", "v.probes"}};
    EXPECT_FALSE(scene_reading(values_of(settings::kBake, settings)).has_other_sky);
    settings["sky"] = 0.5;
    EXPECT_TRUE(scene_reading(values_of(settings::kBake, settings)).has_other_sky);
}

TEST(SceneReadingSettings, CommandsWithFewerOfThemHaveTheDefaultsOfTheRest) {
    const SceneReading groups = scene_reading(values_of(
        settings::kTetrahedralize, {{"groups", {"s.glb"}}, {"output", "v.probes"}, {"time", 2}}));
    EXPECT_EQ(groups.time, 2.0);
    EXPECT_EQ(groups.light_unit, LightUnit::Lux);
    const SceneReading unwrapped = scene_reading(values_of(
        settings::kUnwrap, {{"scene", "s.glb"}, {"output", "u.glb"}, {"light_unit", "watt"}}));
    EXPECT_EQ(unwrapped.scene, "");
    EXPECT_EQ(
        scene_reading(values_of(settings::kUnwrap,
                                {{"scene", "s.glb"}, {"output", "u.glb"}, {"scene_name", "night"}}))
            .scene,
        "night");
    EXPECT_EQ(unwrapped.light_unit, LightUnit::Watt);
}

TEST(SizeHint, IsForErrorsAboutTheSizeOfLargeScenes) {
    Scene scene;
    scene.meshes.resize(1);
    scene.meshes[0].positions = {{0, 0, 0}, {900, 0, 0}, {0, 0, 900}};
    scene.instances.resize(1);
    scene.instances[0].mesh = 0;
    const auto hinted = [&](const Error& error) {
        return error_text(cli::with_size_hint(error, scene));
    };
    const std::string hint =
        "many; the scene is 900 m wide; if its unit is a centimetre, scale it by 0.01";
    for (const char* field : {"max_probes", "texels_per_meter"})
        EXPECT_EQ(hinted({ErrorCode::InvalidArgument, field, "", "many"}), hint);
    EXPECT_EQ(hinted({ErrorCode::OutOfResources, "many"}), hint);
    EXPECT_EQ(hinted({ErrorCode::InvalidArgument, "spacing", "", "many"}), "many");
    scene.meshes[0].positions[1].x = 9.0f;
    scene.meshes[0].positions[2].z = 9.0f;
    EXPECT_EQ(hinted({ErrorCode::InvalidArgument, "max_probes", "", "many"}), "many");
}

class SceneFile : public CommandFixture {};

TEST_F(SceneFile, IsKnownByItsContents) {
    const std::pair<std::string, bool> files[] = {
        {kEmptyScene, true},
        {"\n  " + kEmptyScene, true},
        {std::string("glTF\x02\0\0\0", 8), true},
        {R"({"scenes": [{}], "asset": {"version": "2.0"}})", true},
        {R"({"groups": [{"asset": 1}]})", false},
        {R"({"name": "asset"})", false},
        {R"(["asset"])", false},
        {R"({"asset": {"version": "2.0"})", false},
        {"asset", false},
        {"", false},
        {kFiveProbes, false}};
    for (const auto& [bytes, is_scene] : files) {
        write("file", bytes);
        EXPECT_EQ(cli::is_scene_file(path("file")), is_scene) << bytes;
    }
    EXPECT_FALSE(cli::is_scene_file(path("missing")));
}

}  // namespace
}  // namespace tetralight::test
