// SPDX-License-Identifier: Apache-2.0
// What was read of a scene, and the settings of reading.
#include <algorithm>

#include <tetralight/probes/probe_file.h>
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

/// A triangle with corners (0, 0, 0), (2, 0, 0) and (0, 4, 0), a lamp and a sun. The second scene
/// has the sun alone.
std::string scene_with(const std::string& sun_intensity) {
    return R"({"asset": {"version": "2.0"}, "scene": 0,
        "extensionsUsed": ["KHR_lights_punctual"],
        "scenes": [{"name": "day", "nodes": [0, 1, 2]}, {"name": "night", "nodes": [2]}],
        "nodes": [{"name": "wall", "mesh": 0},
            {"name": "lamp", "translation": [5, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"name": "sun", "extensions": {"KHR_lights_punctual": {"light": 1}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0, 0, 0], "max": [2, 4, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri":
            "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAQAAAAAAAAAAAAAAAAAAAgEAAAAAA"}],
        "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": 10},
            {"type": "directional", "intensity": )" +
           sun_intensity + "}]}}}";
}

class Explain : public CommandFixture {
  protected:
    Explain() { write("s.gltf", scene_with("3")); }

    /// The row of this name; null if there is none.
    static Json part(const Json& explained, const std::string& name) {
        for (const Json& row : explained["parts"]) {
            if (row["name"] == name) return row;
        }
        return nullptr;
    }
};

TEST_F(Explain, JsonHasThePartsAndTheSizeOfTheScene) {
    const Json json = run_json({"explain", "s.gltf"});
    EXPECT_EQ(json["scene"], "s.gltf");
    EXPECT_EQ(json["triangles"], 1);
    EXPECT_EQ(json["bounds"], Json::parse(R"({"min": [0.0, 0.0, 0.0], "max": [2.0, 4.0, 0.0]})"));
    EXPECT_GT(json["reading_memory_bytes"], 1'000'000);  // the program
    EXPECT_GT(json["memory_bytes"], json["reading_memory_bytes"]);
    ASSERT_TRUE(json["parts"].is_array());
    EXPECT_EQ(part(json, "triangles")["count"], 1);
    for (const Json& row : json["parts"]) {
        for (const char* member :
             {"use", "name", "count", "elements", "note", "remedy", "changes_light"}) {
            EXPECT_TRUE(row.contains(member)) << member;
        }
    }
}

TEST_F(Explain, TextHasTheSameAndIsAnAnswerOfInfoToo) {
    const std::string out = succeed({"explain", "s.gltf"}).out;
    for (const char* line :
         {"s.gltf\n  triangles  1\n  bounds     (0, 0, 0) to (2, 4, 0)\n  memory ",
          "what was read\n", "  point lights"}) {
        EXPECT_TRUE(contains(out, line)) << line << "\n" << out;
    }
    EXPECT_EQ(succeed({"info", "s.gltf"}).out, out);
    EXPECT_EQ(run_json({"info", "s.gltf"}), run_json({"explain", "s.gltf"}));
    EXPECT_EQ(run_json({"info", kCourtyard}), run_json({"explain", kCourtyard}));
}

TEST_F(Explain, SceneWithoutObjectsHasNoBounds) {
    write("empty.gltf", kEmptyScene);
    const Json json = run_json({"explain", "empty.gltf"});
    EXPECT_TRUE(json["bounds"].is_null());
    EXPECT_EQ(json["triangles"], 0);
    EXPECT_TRUE(contains(succeed({"explain", "empty.gltf"}).out, "none (no objects)"));
}

TEST_F(Explain, PartsThatAreIgnoredAreRowsAndNotWarnings) {
    std::string glass = scene_with("3");
    const std::string used = R"("extensionsUsed": [)";
    glass.insert(glass.find(used) + used.size(), R"("KHR_materials_volume", )");
    glass.insert(
        glass.find(R"("meshes")"),
        R"("materials": [{"name": "jar", "extensions": {"KHR_materials_volume": {"thicknessFactor": 1}}}], )");
    write("glass.gltf", glass);
    const CommandResult shown = succeed({"explain", "glass.gltf"});
    EXPECT_EQ(shown.err, "");
    EXPECT_TRUE(contains(shown.out, "ignored, changes the light\n")) << shown.out;
    const Json row = part(run_json({"explain", "glass.gltf"}), "KHR_materials_volume");
    EXPECT_EQ(row["use"], "ignored");
    EXPECT_EQ(row["changes_light"], true);
    write("five.json", kFiveProbes);
    const std::string warnings =
        succeed({"bake", "glass.gltf", "-g", "five.json", "-s", "1", "-o", "v.probes"}).err;
    EXPECT_TRUE(contains(warnings, "warning: glass.gltf: KHR_materials_volume")) << warnings;
    EXPECT_EQ(succeed({"bake", "glass.gltf", "--explain"}).err, "");
}

TEST_F(Explain, BakesExplainThePartsBeforeTheLights) {
    const Json parts = run_json({"explain", "s.gltf"})["parts"];
    for (const char* command : {"bake", "lightmap", "reflect"}) {
        EXPECT_EQ(run_json({command, "s.gltf", "--sky", "1", "--explain"})["parts"], parts)
            << command;
        const std::string out = succeed({command, "s.gltf", "--sky", "1", "--explain"}).out;
        EXPECT_EQ(out.find("what was read\n"), 0u) << out;
        EXPECT_LT(out.find("point lights"), out.find("mixed lighting: ")) << out;
    }
}

TEST_F(Explain, RefusesWhatIsNotAScene) {
    write("five.json", kFiveProbes);
    write("text.txt", "no scene");
    EXPECT_TRUE(contains(fail({"explain", "five.json"}), "contains probe groups, not a scene"));
    EXPECT_TRUE(contains(fail({"explain", "text.txt"}), "text.txt: "));
    EXPECT_TRUE(contains(fail({"explain", "missing.glb"}), "missing.glb: "));
    EXPECT_TRUE(contains(misuse({"explain"}), "SCENE is required"));
}

TEST_F(Explain, InfoOfASceneHasNoProbesAndNoTetrahedra) {
    EXPECT_TRUE(contains(fail({"info", "s.gltf", "--probes"}), "s.gltf: is a scene"));
    EXPECT_TRUE(contains(fail({"info", "s.gltf", "--obj", "a.obj"}), "s.gltf: is a scene"));
    write("five.json", kFiveProbes);
    succeed({"tetrahedralize", "five.json", "-o", "v.probes"});
    EXPECT_TRUE(contains(fail({"info", "v.probes", "--light-unit", "watt"}),
                         "--light-unit: needs a glTF scene"));
}

TEST_F(Explain, ReadsTheSceneOfThisNameOrNumber) {
    EXPECT_EQ(part(run_json({"explain", "s.gltf"}), "point lights")["count"], 1);
    for (const char* night : {"night", "1"}) {
        const Json json = run_json({"explain", "s.gltf", "--scene-name", night});
        EXPECT_TRUE(part(json, "point lights").is_null()) << json;
        EXPECT_EQ(part(json, "directional lights")["count"], 1);
        EXPECT_EQ(json["triangles"], 0);
    }
    const CommandResult result = run({"explain", "s.gltf", "--scene-name", "dusk", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(Json::parse(result.out)["error"]["field"], "scene_name");
}

TEST_F(Explain, AnimationsNeedATimeAndCommandsWithOptionalScenesTheScene) {
    EXPECT_TRUE(contains(misuse({"explain", "s.gltf", "--animation", "walk"}),
                         "--animation: needs --time"));
    EXPECT_TRUE(contains(misuse({"explain", "s.gltf", "--time", "-1"}), "--time: -1 is not"));
    EXPECT_TRUE(contains(misuse({"validate", "v.probes", "--time", "1"}), "--time: needs --scene"));
}

TEST_F(Explain, LightmapsAndTheirScenesAreOfTheSceneOfThisName) {
    EXPECT_TRUE(contains(fail({"unwrap", "s.gltf", "-o", "u.glb", "--scene-name", "night"}),
                         "s.gltf: the scene has no object that takes a lightmap"));
    std::string turned = scene_with("3");  // the scene with the wall is not the default one
    turned.replace(turned.find(R"("scene": 0)"), 10, R"("scene": 1)");
    write("turned.gltf", turned);
    EXPECT_TRUE(contains(fail({"unwrap", "turned.gltf", "-o", "u.glb"}), "has no object"));
    EXPECT_EQ(run_json({"unwrap", "turned.gltf", "-o", "u.glb", "--scene-name", "day"})["objects"],
              1);
    succeed({"lightmap", "turned.gltf", "-o", "l.lightmaps", "-t", "2", "-s", "1", "--scene-name",
             "day", "--unwrapped", "v.glb"});
    succeed({"export", "l.lightmaps", "--scene", "turned.gltf", "-o", "lit.glb", "--scene-name",
             "day"});
    fail({"export", "l.lightmaps", "--scene", "turned.gltf", "-o", "no.glb"});
    for (const char* written : {"u.glb", "v.glb", "lit.glb"}) {
        EXPECT_EQ(run_json({"explain", written})["triangles"], 0) << written;
        EXPECT_EQ(run_json({"explain", written, "--scene-name", "day"})["triangles"], 1) << written;
        const char* place = written[0] == 'l' ? "MX_lightmap" : "lightmap_rectangle";
        EXPECT_TRUE(contains(read(written), place)) << written;
    }
}

TEST_F(Explain, NamesOfLightsWithLineBreaksAreReadWithBlanks) {
    std::string named = scene_with("3");
    named.replace(named.find(R"("name": "lamp")"), 14, R"("name": "la\nmp\u202e")");
    write("named.gltf", named);
    write("five.json", kFiveProbes);
    const CommandResult result =
        succeed({"bake", "named.gltf", "-g", "five.json", "-s", "16", "-o", "named.probes"});
    EXPECT_TRUE(contains(result.err, "named.gltf: names (node 1 \"la mp\\u202e\"): have blanks"))
        << result.err;
}

TEST_F(Explain, WattsBakeAsTheSameIntensityInLux) {
    write("five.json", kFiveProbes);
    std::string lamp_in_watts = scene_with("2049");  // 3 x 683
    const std::string lamp = R"("intensity": 10})";
    lamp_in_watts.replace(lamp_in_watts.find(lamp), lamp.size(), R"("intensity": 6830})");
    write("watt.gltf", lamp_in_watts);
    const auto bake = [&](const Arguments& more, const std::string& output) {
        Arguments all{"bake", "-g", "five.json", "-s", "16", "-o", output};
        all.insert(all.end(), more.begin(), more.end());
        succeed(all);
        const auto file = open_probe_file(path(output));
        EXPECT_TRUE(file);
        const auto light = file->view().irradiance;
        return std::vector<IrradianceSh>(light.begin(), light.end());
    };
    const auto lux = bake({"s.gltf"}, "lux.probes");
    EXPECT_EQ(bake({"watt.gltf", "--light-unit", "watt"}, "watt.probes"), lux);
    EXPECT_NE(bake({"watt.gltf"}, "bright.probes"), lux);
    // The volume says how its scene was read.
    EXPECT_EQ(run_json({"info", "watt.probes"})["made_with"]["light_unit"], "watt");
    EXPECT_FALSE(run_json({"info", "lux.probes"})["made_with"].contains("light_unit"));
}

TEST_F(Explain, JobsHaveTheSameSettings) {
    write("job.json", R"({"command": "explain", "scene": "s.gltf", "scene_name": "night",
        "light_unit": "watt"})");
    const Json json = Json::parse(succeed({"--job", "job.json"}).out);
    EXPECT_EQ(part(json, "directional lights")["count"], 1);
    EXPECT_TRUE(part(json, "point lights").is_null());
}

}  // namespace
}  // namespace tetralight::test
