// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/half.h>
#include <tetralight/reflection/reflection_file.h>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

/// Two reflection probes in empty space.
const std::string kTwoProbes =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [
        {"name": "left", "translation": [-3, 1, 0],
         "extras": {"reflection_probe": {"size": [6, 3, 4], "importance": 2}}},
        {"name": "right", "translation": [3, 1, 0], "extras": {"reflection_probe": true}}]})";

class Reflect : public CommandFixture {
  protected:
    Reflect() {
        write("two.gltf", kTwoProbes);
        write("empty.gltf", kEmptyScene);
    }

    /// Small cubes of few paths.
    [[nodiscard]] static Arguments arguments(const std::string& scene, const std::string& output,
                                             const Arguments& more = {}) {
        Arguments all{"reflect", scene, "-o", output, "--cube-size", "16", "-s", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    /// The names of the probes of a file; none if it cannot be opened.
    [[nodiscard]] std::vector<std::string> names_in(const std::string& name) const {
        const auto file = open_reflection_file(path(name));
        if (!file) return {};
        const auto names = file->names();
        return {names.begin(), names.end()};
    }
};

using Names = std::vector<std::string>;

TEST_F(Reflect, WritesTheCubesOfTheProbesAndOfTheSky) {
    const Json json = run_json(arguments("two.gltf", "r.ktx2", {"--sky", "3"}));
    EXPECT_EQ(json["output"], "r.ktx2");
    EXPECT_EQ(json["probes"].size(), 3u);
    EXPECT_EQ(names_in("r.ktx2"), Names({"left", "right", "sky"}));
    const auto file = open_reflection_file(path("r.ktx2"));
    ASSERT_TRUE(file);
    const ReflectionsView& all = file->view();
    EXPECT_EQ(all.size, 16u);
    EXPECT_EQ(all.probes[0].half_size, glm::vec3(3, 1.5f, 2));
    EXPECT_EQ(all.probes[0].importance, 2);
    EXPECT_TRUE(all.probes[2].is_everywhere());
    for (const auto& level : all.levels) {
        for (const RadianceTexel& texel : level)
            ASSERT_NEAR(float_from_half(texel[0]), 3.0f, 0.003f);  // nothing is in its way
    }
}

TEST_F(Reflect, SaysTheSameToInfoAndValidate) {
    const std::string table = succeed(arguments("two.gltf", "r.ktx2", {"--sky", "1"})).out;
    const std::string info = succeed({"info", "r.ktx2"}).out;
    const size_t lines = table.find('\n') + 1;
    EXPECT_EQ(info.substr(info.find('\n') + 1, table.size() - lines), table.substr(lines));
    const Json json = run_json({"info", "r.ktx2"});
    EXPECT_EQ(json["cube_size"], 16);
    EXPECT_EQ(json["roughness"], Json({0.0, 1.0}));
    ASSERT_EQ(json["probes"].size(), 3u);
    EXPECT_EQ(json["probes"][0]["name"], "left");
    EXPECT_EQ(json["probes"][0]["position"], Json({-3.0, 1.0, 0.0}));
    EXPECT_EQ(json["probes"][0]["box"]["half_size"], Json({3.0, 1.5, 2.0}));
    EXPECT_TRUE(json["probes"][2]["box"].is_null());
    EXPECT_EQ(json["made_with"]["cube_size"], 16);
    const Json verdict = run_json({"validate", "r.ktx2"});
    EXPECT_EQ(verdict["is_valid"], true);
    EXPECT_EQ(verdict["probes"], json["probes"]);
    EXPECT_TRUE(contains(succeed({"validate", "r.ktx2"}).out, "r.ktx2: valid, 3 reflection"));
}

TEST_F(Reflect, OtherTexturesAndDamagedFilesAreRefused) {
    succeed(arguments("two.gltf", "r.ktx2", {"--no-sky"}));
    const std::string sound = read("r.ktx2");
    std::string other = sound;
    other.replace(other.find("tetralightReflections"), 10, "anotherapp");
    const std::vector<BadFile> files{
        {"other.ktx2", other, "the texture is not of reflection probes: a key is missing"},
        {"cut.ktx2", sound.substr(0, sound.size() - 8), "lies outside the file"}};
    refuse_each(files, "", [](const std::string& name) { return Arguments{"info", name}; });
    refuse_each(files, "", [](const std::string& name) { return Arguments{"validate", name}; });
    const CommandResult result = run({"validate", "cut.ktx2", "--json"});
    EXPECT_EQ(Json::parse(result.out)["is_valid"], false);
    EXPECT_TRUE(contains(fail({"info", "r.ktx2", "--obj", "r.obj"}), "have no tetrahedra"));
    EXPECT_TRUE(contains(fail({"validate", "r.ktx2", "--scene", "two.gltf"}), "without a scene"));
}

TEST_F(Reflect, BakesABoxThatTheSceneDoesNotHave) {
    succeed(arguments(
        "two.gltf", "r.ktx2",
        {"--no-sky", "--box=-2,0,-1,2,3,1", "--position", "1,1,0", "--blend-distance", "0.25"}));
    const auto file = open_reflection_file(path("r.ktx2"));
    ASSERT_TRUE(file);
    ASSERT_EQ(file->view().probes.size(), 1u);
    const ReflectionProbe& probe = file->view().probes[0];
    EXPECT_EQ(probe.position, glm::dvec3(1, 1, 0));
    EXPECT_EQ(probe.box_center, glm::vec3(-1, 0.5f, 0));
    EXPECT_EQ(probe.half_size, glm::vec3(2, 1.5f, 1));
    EXPECT_EQ(probe.blend_distance, 0.25f);
    succeed(arguments("two.gltf", "r.ktx2", {"--no-sky", "--box=-2,0,-1,2,3,1"}));
    EXPECT_EQ(open_reflection_file(path("r.ktx2"))->view().probes[0].position,
              glm::dvec3(0, 1.5, 0));
}

TEST_F(Reflect, BakesTheProbesOfTheirNames) {
    succeed(arguments("two.gltf", "r.ktx2", {"--no-sky", "--probe", "right"}));
    EXPECT_EQ(names_in("r.ktx2"), Names({"right"}));
    succeed(arguments("two.gltf", "r.ktx2", {"--no-sky", "--probe", "right", "--probe", "left"}));
    EXPECT_EQ(names_in("r.ktx2"), Names({"right", "left"}));
    const std::string error =
        fail_and_keep("r.ktx2", arguments("two.gltf", "r.ktx2", {"--probe", "middle"}));
    EXPECT_TRUE(contains(error, "two.gltf: no reflection probe \"middle\" is there")) << error;
}

TEST_F(Reflect, BakesThePlacesOfGrid) {
    succeed({"grid", kCourtyard, "-o", "g.json", "--spacing", "4", "--reflections", "places.json",
             "--reflection-spacing", "6"});
    const Json places = Json::parse(read("places.json"))["reflection_probes"];
    Names expected;
    for (const Json& place : places) expected.push_back(place["name"]);
    succeed(arguments(kCourtyard, "r.ktx2", {"--no-sky", "--places", "places.json"}));
    EXPECT_EQ(names_in("r.ktx2"), expected);
    succeed(arguments(kCourtyard, "r.ktx2",
                      {"--no-sky", "--places", "places.json", "--probe", expected.back()}));
    EXPECT_EQ(names_in("r.ktx2"), Names({expected.back()}));
    const std::string error =
        fail_and_keep("r.ktx2", arguments(kCourtyard, "r.ktx2", {"--places", "no_places.json"}));
    EXPECT_TRUE(contains(error, "no_places.json: ")) << error;
}

TEST_F(Reflect, GivesTheSameBytesForAnyNumberOfThreads) {
    const std::string box = "--box=-3,0,-3,3,4,3";
    succeed(arguments(kCourtyard, "one.ktx2", {box, "-j", "1"}));
    succeed(arguments(kCourtyard, "two.ktx2", {box, "-j", "2"}));
    EXPECT_EQ(names_in("one.ktx2"), Names({"box", "sky"}));
    EXPECT_TRUE(read("one.ktx2") == read("two.ktx2"));
    succeed(arguments(kCourtyard, "two.ktx2", {box, "--seed", "1"}));
    EXPECT_TRUE(read("one.ktx2") != read("two.ktx2"));
}

TEST_F(Reflect, WrongUseIsRefused) {
    const std::pair<Arguments, std::string> uses[] = {
        {{"--cube-size", "100"}, "--cube-size: 100 is not a power of two"},
        {{"--cube-size", "4"}, "--cube-size: "},
        {{"--box", "0,2,0,1,1,1"}, "--box: the minimum 2 is not below the maximum 1"},
        {{"--box", "0,0,0,1,1"}, "--box: "},
        {{"--box", "0,0,0,1,1,1", "--places", "p.json"}, "--places: does not go with --box"},
        {{"--box", "0,0,0,1,1,1", "--probe", "left"}, "--probe: does not go with --box"},
        {{"--position", "0,0,0"}, "--position: needs --box"},
        {{"--blend-distance", "1"}, "--blend-distance: needs --box"}};
    for (const auto& [more, message] : uses) {
        Arguments all{"reflect", "two.gltf", "-o", "r.ktx2"};
        all.insert(all.end(), more.begin(), more.end());
        const std::string error = misuse(all);
        EXPECT_EQ(error.find("tetralight reflect: " + message), 0u) << error;
    }
    EXPECT_FALSE(std::filesystem::exists(path("r.ktx2")));
}

TEST_F(Reflect, ExplainsWithoutBaking) {
    const auto before = file_names();
    const Json json = run_json({"reflect", kCourtyard, "--explain"});
    EXPECT_EQ(json["sources"], run_json({"bake", kCourtyard, "--explain"})["sources"]);
    EXPECT_EQ(file_names(), before);
    EXPECT_TRUE(contains(fail({"reflect", "two.gltf", "--explain", "--probe", "middle"}),
                         "no reflection probe \"middle\""));
    EXPECT_TRUE(contains(misuse({"reflect", "two.gltf"}), "--output is required"));
}

TEST_F(Reflect, WarnsIfTheFileHoldsTheSkyAlone) {
    const CommandResult result = succeed(arguments("empty.gltf", "r.ktx2", {"--sky", "1"}));
    EXPECT_TRUE(contains(result.err,
                         "warning: empty.gltf: has no reflection probes; the result "
                         "holds the sky alone\n"));
    EXPECT_EQ(names_in("r.ktx2"), Names({"sky"}));
    const CommandResult baked = succeed(arguments("two.gltf", "r.ktx2", {"--sky", "1"}));
    EXPECT_FALSE(contains(baked.err, "warning"));
}

TEST_F(Reflect, NothingToBakeKeepsTheOldFile) {
    for (const Arguments& more : {Arguments{}, Arguments{"--sky", "1", "--no-sky"}}) {
        const std::string error = fail_and_keep("r.ktx2", arguments("empty.gltf", "r.ktx2", more));
        EXPECT_TRUE(contains(error, "empty.gltf: there are neither reflection probes nor a sky"))
            << error;
    }
    write("broken.gltf", "{");
    EXPECT_TRUE(
        contains(fail_and_keep("r.ktx2", arguments("broken.gltf", "r.ktx2")), "broken.gltf: "));
}

TEST_F(Reflect, ExportWritesTheFacesOfEachCube) {
    succeed(arguments("two.gltf", "r.ktx2", {"--sky", "3"}));
    const Json json = run_json({"export", "r.ktx2", "-o", "r.exr"});
    EXPECT_EQ(json["files"], Json({"r_0.exr", "r_1.exr", "r_2.exr"}));
    for (const std::string file : {"r_0.exr", "r_1.exr", "r_2.exr"}) {
        const auto strip = read_hdr_image(path(file));
        ASSERT_TRUE(strip) << file;
        EXPECT_EQ(strip->image.width, 16u);
        ASSERT_EQ(strip->image.height, 6u * 16u);
        for (const glm::vec3& light : strip->image.pixels) ASSERT_NEAR(light.y, 3.0f, 0.003f);
    }
    succeed({"export", "r.ktx2", "--probe", "right", "--level", "1", "-o", "one.exr"});
    const auto strip = read_hdr_image(path("one.exr"));
    ASSERT_TRUE(strip);
    EXPECT_EQ(strip->image.width, 8u);
    EXPECT_EQ(strip->image.height, 6u * 8u);
    succeed({"export", "r.ktx2", "--probe", "1", "--level", "1", "-o", "numbered.exr"});
    EXPECT_TRUE(read("numbered.exr") == read("one.exr"));
}

TEST_F(Reflect, ExportPutsOneCubeIntoTheScene) {
    succeed(arguments("two.gltf", "r.ktx2", {"--sky", "3"}));
    const auto exported = [&](const Arguments& more) {
        Arguments all{"export", "r.ktx2", "--scene", "two.gltf", "-o", "lit.glb"};
        all.insert(all.end(), more.begin(), more.end());
        return run_json(all);
    };
    const Json json = exported({});
    EXPECT_EQ(json["output"], "lit.glb");
    EXPECT_EQ(json["light"], "sky");
    EXPECT_EQ(json["intensity"], 1.0);
    EXPECT_EQ(json["levels"], 2);
    EXPECT_EQ(json["face_size"], 16);
    EXPECT_EQ(exported({"--probe", "left"})["light"], "left");
    EXPECT_EQ(exported({"--probe", "1"})["light"], "right");
    const std::string bytes = read("lit.glb");
    const Json gltf = Json::parse(bytes.substr(20, bytes.find(std::string("BIN\0", 4)) - 24));
    EXPECT_EQ(gltf["nodes"], Json::parse(kTwoProbes)["nodes"]);
    EXPECT_EQ(gltf["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"], 0);
    EXPECT_EQ(gltf["extensions"]["EXT_lights_image_based"]["lights"][0]["name"], "right");
    EXPECT_EQ(gltf["images"].size(), 12u);
    // The scene is whole: its probes are baked again.
    succeed(arguments("lit.glb", "again.ktx2", {"--sky", "3"}));
    EXPECT_EQ(names_in("again.ktx2"), Names({"left", "right", "sky"}));
}

TEST_F(Reflect, ExportTellsTheIntensityOfBrightLight) {
    succeed(arguments("empty.gltf", "r.ktx2", {"--sky", "1000"}));
    const std::string text =
        succeed({"export", "r.ktx2", "--scene", "empty.gltf", "-o", "lit.glb"}).out;
    EXPECT_EQ(text,
              "lit.glb: image-based light \"sky\" of 16 x 16 texels a face, 2 levels, "
              "intensity 4, because its images hold light up to 255\n");
}

TEST_F(Reflect, ExportRefusesWhatASceneCannotHold) {
    succeed(arguments("two.gltf", "r.ktx2", {"--no-sky"}));
    write("broken.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}],
                             "extensions": {"EXT_lights_image_based": {"lights": 5}}})");
    const std::pair<Arguments, std::string> orders[] = {
        {{"two.gltf"}, "r.ktx2: has 2 reflection probes and no sky; choose one by --probe"},
        {{"two.gltf", "--probe", "2"}, "r.ktx2: no reflection probe \"2\" is there"},
        {{"two.gltf", "--probe", "hall"}, "r.ktx2: no reflection probe \"hall\" is there"},
        {{"no.gltf", "--probe", "left"}, "no.gltf: "},
        {{"broken.gltf", "--probe", "left"}, "broken.gltf: lights is not an array (5)"}};
    for (const auto& [more, message] : orders) {
        Arguments all{"export", "r.ktx2", "-o", "lit.glb", "--scene"};
        all.insert(all.end(), more.begin(), more.end());
        const std::string error = fail_and_keep("lit.glb", all);
        EXPECT_TRUE(contains(error, message)) << error;
    }
    const Arguments wrong[] = {{"--probe", "left", "--probe", "right"}, {"--level", "0"}};
    for (const Arguments& more : wrong) {
        Arguments all{"export", "r.ktx2", "-o", "lit.glb", "--scene", "two.gltf"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(contains(misuse(all), more[0] + ": a glb has ")) << more[0];
    }
    EXPECT_TRUE(contains(misuse({"export", "r.ktx2", "-o", "lit.glb"}), "--scene is required"));
    EXPECT_TRUE(contains(fail_and_keep("court.glb", {"export", "r.ktx2", "--scene", "court.glb",
                                                     "-o", "court.glb", "--probe", "left"}),
                         "court.glb: is an input of this command"));
}

TEST_F(Reflect, ExportRefusesWhatDoesNotFitCubes) {
    succeed(arguments("two.gltf", "r.ktx2", {"--sky", "3"}));
    const std::pair<Arguments, std::string> orders[] = {
        {{"-o", "r.png"}, "r.ktx2: contains reflection probes, which are written as "},
        {{"-o", "r.exr", "--map", "mono-sh"}, "--map, --pack and --mark are for lightmaps"},
        {{"-o", "r.exr", "--pack", "sun"}, "--map, --pack and --mark are for lightmaps"},
        {{"-o", "r.exr", "--level", "2"}, "r.ktx2: has levels 0 to 1, not 2"},
        {{"-o", "r.exr", "--probe", "middle"}, "r.ktx2: no reflection probe \"middle\" is there"},
        {{"-o", "-", "--as", "exr"}, "cannot write 3 cubes to stdout"}};
    for (const auto& [more, message] : orders) {
        Arguments all{"export", "r.ktx2"};
        all.insert(all.end(), more.begin(), more.end());
        EXPECT_TRUE(contains(fail(all), message)) << message;
    }
    EXPECT_EQ(file_names(), Names({"empty.gltf", "r.ktx2", "two.gltf"}));
    EXPECT_TRUE(contains(fail({"export", "two.gltf", "-o", "r.exr", "--probe", "left"}),
                         "--probe and --level are for reflection probes, and two.gltf has none"));
}

TEST_F(Reflect, RenderShowsReflectionsWithAndWithoutBoxProjection) {
    bake_courtyard("v.probes");
    succeed(arguments(kCourtyard, "r.ktx2", {"--box=-12,-1,-12,12,8,12"}));
    const auto picture = [&](const Arguments& more) {
        Arguments all{"render", kCourtyard, "v.probes", "-o",          "p.png", "--width",
                      "24",     "--height", "16",       "--antialias", "1"};
        all.insert(all.end(), more.begin(), more.end());
        succeed(all);
        return read("p.png");
    };
    const std::string plain = picture({});
    const std::string boxed = picture({"--reflections", "r.ktx2"});
    const std::string far = picture({"--reflections", "r.ktx2", "--no-box-projection"});
    EXPECT_TRUE(boxed != plain);
    EXPECT_TRUE(far != boxed);
    EXPECT_TRUE(far != plain);
}

TEST_F(Reflect, KeepsLightInLayersForRelight) {
    succeed(arguments("two.gltf", "r.ktx2", {"--sky", "3", "--layers", "sky"}));
    const Json json = run_json({"relight", "r.ktx2", "-o", "dim.ktx2", "--weights", "sky=0.5"});
    EXPECT_EQ(json["layers"], Json::parse(R"([{"name": "sky", "weight": 0.5}])"));
    const auto file = open_reflection_file(path("dim.ktx2"));
    ASSERT_TRUE(file);
    for (const RadianceTexel& texel : file->view().levels[0])
        ASSERT_NEAR(float_from_half(texel[0]), 1.5f, 0.002f);
    EXPECT_EQ(run_json({"info", "dim.ktx2"})["layers"][0]["weight"], 0.5);
    EXPECT_TRUE(
        contains(fail({"relight", "r.ktx2", "-o", "x.ktx2", "--weights", "moon=1"}), "r.ktx2: "));
    EXPECT_TRUE(contains(fail({"relight", "r.ktx2", "-o", "x.ktx2", "--sky", "1"}),
                         "r.ktx2: contains reflection probes"));
    EXPECT_TRUE(contains(fail({"relight", "r.ktx2", "-o", "x.probes", "--weights", "sky=1"}),
                         "r.ktx2: contains no probes"));
}

TEST_F(Reflect, TakesLightFromLightmaps) {
    succeed({"lightmap", kCourtyard, "-o", "c.lightmaps", "-s", "4", "--texels-per-meter", "1"});
    const Arguments box{"--box=-2,0,-2,2,3,2", "--lightmaps", "c.lightmaps"};
    const Json json = run_json(arguments(kCourtyard, "r.ktx2", box));
    EXPECT_GT(json["rays"], 16 * 16 * 6);
    EXPECT_TRUE(contains(fail(arguments("two.gltf", "x.ktx2", {"--lightmaps", "c.lightmaps"})),
                         "c.lightmaps: "));
    write("bad.lightmaps", "no lightmaps");
    EXPECT_TRUE(contains(fail(arguments("two.gltf", "x.ktx2", {"--lightmaps", "bad.lightmaps"})),
                         "bad.lightmaps: "));
}

TEST_F(Reflect, ChunksContinueWithTheSameBytes) {
    succeed(arguments("two.gltf", "a.ktx2", {"--sky", "3"}));
    succeed(
        arguments("two.gltf", "b.ktx2", {"--sky", "3", "--probe", "right", "--chunks", "kept"}));
    succeed(arguments("two.gltf", "b.ktx2", {"--sky", "3", "--chunks", "kept"}));
    EXPECT_EQ(read("a.ktx2"), read("b.ktx2"));
    EXPECT_FALSE(std::filesystem::exists(path("b.ktx2.store")));
}

}  // namespace
}  // namespace tetralight::test
