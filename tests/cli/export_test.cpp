// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/probes/probe_volume.h>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

class Export : public CommandFixture {
  protected:
    Export() {
        succeed({"lightmap", kCourtyard, "-o", "c.lightmaps", "-t", "1", "--page-size", "64", "-s",
                 "1"});
    }

    /// The JSON of a .glb file.
    [[nodiscard]] Json json_of(const std::string& name) const {
        const std::string bytes = read(name);
        const size_t end = bytes.find(std::string("BIN\0", 4));
        return Json::parse(bytes.substr(20, end - 4 - 20));
    }
};

TEST_F(Export, ExrAndPngHaveOneFileAPage) {
    for (const std::string format : {"exr", "png"}) {
        const Json json = run_json({"export", "c.lightmaps", "-o", "c." + format});
        const size_t pages = json["pages"];
        ASSERT_GT(pages, 1u);
        ASSERT_EQ(json["files"].size(), pages);
        EXPECT_EQ(json["files"][1], "c_1." + format);
        for (const Json& file : json["files"]) EXPECT_FALSE(read(file).empty());
        EXPECT_EQ(json.contains("range"), format == "png");
    }
    const auto page = read_hdr_image(path("c_0.exr"));
    ASSERT_TRUE(page);
    EXPECT_EQ(page->image.width, 64u);
    EXPECT_EQ(page->mended_pixel_count, 0u);
}

TEST_F(Export, LightmapsAreNotProbes) {
    EXPECT_TRUE(contains(fail({"export", "c.lightmaps", "--as", "godot", "-o", "c.tres"}),
                         "c.lightmaps: contains lightmaps, and godot is for probes"));
}

TEST_F(Export, SettingsOfProbeVolumesAreRefused) {
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "-o", "c.png", "--spacing", "1"}),
                         "--spacing: is for probe volumes"));
}

TEST_F(Export, TheFormatFitsTheNameOfTheOutput) {
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "--as", "png", "-o", "c.exr"}),
                         "--as: png does not fit the name of the output, c.exr"));
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "--as", "preview", "-o", "c.ktx2"}),
                         "--as: preview does not fit the name of the output, c.ktx2"));
}

TEST_F(Export, Ktx2HasAllPagesAsLayers) {
    const Json json = run_json({"export", "c.lightmaps", "--as", "ktx2", "-o", "c.ktx2"});
    EXPECT_EQ(json["files"].size(), 1u);
    EXPECT_EQ(static_cast<unsigned char>(read("c.ktx2").at(32)), json["pages"].get<unsigned>());
}

TEST_F(Export, PreviewsMarkObjects) {
    const Json json = run_json({"export", "c.lightmaps", "--as", "preview", "-o", "p.png"});
    ASSERT_EQ(json["files"].size(), json["pages"]);
    const std::string plain = read("p_0.png");
    const Lightmaps maps = copy_lightmaps(open_lightmap_file(path("c.lightmaps"))->view());
    const size_t first = static_cast<size_t>(
        std::ranges::find(maps.rectangles, 0u, &LightmapRectangle::page) - maps.rectangles.begin());
    const std::string name(split_names(maps.instance_names)[first]);
    succeed({"export", "c.lightmaps", "--as", "preview", "-o", "p.png", "--mark", name});
    EXPECT_TRUE(read("p_0.png") != plain);
    EXPECT_TRUE(contains(
        fail({"export", "c.lightmaps", "--as", "preview", "-o", "p.png", "--mark", "no such"}),
        "c.lightmaps: no object \"no such\" has a lightmap there"));
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "-o", "p.png", "--mark", name}),
                         "only previews"));
}

TEST_F(Export, GlbHasTheSceneWithLightmaps) {
    const Json json = run_json({"export", "c.lightmaps", "--scene", kCourtyard, "-o", "lit.glb"});
    const Json gltf = json_of("lit.glb");
    EXPECT_EQ(gltf["extensionsUsed"].back(), "MX_texture_rgbm");
    size_t lightmaps = 0;
    for (const Json& node : gltf["nodes"]) {
        if (!node.contains("extensions") || !node["extensions"].contains("MX_lightmap")) continue;
        ++lightmaps;
        EXPECT_LT(node["extensions"]["MX_lightmap"]["lightMapTexture"]["index"],
                  gltf["textures"].size());
    }
    EXPECT_GT(lightmaps, 10u);
    EXPECT_TRUE(read_gltf(path("lit.glb")));
}

TEST_F(Export, WritesOtherMapsAndPackedChannels) {
    EXPECT_TRUE(contains(fail({"export", "c.lightmaps", "--map", "shadow-mask", "-o", "m.png"}),
                         "c.lightmaps: the lightmaps have no shadow mask; bake them with "
                         "--mixed-lighting shadowmask"));
    succeed({"lightmap", kCourtyard, "-o", "m.lightmaps", "-t", "1", "--page-size", "256", "-s",
             "1", "--mixed-lighting", "shadowmask", "--ambient-occlusion", "1", "--layers",
             "sun,sky,emission"});
    for (const std::string map : {"direction", "mono-sh", "shadow-mask", "ambient-occlusion"}) {
        for (const std::string format : {"png", "exr", "ktx2", "preview"}) {
            const std::string file = map + "." + (format == "preview" ? "png" : format);
            const Json json =
                run_json({"export", "m.lightmaps", "--map", map, "--as", format, "-o", file});
            EXPECT_FALSE(read(json["files"][0]).empty());
            EXPECT_FALSE(json.contains("range"));
        }
    }
    const Json json =
        run_json({"export", "m.lightmaps", "--pack", "sun,sky,emission^0.5", "-o", "p.png"});
    EXPECT_GT(json["range"].get<double>(), 0.0);
    succeed({"export", "m.lightmaps", "--pack", "sun,sky,emission,shadow:0", "-o", "p.exr"});
    EXPECT_TRUE(contains(
        fail({"export", "m.lightmaps", "--pack", "sun,sky,emission,shadow:0", "-o", "q.png"}),
        "write .exr or .ktx2"));
    EXPECT_TRUE(contains(fail({"export", "m.lightmaps", "--pack", "moon", "-o", "q.exr"}),
                         "m.lightmaps: pack: unknown channel \"moon\"; the lightmaps have "));
    EXPECT_TRUE(contains(
        misuse({"export", "m.lightmaps", "--pack", "sun", "--map", "mono-sh", "-o", "q.exr"}),
        "--map"));
    EXPECT_TRUE(contains(
        misuse({"export", "m.lightmaps", "--map", "mono-sh", "--scene", kCourtyard, "-o", "q.glb"}),
        "irradiance only"));
}

TEST_F(Export, RefusesAnotherSceneAndNamesTheObject) {
    succeed({"unwrap", kCourtyard, "-o", "uv1.glb"});
    const std::string error =
        fail({"export", "c.lightmaps", "--scene", "uv1.glb", "-o", "lit.glb"});
    EXPECT_TRUE(contains(error, "uv1.glb: the lightmaps do not fit the object \"")) << error;
    write("empty.gltf", kEmptyScene);
    EXPECT_TRUE(contains(fail({"export", "c.lightmaps", "--scene", "empty.gltf", "-o", "lit.glb"}),
                         "empty.gltf: the scene has 0 instances, the lightmaps have "));
}

TEST_F(Export, SaysWhatIsMissing) {
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "-o", "lit.glb"}), "--scene"));
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "-o", "-"}), "--as"));
    EXPECT_TRUE(contains(misuse({"export", "c.lightmaps", "--scene", kCourtyard, "-o", "c.exr"}),
                         "only glb"));
    EXPECT_TRUE(
        contains(fail({"export", "c.lightmaps", "--as", "exr", "-o", "-"}), "pages to stdout"));
}

/// A volume without light is enough to see what is written where.
class ExportVolume : public CommandFixture {
  protected:
    ExportVolume() {
        write("g.json", R"({"groups": [{"name": "=a", "positions":
            [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [4, 4, 4]]}]})");
        succeed({"tetrahedralize", "g.json", "-o", "v.probes"});
    }
};

TEST_F(ExportVolume, TheOutputNamesTheFormatIfOnlyOneHasItsExtension) {
    EXPECT_EQ(run_json({"export", "v.probes", "-o", "v.vtu"})["as"], "vtu");
    EXPECT_EQ(run_json({"export", "v.probes", "-o", "v.csv"})["as"], "csv");
    for (const char* output : {"v.json", "v.glb", "v.txt.gz"}) {
        EXPECT_TRUE(contains(fail({"export", "v.probes", "-o", output}),
                             "v.probes: contains probes; --as names a format for them"));
    }
    EXPECT_TRUE(contains(misuse({"export", "v.probes", "--as", "csv", "-o", "v.txt"}),
                         "--output: v.txt: a file for csv ends with .csv"));
}

TEST_F(ExportVolume, FilesBesideTheOutputAreNamedAfterIt) {
    const Json json = run_json({"export", "v.probes", "--as", "three-grid", "--resolution", "2,2,2",
                                "-o", path("sub.json")});
    EXPECT_EQ(json["files"], (Json{path("sub.json"), path("sub.bin")}));
    EXPECT_EQ(read("sub.bin").size(), 2u * 2 * 7 * 4 * 16);
    EXPECT_EQ(json["lost"].size(), 1u);
    EXPECT_EQ(json["difference"]["places"], 10000);
    EXPECT_TRUE(contains(fail({"export", "v.probes", "--as", "three-grid", "-o", "-"}),
                         "cannot write 2 files to stdout"));
    EXPECT_EQ(succeed({"export", "v.probes", "--as", "csv", "-o", "-"}).out.substr(0, 6), "x,y,z,");
}

TEST_F(ExportVolume, FilesForBevyAndUnrealNameEachOther) {
    const Json bevy =
        run_json({"export", "v.probes", "--resolution", "2,2,2", "-o", "court.scn.ron"});
    EXPECT_EQ(bevy["as"], "bevy");
    EXPECT_EQ(bevy["files"], (Json{"court.scn.ron", "court.ktx2"}));
    EXPECT_TRUE(contains(read("court.scn.ron"), "Path(\"court.ktx2\")"));
    const Json unreal = run_json(
        {"export", "v.probes", "--as", "unreal", "--resolution", "2,2,2", "-o", "court.md"});
    EXPECT_EQ(unreal["files"], (Json{"court.md", "court.exr"}));
    EXPECT_TRUE(contains(read("court.md"), "Import \"court.exr\""));
    EXPECT_TRUE(contains(fail({"export", "v.probes", "--as", "bevy", "--resolution", "1,1025,1",
                               "-o", "court.scn.ron"}),
                         "--resolution: gives a texture of 1 x 2050 x 3 texels"));
}

/// A .glb of probes is a scene that our own reader opens.
TEST_F(ExportVolume, GlbIsAScene) {
    const Json json = run_json({"export", "v.probes", "--as", "gltf", "-o", "v.glb"});
    EXPECT_EQ(json["files"].size(), 1u);
    const auto scene = read_gltf(path("v.glb"));
    EXPECT_TRUE(scene) << (scene ? "" : error_text(scene.error()));
}

TEST_F(ExportVolume, EnginesGetAScriptBesideTheirFile) {
    const Json godot = run_json({"export", "v.probes", "-o", "court.tres"});
    EXPECT_EQ(godot["files"], (Json{"court.tres", "court.gd"}));
    EXPECT_TRUE(contains(read("court.gd"), "preload(\"court.tres\")"));
    EXPECT_TRUE(contains(read("court.tres"), "type=\"LightmapGIData\""));
    const Json unity = run_json({"export", "v.probes", "--as", "unity", "-o", "court.json"});
    EXPECT_EQ(unity["files"], (Json{"court.json", "TetralightProbes.cs"}));
    EXPECT_EQ(Json::parse(read("court.json"))["positions"].size(), 15u);
    write("none.json", R"({"groups": [{"name": "a", "positions": []}]})");
    succeed({"tetrahedralize", "none.json", "-o", "none.probes"});
    EXPECT_TRUE(contains(fail({"export", "none.probes", "-o", "none.tres"}),
                         "none.probes: has no probes; Godot needs at least one"));
}

TEST_F(ExportVolume, SettingsBelongToFormats) {
    EXPECT_TRUE(contains(misuse({"export", "v.probes", "-o", "v.vtu", "--spacing", "1"}),
                         "--spacing: is for grids, and vtu is not a grid"));
    EXPECT_TRUE(contains(misuse({"export", "v.probes", "-o", "v.vtu", "--at", "1,2,3"}),
                         "--at: vtu does not hold the light of single places"));
    EXPECT_TRUE(contains(misuse({"export", "v.probes", "-o", "v.vtu", "--map", "mono-sh"}),
                         "--map: is for lightmaps and reflection probes"));
    EXPECT_TRUE(contains(fail({"export", "v.probes", "--as", "three-grid", "--bounds",
                               "0,0,0,1,0,1", "-o", "v.json"}),
                         "--bounds: the minimum is not below the maximum along each axis"));
    EXPECT_TRUE(contains(fail({"export", "v.probes", "-o", "v.png"}),
                         "v.probes: contains probes; --as names a format for them"));
}

TEST_F(ExportVolume, PlacesAreThoseOfTheOption) {
    succeed({"export", "v.probes", "--as", "playcanvas", "--at", "1,1,1", "--at", "0,2,0.5", "-o",
             "p.json"});
    const Json places = Json::parse(read("p.json"))["places"];
    ASSERT_EQ(places.size(), 2u);
    EXPECT_EQ(places[1]["position"], (Json{0, 2, 0.5}));
    succeed({"export", "v.probes", "--as", "filament", "--at", "1,1,1", "-o", "p.txt"});
    EXPECT_EQ(run_json({"export", "v.probes", "--as", "babylon", "-o", "p.glb"})["lost"][1],
              "The light of all places but 2, 2, 2.");
    EXPECT_TRUE(contains(fail({"export", "v.probes", "--as", "filament", "--at", "1,1,1", "--at",
                               "2,2,2", "-o", "p.txt"}),
                         "--at: the format holds the light of one place, and there are 2"));
}

TEST_F(ExportVolume, OldFilesStay) {
    write("old.csv", "old");
    fail({"export", "none.probes", "-o", "old.csv"});
    EXPECT_EQ(read("old.csv"), "old");
    EXPECT_TRUE(
        contains(fail({"export", "v.probes", "--as", "three-grid", "-o", "no/v.json"}), "no"));
}

}  // namespace
}  // namespace tetralight::test
