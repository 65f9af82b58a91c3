// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/command_fixture.h"
#include "tests/cli/picture.h"

namespace tetralight::test {
namespace {

/// A triangle that moves and asks for a proxy volume, a kilometre wide.
const std::string kFarScene =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "far", "mesh": 0, "scale": [1000, 1000, 1000],
               "extras": {"light_probes": "proxy_volume", "contribute_gi": false}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 0, 1]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/"}]})";

/// A white triangle of 1.1 m along +X and +Z that faces up, under an orthographic camera that looks
/// down and shows 4 m from its lower to its upper edge.
const std::string kPlanScene =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
    "nodes": [{"name": "sheet", "mesh": 0, "scale": [1.1, 1.1, 1.1]},
              {"name": "front", "camera": 0, "translation": [0, 1, 5]},
              {"name": "plan", "camera": 1, "translation": [0, 3, 0],
               "rotation": [-0.70710678, 0, 0, 0.70710678], "scale": [5, 5, 5]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}},
                {"type": "orthographic",
                 "orthographic": {"xmag": 9, "ymag": 2, "znear": 0.1, "zfar": 10}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, 0], "max": [1, 0, 1]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"}]})";

class Render : public CommandFixture {
  protected:
    Render() { bake_courtyard("v.probes"); }

    [[nodiscard]] static Arguments arguments(const Arguments& more) {
        Arguments all{"render", kCourtyard, "v.probes", "-o",          "r.png", "--width",
                      "24",     "--height", "16",       "--antialias", "1"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    [[nodiscard]] std::string picture(const Arguments& more) const {
        succeed(arguments(more));
        return read("r.png");
    }
};

TEST_F(Render, WritesAPictureOfTheAskedSize) {
    const auto image = decode_picture(picture({}));
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 24u);
    EXPECT_EQ(image->height, 16u);
}

TEST_F(Render, GivesTheSameBytesForAnyNumberOfThreads) {
    EXPECT_TRUE(picture({"-j", "1"}) == picture({"-j", "2"}));
}

TEST_F(Render, TakesTheFirstCameraUnlessToldOtherwise) {
    EXPECT_TRUE(picture({}) == picture({"--camera", "camera"}));
}

TEST_F(Render, TakesACameraByName) {
    EXPECT_TRUE(picture({"--camera", "camera_interior"}) != picture({"--camera", "camera"}));
}

TEST_F(Render, TakesAnOrthographicCameraByName) {
    write("plan.gltf", kPlanScene);
    succeed({"render", "plan.gltf", "v.probes", "-o", "r.png", "--width", "24", "--height", "16",
             "--antialias", "1", "--show", "albedo", "--camera", "plan"});
    const auto image = decode_picture(read("r.png"));
    ASSERT_TRUE(image);
    for (uint32_t row = 0; row < 16; ++row) {
        for (uint32_t column = 0; column < 24; ++column) {
            // Pixels of 0.25 m; +X is right, +Z is down.
            const double x = 0.25 * (column + 0.5 - 12.0), z = 0.25 * (row + 0.5 - 8.0);
            const bool is_sheet = x > 0.0 && z > 0.0 && x + z < 1.1;
            EXPECT_EQ(image->pixels[row * 24 + column][0] > 128, is_sheet) << column << " " << row;
        }
    }
}

TEST_F(Render, TakesACameraByPosition) {
    EXPECT_TRUE(picture({"--eye", "0,30,0.1", "--target", "0,0,0"}) != picture({}));
}

TEST_F(Render, ListsTheCamerasWhenItHasNoneOfTheName) {
    const std::string message = fail_and_keep("r.png", arguments({"--camera", "nave"}));
    EXPECT_TRUE(contains(message, "no camera \"nave\"")) << message;
    EXPECT_TRUE(contains(message, "\"camera\" \"camera_interior\"")) << message;
}

TEST_F(Render, NamesTheNodeWhoseProxyVolumeIsTooLarge) {
    write("far.gltf", kFarScene);
    const std::string message = fail({"render", "far.gltf", "v.probes", "-o", "r.png"});
    EXPECT_TRUE(contains(message, "far.gltf: node \"far\": a grid of 3000 x 1 x 3000 points"))
        << message;
}

TEST_F(Render, RefusesEmptyNames) {
    EXPECT_TRUE(contains(misuse(arguments({"--camera", ""})), "--camera: the name is empty"));
}

TEST_F(Render, RefusesToLookFromAPointAtItself) {
    EXPECT_TRUE(contains(misuse(arguments({"--eye", "1,2,3", "--target", "1,2,3"})), "--target"));
}

TEST_F(Render, RefusesTwoCameras) {
    const std::string message =
        misuse(arguments({"--eye", "1,2,3", "--target", "0,0,0", "--camera", "camera"}));
    EXPECT_TRUE(contains(message, "--camera: does not go with --eye")) << message;
}

TEST_F(Render, DrawsTheCellsWhenAsked) {
    const std::string plain = picture({});
    const std::string edges = picture({"--show", "cells", "-j", "1"});
    const std::string probes = picture({"--show", "probes", "--ball-radius", "0.5"});
    EXPECT_TRUE(edges != plain && probes != plain && edges != probes);
    EXPECT_TRUE(edges == picture({"--show", "cells", "-j", "2"}));
    EXPECT_TRUE(
        contains(misuse(arguments({"--show", "probes", "--ball-radius", "0"})), "--ball-radius"));
}

TEST_F(Render, WarnsIfThereAreNoOpeningsToShow) {
    const std::string warning = "warning: no opening was found";
    EXPECT_EQ(succeed(arguments({"--show", "openings"})).err.find(warning), 0u);
    EXPECT_TRUE(contains(misuse(arguments({"--show", "windows"})), "openings"));
}

TEST_F(Render, ShowsLightThroughWallsWhenAsked) {
    const Arguments inside{"--camera", "camera_interior"};
    Arguments hidden = inside, ignored = inside;
    hidden.insert(hidden.end(), {"--walls", "hide"});
    ignored.insert(ignored.end(), {"--walls", "ignore"});
    EXPECT_TRUE(picture(hidden) == picture(inside));
    EXPECT_TRUE(picture(ignored) != picture(inside));
}

TEST_F(Render, ShowsPartsOfTheLight) {
    const std::string lit = picture({});
    for (const char* view : {"received", "direct", "bounce", "emission", "albedo"})
        EXPECT_TRUE(picture({"--show", view}) != lit) << view;
    EXPECT_TRUE(contains(misuse(arguments({"--show", "albedo,direct"})),
                         "surfaces cannot show \"albedo\" and \"direct\" at once"));
}

TEST_F(Render, ShowsWhatLightmapsHold) {
    succeed(
        {"lightmap", kCourtyard, "-o", "c.lightmaps", "-t", "1", "--page-size", "64", "-s", "1"});
    const Arguments maps{"--lightmaps", "c.lightmaps"};
    const std::string lit = picture(maps);
    EXPECT_TRUE(lit != picture({}));
    for (const char* view :
         {"unwrapped-uv", "lightmap-uv", "texels", "validity", "pages", "seams"}) {
        Arguments all = maps;
        all.insert(all.end(), {"--show", view});
        EXPECT_TRUE(picture(all) != lit) << view;
        EXPECT_TRUE(contains(misuse(arguments({"--show", view})),
                             std::string("\"") + view + "\" needs --lightmaps"));
    }
}

TEST_F(Render, WarnsOfAShadowColorThatChangesNothing) {
    for (const std::string mode : {"shadowmask", "subtractive"}) {
        succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "1", "--mixed-lighting", mode});
        succeed({"lightmap", kCourtyard, "-o", "c.lightmaps", "-t", "1", "--page-size", "64", "-s",
                 "1", "--mixed-lighting", mode});
        const std::string err =
            succeed(arguments({"--lightmaps", "c.lightmaps", "--shadow-color", "1,0,0"})).err;
        EXPECT_EQ(contains(err,
                           "warning: the shadow color changes nothing: c.lightmaps is not "
                           "subtractive\n"),
                  mode == "shadowmask")
            << err;
    }
}

TEST_F(Render, NamesLightmapsAndProbesOfDifferentMixedLighting) {
    succeed({"lightmap", kCourtyard, "-o", "c.lightmaps", "-t", "1", "--page-size", "64", "-s", "1",
             "--mixed-lighting", "shadowmask"});
    const std::string expected =
        "c.lightmaps and v.probes: the lightmaps were baked with --mixed-lighting shadowmask and "
        "the probes with indirect";
    const std::string error = fail(arguments({"--lightmaps", "c.lightmaps"}));
    EXPECT_TRUE(contains(error, expected)) << error;
    const std::string of_ball = fail({"meshball", "v.probes", "--scene", kCourtyard, "--lightmaps",
                                      "c.lightmaps", "-o", "m.png"});
    EXPECT_TRUE(contains(of_ball, expected)) << of_ball;
}

TEST_F(Render, WarnsOfAVolumeWithoutLight) {
    succeed({"tetrahedralize", kCourtyard, "-o", "v.probes"});
    const std::string warning = "warning: v.probes: the volume holds no light";
    EXPECT_EQ(succeed(arguments({})).err.find(warning), 0u);
    EXPECT_EQ(succeed(arguments({"--quiet"})).err, "");
}

TEST_F(Render, ShowsMoreLightAtMoreExposure) {
    const auto dark = decode_picture(picture({"--exposure", "0.1"}));
    const auto light = decode_picture(picture({"--exposure", "10"}));
    ASSERT_TRUE(dark && light);
    uint64_t dark_sum = 0;
    uint64_t light_sum = 0;
    for (const auto& pixel : dark->pixels) dark_sum += pixel[0];
    for (const auto& pixel : light->pixels) light_sum += pixel[0];
    EXPECT_GT(light_sum, dark_sum);
}

TEST_F(Render, RendersASceneWithoutCamerasAndMeshes) {
    write("empty.gltf", kEmptyScene);
    succeed({"render", "empty.gltf", "v.probes", "-o", "r.png", "--width", "4", "--height", "4"});
    EXPECT_TRUE(decode_picture(read("r.png")));
}

TEST_F(Render, RefusesBadScenesAndKeepsTheOldPicture) {
    refuse_each(bad_scenes(read(kCourtyard)), "r.png", [](const std::string& name) {
        return Arguments{"render", name, "v.probes", "-o", "r.png"};
    });
}

TEST_F(Render, RefusesBadVolumesAndKeepsTheOldPicture) {
    refuse_each(bad_volumes(read("v.probes")), "r.png", [](const std::string& name) {
        return Arguments{"render", kCourtyard, name, "-o", "r.png"};
    });
}

TEST_F(Render, NamesFilesThatAreNotThere) {
    EXPECT_TRUE(
        contains(fail({"render", "none.glb", "v.probes", "-o", "r.png"}), "none.glb: cannot open"));
    EXPECT_TRUE(contains(fail({"render", kCourtyard, "none.probes", "-o", "r.png"}),
                         "none.probes: cannot open"));
}

}  // namespace
}  // namespace tetralight::test
