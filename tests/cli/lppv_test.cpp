// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/lppv/lppv_texture.h>
#include <tetralight/probes/probe_file.h>
#include "tests/cli/command_fixture.h"
#include "tests/support/property_volume.h"
#include "tests/support/random_walls.h"

namespace tetralight::test {
namespace {

/// The grid of [-1, 1]³ as the command makes it.
LppvGrid make_lppv_grid_of_box(glm::uvec3 resolution) {
    const LppvPart box{glm::dmat4(1.0), glm::dvec3(-1.0), glm::dvec3(1.0)};
    LppvSettings settings;
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = resolution;
    return *make_lppv_grid({glm::dmat4(1.0), std::span(&box, 1)}, settings);
}

class LppvCommand : public CommandFixture {
  protected:
    LppvCommand() { bake_courtyard("v.probes"); }

    [[nodiscard]] static Arguments arguments(const std::string& output, Arguments more) {
        Arguments all{"lppv", "v.probes", "-o", output};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    [[nodiscard]] static Arguments beam(const std::string& output, Arguments more = {}) {
        more.insert(more.end(), {"--scene", kCourtyard, "--object", "beam_long"});
        return arguments(output, more);
    }
};

TEST_F(LppvCommand, WrapsAnObjectOfTheScene) {
    const Json json = run_json(beam("beam.vdb", {"--density", "2"}));
    EXPECT_EQ(json["resolution"], Json({1, 1, 20}));  // 0.6 x 0.6 x 10 m
    EXPECT_NEAR(json["spacing"][2].get<double>(), 10.0 / 19.0, 1e-9);
    EXPECT_EQ(json["points"], 20);
    EXPECT_EQ(json["bounds"]["world_from_local"].size(), 16u);
    EXPECT_NEAR(json["bounds"]["high"][2].get<double>(), 5.0, 1e-6);
    EXPECT_EQ(json["bytes"], read("beam.vdb").size());
    EXPECT_TRUE(json.contains("fill_seconds"));
}

TEST_F(LppvCommand, WritesEveryKindOfFile) {
    for (const std::string kind : {"vdb", "nvdb", "exr", "dds", "ktx2"}) {
        succeed(beam("a." + kind, {"--resolution", "2,2,16"}));
        EXPECT_GT(read("a." + kind).size(), 64u * 27u * 2u) << kind;
    }
    EXPECT_EQ(read("a.dds").substr(0, 4), "DDS ");
    EXPECT_EQ(read("a.ktx2").substr(1, 6), "KTX 20");
    // Seven slabs of eight bytes a point.
    EXPECT_EQ(read("a.dds").size(), 148u + 7u * 64u * 8u);
}

TEST_F(LppvCommand, GivesTheConstantsOfTextures) {
    const Json json =
        run_json(beam("a.ktx2", {"--mode", "normal", "--resolution", "2", "2", "16"}));
    EXPECT_EQ(json["constants"]["layout"], "four slabs");
    EXPECT_NEAR(json["constants"]["params"][2].get<double>(), 1.0 / 8.0, 1e-6);
    EXPECT_TRUE(contains(read("a.ktx2"), "local_from_world"));
}

TEST_F(LppvCommand, FillsABoxOfTheWorldOrThatOfTheProbes) {
    const Json box = run_json(arguments("a.vdb", {"--bounds", "-1,0,-1,3,2,1", "--density", "1"}));
    EXPECT_EQ(box["resolution"], Json({4, 2, 2}));
    const Json probes = run_json(arguments("a.vdb", {"--density", "0.5"}));
    EXPECT_GT(probes["points"], 1000);
    EXPECT_EQ(probes["replaced"], 0);
}

TEST_F(LppvCommand, PointsInGeometryTakeTheLightBeside) {
    const Json json = run_json(arguments("a.vdb", {"--density", "0.5", "--scene", kCourtyard}));
    EXPECT_GT(json["replaced"], 0);
}

TEST_F(LppvCommand, RoundsAsUnityDoes) {
    const Json json = run_json(beam("a.vdb", {"--density", "2", "--unity-limits"}));
    EXPECT_EQ(json["resolution"], Json({1, 1, 16}));
}

TEST_F(LppvCommand, SparseFilesHoldWhatIsNearProbesAndSurfaces) {
    const Json all =
        run_json(arguments("a.vdb", {"--sparse", "--density", "1", "--scene", kCourtyard}));
    const Json probes = run_json(arguments("b.nvdb", {"--sparse", "--density", "1"}));
    EXPECT_GT(all["blocks"], probes["blocks"]);
    EXPECT_GT(probes["blocks"], 10);
    EXPECT_EQ(all["points"], 512 * all["blocks"].get<int>());
}

/// Probes on two layers, those of layer 3 with twice the light.
ProbeVolume make_two_layers() {
    ProbeVolume volume = make_random_volume(test::random_positions(60, 1, 4.0), 2);
    for (uint32_t i = 0; i < volume.positions.size(); ++i) {
        volume.rendering_layers.push_back(i % 2 == 0 ? 0b0001 : 0b1000);
        volume.irradiance[i] = {};
        volume.irradiance[i].coefficients[0] = glm::vec3(i % 2 == 0 ? 1.0f : 2.0f);
    }
    return volume;
}

TEST_F(LppvCommand, TakesTheLightOfTheLayersOfTheObject) {
    const ProbeVolume volume = make_two_layers();
    ASSERT_TRUE(write_probe_file(path("two.probes"), volume.view()));
    const Arguments command{"lppv",  "two.probes", "--precision",    "float",        "-o",
                            "a.dds", "--bounds",   "-1,-1,-1,1,1,1", "--resolution", "5,6,7"};
    const auto layers = [&](Arguments more) {
        more.insert(more.begin(), command.begin(), command.end());
        succeed(more);
        const std::string bytes = read("a.dds").substr(148);
        std::vector<float> texels(bytes.size() / sizeof(float));
        std::memcpy(texels.data(), bytes.data(), texels.size() * sizeof(float));
        return texels;
    };
    const auto grid = make_lppv_grid_of_box({5, 6, 7});
    const Lppv expected =
        *make_lppv(volume.view(), grid, {.receiver = {.rendering_layers = 0b1000}});
    const LppvTexture texture =
        make_lppv_texture(expected, LppvLayout::SevenSlabs, LppvTexelFormat::Float);
    const auto found = layers({"--rendering-layers", "3"});
    ASSERT_EQ(found.size() * sizeof(float), texture.texels.size());
    EXPECT_EQ(std::memcmp(found.data(), texture.texels.data(), texture.texels.size()), 0);
    EXPECT_NE(found, layers({}));
    EXPECT_EQ(layers({"--rendering-layers", "0,3"}), layers({}));
}

TEST_F(LppvCommand, PassesLayersAndRadiusToSparseGrids) {
    ProbeVolume volume = make_two_layers();
    add_random_walls(volume, 3);
    ASSERT_TRUE(write_probe_file(path("two.probes"), volume.view()));
    const auto bytes = [&](Arguments more) {
        more.insert(more.begin(), {"lppv", "two.probes", "--sparse", "-o", "a.nvdb"});
        succeed(more);
        return read("a.nvdb");
    };
    const std::string plain = bytes({});
    EXPECT_NE(bytes({"--rendering-layers", "3"}), plain);
    EXPECT_NE(bytes({"--radius", "0.5"}), plain);
    EXPECT_EQ(bytes({"--radius", "0"}), plain);
}

TEST_F(LppvCommand, RefusesWhatDoesNotGoTogether) {
    EXPECT_TRUE(contains(misuse(arguments("a.exr", {"--sparse"})), "can be sparse"));
    EXPECT_TRUE(contains(misuse(arguments("a.nvdb", {"--precision", "half"})), "have floats"));
    misuse(arguments("a.vdb", {"--object", "beam_long"}));
    misuse(arguments("a.vdb", {"--scene", kCourtyard, "--object", ""}));
    misuse(arguments("a.vdb", {"--bounds", "0,0,0,1,1"}));
    misuse(arguments("a.vdb", {"--resolution", "2,2,2", "--density", "1"}));
    misuse(arguments("a.vdb", {"--sparse", "--mode", "low"}));
}

TEST_F(LppvCommand, SaysWhatIsWrongWithABoxAndNamesTheOption) {
    const auto message = [&](Arguments more) { return misuse(arguments("a.vdb", more)); };
    const auto expect = [&](const Arguments& more, const std::string& words) {
        const std::string said = message(more);
        EXPECT_TRUE(contains(said, "tetralight lppv: " + words)) << said;
    };
    expect({"--bounds", "2,0,0,1,1,1"}, "--bounds: reversed along x: 2 to 1");
    expect({"--bounds", "nan,0,0,1,1,1"}, "--bounds: \"nan\" is not a number");
    expect({"--bounds", "-1e30,0,0,1,1,1"}, "--bounds: -1e30 is not in the range");
    expect({"--bounds", "1e9,0,0,1000000001,1,1", "--density", "10"},
           "--bounds: floats cannot tell grid points 0.1111");
    expect({"--bounds", "0,0,0,1,1,1", "--orientation", "0,0,0,0"}, "--orientation: ");
    expect({"--resolution", "10000,1000,1000"},
           "--resolution: a grid of 10000 x 1000 x 1000 points (1e+10 in total) is too large");
    expect({"--resolution", "10000000000,1,1"}, "--resolution: \"10000000000\" is not a whole");
    expect({"--resolution", "-1,1,1"}, "--resolution: \"-1\" is not a whole");
    expect({"--resolution", "0,1,1"}, "--resolution: a grid of 0 x 1 x 1 points is empty");
    expect({"--density", "1e6"}, "--density: a grid of ");
}

TEST_F(LppvCommand, SaysWhatASparseGridCannotHold) {
    const auto expect = [&](Arguments more, const std::string& words) {
        more.insert(more.end(), {"--sparse", "--scene", kCourtyard});
        const std::string said = misuse(arguments("a.vdb", more));
        EXPECT_TRUE(contains(said, "tetralight lppv: " + words)) << said;
    };
    expect({"--density", "1000"}, "--density: a sparse grid of ");
    expect({"--density", "1e8"}, "--density: a box from ");
    expect({"--reach", "1e5"}, "--reach: a sparse grid of ");
}

TEST_F(LppvCommand, GivesTheBoxOfASparseGrid) {
    const Json json = run_json(arguments("a.vdb", {"--sparse", "--density", "2"}));
    for (int i = 0; i < 3; ++i) {
        const double size =
            json["bounds"]["high"][i].get<double>() - json["bounds"]["low"][i].get<double>();
        const int count = json["resolution"][i];
        EXPECT_EQ(count % 8, 0);
        EXPECT_EQ(size, 0.5 * (count - 1));
    }
}

TEST_F(LppvCommand, TurnsABoxOfTheWorld) {
    const double half = std::sqrt(0.5);  // a quarter turn about y
    const Json json =
        run_json(arguments("a.vdb", {"--bounds", "0,0,0,4,2,2", "--orientation",
                                     "0," + std::to_string(half) + ",0," + std::to_string(half)}));
    EXPECT_EQ(json["resolution"], Json({4, 2, 2}));
    const Json& matrix = json["bounds"]["world_from_local"];
    const double world_from_local[] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 2, 1, 1, 1};
    for (size_t i = 0; i < 16; ++i) {
        EXPECT_NEAR(matrix[i].get<double>(), world_from_local[i], 1e-12) << i;
    }
}

TEST_F(LppvCommand, AnAxisWithoutThicknessHasOnePoint) {
    const Arguments plane{"--bounds", "0,1,0,4,1,4", "--resolution", "3,2,3"};
    EXPECT_EQ(run_json(arguments("a.vdb", plane))["resolution"], Json({3, 1, 3}));
    const std::string said = succeed(arguments("a.vdb", plane)).err;
    EXPECT_TRUE(contains(said, "no thickness along y: one grid point there, not 2")) << said;
}

TEST_F(LppvCommand, SaysThatSevenSlabsLeaveOutOcclusion) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--mixed-lighting", "shadowmask"});
    EXPECT_TRUE(contains(succeed(beam("a.ktx2")).err, "no room for the occlusion"));
    EXPECT_EQ(succeed(beam("a.ktx2", {"--mode", "normal"})).err, "");
    EXPECT_EQ(succeed(beam("a.vdb")).err, "");
}

TEST_F(LppvCommand, SaysWhatAFileDoesNotHold) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--sky", "1e6"});
    const auto warnings = [&](const std::string& output, const Arguments& more) {
        return succeed(beam(output, more)).err;
    };
    for (const std::string kind : {"vdb", "exr", "dds", "ktx2"}) {
        EXPECT_TRUE(contains(warnings("a." + kind, {}),
                             "were cut to 65504, the largest half; "
                             "--precision float keeps them"))
            << kind;
    }
    EXPECT_EQ(warnings("a.vdb", {"--precision", "float"}), "");
    EXPECT_EQ(warnings("a.nvdb", {}), "");
    EXPECT_TRUE(contains(warnings("a.dds", {"--layout", "four"}), "hold band 2 as its mean"));
    EXPECT_TRUE(contains(misuse(beam("a.vdb", {"--layout", "four"})), "--layout: only .dds"));
}

/// Probes at the corners of a box.
std::string corner_probes(double x, double low_y, double high_y, double z) {
    Json positions = Json::array();
    for (int i = 0; i < 8; ++i) {
        positions.push_back(
            {(i & 1) == 0 ? -x : x, (i & 2) == 0 ? low_y : high_y, (i & 4) == 0 ? -z : z});
    }
    return Json{{"groups", {{{"name", "corners"}, {"positions", positions}}}}}.dump();
}

TEST_F(LppvCommand, WarnsOfPointsOutsideOfTheTetrahedra) {
    write("cube.json", corner_probes(1.0, -1.0, 1.0, 1.0));
    succeed({"tetrahedralize", "cube.json", "-o", "v.probes"});
    // x = 0.1, 0.3 .. 1.9: half of them beyond the probes at x = 1.
    const Arguments half = arguments("a.vdb", {"--bounds", "0,-0.8,-0.8,2,0.8,0.8", "--resolution",
                                               "10,4,4", "--placement", "centers"});
    const std::string said = succeed(half).err;
    EXPECT_TRUE(contains(said,
                         "warning: 80 of 160 points (50.0 %) lie outside of the tetrahedra "
                         "and take the light of the nearest probes; probes at (1."))
        << said;
    const Json coverage = run_json(half)["coverage"];
    EXPECT_EQ(coverage["points"], 160);
    EXPECT_EQ(coverage["covered"], 80);
    EXPECT_EQ(coverage["outside"], 80);
    EXPECT_EQ(coverage["unseen"], nullptr);  // no ray tells
    ASSERT_FALSE(coverage["positions"].empty());
    for (const Json& position : coverage["positions"]) EXPECT_GT(position[0], 1.0);
}

TEST_F(LppvCommand, WarnsOfPointsThatWallsHide) {
    write("far.json", corner_probes(15.0, 0.3, 8.0, 15.0));  // around the house, none in it
    succeed({"bake", kCourtyard, "--only-given-groups", "-g", "far.json", "-o", "v.probes", "-s",
             "16"});
    const Arguments in_house = arguments(
        "a.vdb", {"--scene", kCourtyard, "--bounds", "-3,0.5,-4,-1,2,-2", "--density", "2"});
    const std::string said = succeed(in_house).err;
    EXPECT_TRUE(contains(said,
                         "warning: 48 of 48 points (100.0 %) are hidden by walls from the "
                         "probes around them"))
        << said;
    const Json coverage = run_json(in_house)["coverage"];
    EXPECT_EQ(coverage["unseen"], 48);
    EXPECT_EQ(coverage["positions"].size(), 1u);  // the probes are farther apart than the points
}

TEST_F(LppvCommand, DoesNotWarnOfABoxAmongProbes) {
    const Arguments among = beam("a.vdb", {"--resolution", "3,3,20"});
    EXPECT_EQ(succeed(among).err, "");
    const Json coverage = run_json(among)["coverage"];
    EXPECT_EQ(coverage["points"], 180);
    EXPECT_EQ(coverage["covered"], 180);
    EXPECT_EQ(coverage["unseen"], 0);
    EXPECT_TRUE(coverage["positions"].empty());
}

TEST_F(LppvCommand, NamesAnObjectThatIsNotThere) {
    EXPECT_TRUE(contains(fail(arguments("a.vdb", {"--scene", kCourtyard, "--object", "boat"})),
                         "courtyard.glb: there is no node \"boat\""));
    const std::string lamp = fail(arguments("a.vdb", {"--scene", kCourtyard, "--object", "sun"}));
    EXPECT_TRUE(contains(lamp, " \"sun\": the object has no mesh")) << lamp;
}

}  // namespace
}  // namespace tetralight::test
