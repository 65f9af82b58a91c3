// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tests/cli/command_fixture.h"
#include "tests/cli/picture.h"

namespace tetralight::test {
namespace {

class MeshBall : public CommandFixture {
  protected:
    MeshBall() { bake_courtyard("v.probes"); }

    [[nodiscard]] static Arguments arguments(const Arguments& more) {
        Arguments all{"meshball", "v.probes", "--width",     "24",
                      "--height", "16",       "--antialias", "1"};
        all.insert(all.end(), more.begin(), more.end());
        if (std::ranges::count(more, "-o") == 0) all.insert(all.end(), {"-o", "m.png"});
        return all;
    }

    [[nodiscard]] std::string picture(const Arguments& more) const {
        succeed(arguments(more));
        return read("m.png");
    }
};

TEST_F(MeshBall, WritesAPictureOfTheAskedSize) {
    const auto image = decode_picture(picture({}));
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 24u);
    EXPECT_EQ(image->height, 16u);
}

TEST_F(MeshBall, Holds1023InstancesUnlessToldOtherwise) {
    EXPECT_EQ(run_json(arguments({}))["instances"], 1023);
}

TEST_F(MeshBall, HoldsAsManyInstancesAsAsked) {
    for (const char* count : {"0", "1", "5000"}) {
        EXPECT_EQ(run_json(arguments({"--count", count}))["instances"], std::stoi(count));
        EXPECT_TRUE(decode_picture(read("m.png"))) << count;
    }
}

TEST_F(MeshBall, GivesTheSameBytesForAnyNumberOfThreads) {
    EXPECT_TRUE(picture({"-j", "1"}) == picture({"-j", "2"}));
}

TEST_F(MeshBall, GivesAnotherPictureForAnotherSeed) {
    EXPECT_TRUE(picture({"--seed", "1"}) != picture({"--seed", "2"}));
}

TEST_F(MeshBall, IgnoresWallsWhenAsked) {
    // In the wall between the house's room and the court.
    const Arguments place{"--center", "3.9,1.5,0", "--radius", "0.8"};
    Arguments hidden = place, ignored = place;
    hidden.insert(hidden.end(), {"--walls", "hide"});
    ignored.insert(ignored.end(), {"--walls", "ignore"});
    EXPECT_TRUE(picture(hidden) == picture(place));
    EXPECT_TRUE(picture(ignored) != picture(place));
}

TEST_F(MeshBall, ShowsTheSceneAroundTheBallWhenAsked) {
    EXPECT_TRUE(picture({"--scene", kCourtyard}) != picture({}));
}

TEST_F(MeshBall, ShowsTheSceneWithItsLightmaps) {
    succeed(
        {"lightmap", kCourtyard, "-o", "c.lightmaps", "-t", "1", "--page-size", "64", "-s", "1"});
    EXPECT_TRUE(picture({"--scene", kCourtyard, "--lightmaps", "c.lightmaps"}) !=
                picture({"--scene", kCourtyard}));
    EXPECT_TRUE(contains(misuse(arguments({"--lightmaps", "c.lightmaps"})), "--scene"));
}

TEST_F(MeshBall, MirrorsReflectionProbesAsRoughAsAsked) {
    succeed({"reflect", kCourtyard, "--box", "-9,0,-9,9,6,9", "-o", "r.ktx2", "--cube-size", "8",
             "-s", "1"});
    const std::string own = picture({"--reflections", "r.ktx2"});
    const std::string mirrors = picture({"--reflections", "r.ktx2", "--roughness", "0"});
    EXPECT_TRUE(own != picture({}));
    EXPECT_TRUE(mirrors != own);
    EXPECT_TRUE(mirrors != picture({"--reflections", "r.ktx2", "--roughness", "0.7"}));
    EXPECT_TRUE(contains(misuse(arguments({"--roughness", "0.5"})), "needs --reflections"));
    EXPECT_TRUE(
        contains(fail(arguments({"--reflections", "none.ktx2"})), "none.ktx2: cannot open"));
}

TEST_F(MeshBall, PutsTheBallWhereAsked) {
    const Arguments view{"--eye", "0,1,20", "--target", "0,1,0"};
    Arguments here = view;
    Arguments there = view;
    here.insert(here.end(), {"--center", "-4,1,0", "--radius", "3"});
    there.insert(there.end(), {"--center", "4,1,0", "--radius", "3"});
    EXPECT_TRUE(picture(here) != picture(there));
}

TEST_F(MeshBall, RefusesPlacesThatFloatsDoNotResolve) {
    EXPECT_TRUE(contains(misuse(arguments({"--center", "1e9,0,0"})), "--center: floats cannot"));
    succeed(arguments({"--center", "1e9,0,0", "--radius", "1e5"}));
}

TEST_F(MeshBall, StaysInTheRoomWithProbesThatAreInARoom) {
    // Probes in the courtyard's house: |x| < 4, |z| < 3, its roof at 3.75 m, its open side at +z.
    write("room.json", R"({"groups": [{"name": "room", "positions":
        [[-3, 0.5, -2], [3, 0.5, -2], [-3, 2.7, -2], [3, 2.7, -2],
         [-3, 0.5, 2], [3, 0.5, 2], [-3, 2.7, 2], [3, 2.7, 2]]}]})");
    succeed({"bake", kCourtyard, "-g", "room.json", "--only-given-groups", "-o", "v.probes", "-s",
             "16"});
    const Json eye = run_json(arguments({"--scene", kCourtyard}))["eye"];
    EXPECT_LT(std::abs(eye[0].get<double>()), 4.0) << eye;
    EXPECT_LT(eye[1], 3.75) << eye;
    EXPECT_GT(eye[2], -3.0) << eye;
}

TEST_F(MeshBall, NumbersTheFramesOfAnyName) {
    std::filesystem::create_directory(path("a.b"));
    for (const std::string name : {"seq", "a.b/ball", "a.b/ball.PNG"}) {
        succeed(arguments({"-o", name, "--frames", "2", "--count", "9"}));
    }
    for (const std::string name : {"seq_0000", "a.b/ball_0001", "a.b/ball_0001.PNG"}) {
        EXPECT_TRUE(decode_picture(read(name))) << name;
    }
}

TEST_F(MeshBall, WritesNoFramesToStreams) {
    for (const std::string name : {"-", "/dev/null"}) {
        EXPECT_TRUE(contains(misuse(arguments({"-o", name, "--frames", "2"})), "--frames: "));
    }
}

TEST_F(MeshBall, WarnsOfAVolumeWithoutLight) {
    succeed({"tetrahedralize", kCourtyard, "-o", "v.probes"});
    EXPECT_EQ(succeed(arguments({})).err.find("warning: v.probes: the volume holds no light"), 0u);
}

TEST_F(MeshBall, RefusesBadVolumesAndKeepsTheOldPicture) {
    refuse_each(bad_volumes(read("v.probes")), "m.png", [](const std::string& name) {
        return Arguments{"meshball", name, "-o", "m.png"};
    });
}

TEST_F(MeshBall, RefusesBadScenesAndKeepsTheOldPicture) {
    refuse_each(bad_scenes(read(kCourtyard)), "m.png", [](const std::string& name) {
        return Arguments{"meshball", "v.probes", "--scene", name, "-o", "m.png"};
    });
}

TEST_F(MeshBall, NamesFilesThatAreNotThere) {
    EXPECT_TRUE(
        contains(fail({"meshball", "none.probes", "-o", "m.png"}), "none.probes: cannot open"));
    EXPECT_TRUE(contains(fail({"meshball", "v.probes", "--scene", "none.glb", "-o", "m.png"}),
                         "none.glb: cannot open"));
}

}  // namespace
}  // namespace tetralight::test
