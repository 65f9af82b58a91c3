// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"
#include "tests/cli/picture.h"

namespace tetralight::test {
namespace {

class Lightmap : public CommandFixture {
  protected:
    /// Coarse lightmaps of the courtyard.
    [[nodiscard]] static Arguments arguments(const std::string& output, const Arguments& more) {
        Arguments all{"lightmap", kCourtyard,  "-o", output,        "--texels-per-meter",
                      "1",        "--samples", "32", "--page-size", "256"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    void bake(const std::string& output, const Arguments& more = {}) const {
        succeed(arguments(output, more));
    }
};

TEST_F(Lightmap, BakesTheSameBytesWithAnyNumberOfThreads) {
    bake("one.lightmaps", {"--threads", "1"});
    bake("two.lightmaps", {"--threads", "2"});
    EXPECT_FALSE(read("one.lightmaps").empty());
    EXPECT_EQ(read("one.lightmaps"), read("two.lightmaps"));
}

TEST_F(Lightmap, JsonCountsTexelsChartsAndSeams) {
    const Json json = run_json(arguments("c.lightmaps", {}));
    EXPECT_EQ(json["output"], "c.lightmaps");
    EXPECT_GE(json["charts"], 100);
    EXPECT_EQ(json["texels"], json["invalid"].get<int>() + json["baked"].get<int>());
    EXPECT_GE(json["pages"], 1);
    const Json info = run_json({"info", "c.lightmaps"});
    EXPECT_EQ(info["pages"], json["pages"]);
    EXPECT_EQ(info["made_with"]["texels_per_meter"], 1);
    EXPECT_EQ(info["made_with"]["samples"], 32);
    EXPECT_EQ(run_json({"validate", "c.lightmaps"})["is_valid"], true);
}

TEST_F(Lightmap, RelightSetsWeightsOfLayers) {
    bake("c.lightmaps", {"--layers", "sky"});
    succeed({"relight", "c.lightmaps", "--weights", "sky=0", "-o", "dark.lightmaps"});
    succeed({"relight", "dark.lightmaps", "--weights", "sky=1", "-o", "again.lightmaps"});
    EXPECT_NE(read("dark.lightmaps"), read("c.lightmaps"));
    const Json layers = run_json({"info", "dark.lightmaps"})["layers"];
    EXPECT_EQ(layers[0], Json::parse(R"({"name": "sky", "weight": 0.0})"));
    const std::string error =
        fail({"relight", "c.lightmaps", "--weights", "lamp=0", "-o", "x.lightmaps"});
    EXPECT_TRUE(contains(error, "c.lightmaps: ")) << error;
    EXPECT_TRUE(contains(error, "sky")) << error;
}

TEST_F(Lightmap, RelightRefusesWhatLightmapsCannotDo) {
    bake("c.lightmaps", {"--layers", "sky"});
    EXPECT_TRUE(contains(fail({"relight", "c.lightmaps", "--sky", "2", "-o", "x.lightmaps"}),
                         "contains lightmaps"));
    EXPECT_TRUE(contains(fail({"relight", "c.lightmaps", "--weights", "sky=2", "-o", "x.probes"}),
                         "contains lightmaps"));
}

TEST_F(Lightmap, StoresGiveTheSameBytes) {
    bake("whole.lightmaps");
    bake("first.lightmaps", {"--store", "store"});
    const Json again = run_json(arguments("second.lightmaps", {"--store", "store"}));
    EXPECT_EQ(read("first.lightmaps"), read("whole.lightmaps"));
    EXPECT_EQ(read("second.lightmaps"), read("whole.lightmaps"));
}

TEST_F(Lightmap, RefusesAnObjectThatFitsInNoPageAndKeepsTheOldFile) {
    write("c.lightmaps", "old");
    const std::string error = fail_and_keep(
        "c.lightmaps", {"lightmap", kCourtyard, "-o", "c.lightmaps", "--page-size", "256"});
    EXPECT_TRUE(contains(error, "object \"")) << error;
    EXPECT_TRUE(contains(error, "256")) << error;
}

TEST_F(Lightmap, RefusesUnknownObjectsAndLayers) {
    EXPECT_TRUE(contains(fail(arguments("c.lightmaps", {"--only", "nothing"})), "\"nothing\""));
    EXPECT_TRUE(contains(fail(arguments("c.lightmaps", {"--layers", "transfer"})), "transfer"));
    EXPECT_TRUE(contains(misuse(arguments("c.probes", {})), ".lightmaps"));
    misuse(arguments("c.lightmaps", {"--max-samples", "100"}));
}

TEST_F(Lightmap, RenderUsesThemForStaticObjects) {
    bake_courtyard("v.probes");
    bake("c.lightmaps");
    const Arguments picture{"render", kCourtyard,    "v.probes", "--width",    "24", "--height",
                            "16",     "--antialias", "1",        "--exposure", "1",  "-o"};
    Arguments plain = picture, mapped = picture;
    plain.push_back("plain.png");
    mapped.insert(mapped.end(), {"mapped.png", "--lightmaps", "c.lightmaps"});
    succeed(plain);
    succeed(mapped);
    EXPECT_NE(read("plain.png"), read("mapped.png"));
    write("other.gltf", kEmptyScene);
    const std::string error =
        fail({"render", "other.gltf", "v.probes", "--lightmaps", "c.lightmaps", "-o", "x.png"});
    EXPECT_TRUE(contains(error, "the lightmaps have")) << error;
}

}  // namespace
}  // namespace tetralight::test
