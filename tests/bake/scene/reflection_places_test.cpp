// SPDX-License-Identifier: Apache-2.0
// Places of reflection probes from files: JSON and glTF nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/bake/scene/reflection_places_gltf.h>
#include <tetralight/bake/scene/reflection_places_json.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include "tests/bake/scene/gltf_builder.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Json = nlohmann::json;

GltfBuilder with_probe(Json probe, Json node = Json::object()) {
    GltfBuilder gltf;
    node["name"] = "hall";
    node["extras"]["reflection_probe"] = std::move(probe);
    gltf.add_root(std::move(node));
    return gltf;
}

/// The one place of a scene; a default one, and a failed test, where there is none.
ReflectionPlace place_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    if (!scene || scene->reflection_places.size() != 1) {
        ADD_FAILURE();
        return {};
    }
    return scene->reflection_places[0];
}

void expect_near(const glm::vec3& found, const glm::vec3& expected) {
    EXPECT_LT(glm::distance(found, expected), 1e-5f)
        << found.x << ", " << found.y << ", " << found.z;
}

TEST(GltfReflectionPlaces, TrueAndAnEmptyObjectHaveDefaults) {
    ReflectionPlace expected;
    expected.name = "hall";
    expected.position = {1, 2, 3};
    EXPECT_EQ(place_of(with_probe(true, {{"translation", {1, 2, 3}}})), expected);
    EXPECT_EQ(place_of(with_probe(Json::object(), {{"translation", {1, 2, 3}}})), expected);
    EXPECT_EQ(expected.half_size, glm::vec3(5.0f));  // 10 m
    const auto scene = with_probe(false).read();
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->reflection_places.empty());
}

TEST(GltfReflectionPlaces, HaveTheirMembers) {
    const ReflectionPlace place = place_of(with_probe({{"size", {4, 3, 6}},
                                                       {"center", {0.5, 1.5, 0}},
                                                       {"blend_distance", 0.25},
                                                       {"importance", -3.0},
                                                       {"near", 0.1}}));
    EXPECT_EQ(place.half_size, glm::vec3(2, 1.5f, 3));
    EXPECT_EQ(place.box_center, glm::vec3(0.5f, 1.5f, 0));
    EXPECT_EQ(place.axes, glm::mat3(1.0f));
    EXPECT_EQ(place.blend_distance, 0.25f);
    EXPECT_EQ(place.importance, -3);
    EXPECT_EQ(place.near_distance, 0.1f);
}

TEST(GltfReflectionPlaces, TurnAndScaleWithTheirNode) {
    // A quarter turn about Y takes X to -Z and Z to X.
    const ReflectionPlace place =
        place_of(with_probe({{"size", {4, 2, 6}}, {"center", {1, 0, 0}}},
                            {{"rotation", {0, 0.70710678118654757, 0, 0.70710678118654757}},
                             {"scale", {2, 3, 0.5}},
                             {"translation", {0, 7, 0}}}));
    expect_near(place.half_size, {4, 3, 1.5f});
    expect_near(place.box_center, {0, 0, -2});
    expect_near(place.axes[0], {0, 0, -1});
    expect_near(place.axes[1], {0, 1, 0});
    expect_near(place.axes[2], {1, 0, 0});
    EXPECT_EQ(place.position, glm::dvec3(0, 7, 0));
}

TEST(GltfReflectionPlaces, AMirroredBoxIsTheSameBox) {
    const ReflectionPlace place =
        place_of(with_probe({{"size", {4, 2, 6}}, {"center", {1, 0, 1}}}, {{"scale", {1, 1, -1}}}));
    expect_near(place.half_size, {2, 1, 3});
    expect_near(place.box_center, {1, 0, -1});
    EXPECT_EQ(place.axes, glm::mat3(1.0f));
}

TEST(GltfReflectionPlaces, ErrorsOfTheTransformNameTheNodeAndTheValue) {
    const std::string start = "scene.glb: node 0 \"hall\": extras.reflection_probe";
    EXPECT_EQ(with_probe(true, {{"scale", {1, 0, 2}}}).error(),
              start + ": the scale of the node, [1, 0, 2], has a zero");
    // X stays, Y goes to (1, 1, 0).
    EXPECT_EQ(
        with_probe(true, {{"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}).error(),
        start + ": the node is sheared: its axes X and Y are 45 degrees apart");
    EXPECT_EQ(with_probe({{"size", {2, 2, 2}}}, {{"scale", {1, 1e-9, 1}}}).error(),
              start +
                  ".size [2, 2, 2] makes a box of [2, 2e-09, 2] m with the scale of the node, "
                  "not of 1e-06 to 1e+12 m");
}

TEST(GltfReflectionPlaces, ErrorsNameTheMemberAndTheValue) {
    const auto error_of = [](const char* key, const Json& value) {
        return with_probe({{key, value}}).error();
    };
    const std::string start = "scene.glb: node 0 \"hall\": extras.reflection_probe";
    EXPECT_EQ(error_of("size", {1, 0, 1}), start + ".size [1, 0, 1] is not three lengths above 0");
    EXPECT_EQ(error_of("blend_distance", -1),
              start + ": blend_distance -1 is not a length from 0 to 1e+12 m");
    EXPECT_EQ(error_of("near", -0.5), start + ": near -0.5 is not a length from 0 to 1e+12 m");
    EXPECT_EQ(error_of("center", {1e13, 0, 0}),
              start + ": box.center [1e+13, 0, 0] is farther than 1e+12 m away");
    const std::string type = "scene.glb: node 0 \"hall\": extras/reflection_probe";
    EXPECT_EQ(error_of("size", {1, 2}), type + "/size is not an array of 3 numbers ([1,2])");
    for (const Json& wrong : {Json(1.5), Json(3000000000), Json("high"), Json(true)}) {
        EXPECT_EQ(error_of("importance", wrong),
                  type + "/importance is not an integer from -2147483648 to 2147483647 (" +
                      wrong.dump() + ")");
    }
    EXPECT_EQ(with_probe(3).error(), type + " is not an object or a boolean (3)");
}

TEST(GltfReflectionPlaces, FieldsNameTheMember) {
    const auto scene = with_probe({{"near", -1}}).read();
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().field, "nodes[0].extras.reflection_probe.near");
    EXPECT_EQ(scene.error().value, "-1");
}

TEST(GltfReflectionPlaces, InReflectionsIsInheritedAndCanBeSetAgain) {
    GltfBuilder gltf;
    const size_t mesh = gltf.add_triangle();
    const size_t lamp = gltf.add(
        "nodes", {{"mesh", mesh}, {"name", "lamp"}, {"extras", {{"in_reflections", true}}}});
    const size_t shelf = gltf.add("nodes", {{"mesh", mesh}, {"name", "shelf"}});
    gltf.add_root({{"mesh", mesh},
                   {"name", "furniture"},
                   {"children", {lamp, shelf}},
                   {"extras", {{"in_reflections", false}}}});
    gltf.add_root({{"mesh", mesh}, {"name", "wall"}});
    const auto scene = gltf.read();
    ASSERT_TRUE(scene) << error_text(scene.error());
    std::vector<std::pair<std::string, bool>> found;
    for (const auto& i : scene->instances) found.emplace_back(i.name, i.is_in_reflections);
    const std::vector<std::pair<std::string, bool>> expected = {
        {"furniture", false}, {"lamp", true}, {"shelf", false}, {"wall", true}};
    EXPECT_EQ(found, expected);
    for (const auto& instance : scene->instances) EXPECT_FALSE(instance.is_walkable);
}

TEST(GltfReflectionPlaces, RefusesInReflectionsThatIsNoBoolean) {
    GltfBuilder gltf;
    gltf.add_root({{"mesh", gltf.add_triangle()}, {"extras", {{"in_reflections", "no"}}}});
    EXPECT_EQ(gltf.error(), "scene.glb: node 0: extras/in_reflections is not a boolean (\"no\")");
}

Result<std::vector<ReflectionPlace>> read_text(const std::string& text) {
    const TempFolder folder;
    auto result =
        read_reflection_places_json(folder.write("r.json", std::as_bytes(std::span(text))));
    if (result) return result;
    Error error = result.error();
    const std::string message = error_text(error);
    error.message = message.substr(message.find("r.json: ") + 8);
    return error;
}

std::string error_of(const std::string& text) {
    const auto result = read_text(text);
    return result ? "(no error)" : error_text(result.error());
}

std::string one(const std::string& members) {
    return R"({"reflection_probes": [{"name": "a", )" + members + "}]}";
}

TEST(ReflectionPlacesJson, AreRead) {
    const auto places = read_text(R"({"reflection_probes": [
        {"name": "hall", "position": [0, 1.5, 0],
         "box": {"center": [0, 0.25, 0], "half_size": [4, 1.75, 3],
                 "axes": [[0, 0, -1], [0, 1, 0], [1, 0, 0]]},
         "blend_distance": 0.35, "importance": 2, "near": 0.1},
        {"name": "yard", "position": [9, 2, 0]}]})");
    ASSERT_TRUE(places) << error_text(places.error());
    ReflectionPlace hall{.name = "hall",
                         .position = {0, 1.5, 0},
                         .box_center = {0, 0.25f, 0},
                         .half_size = {4, 1.75f, 3},
                         .axes = {glm::vec3(0, 0, -1), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)},
                         .blend_distance = 0.35f,
                         .importance = 2,
                         .near_distance = 0.1f};
    ReflectionPlace yard;
    yard.name = "yard";
    yard.position = {9, 2, 0};
    EXPECT_EQ(*places, (std::vector<ReflectionPlace>{hall, yard}));
}

/// Half of them turned about Y.
std::vector<ReflectionPlace> random_places() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-50.0, 50.0);
    std::vector<ReflectionPlace> places;
    for (int i = 0; i < 50; ++i) {
        ReflectionPlace place;
        place.name = "place \"" + std::to_string(i) + "\"";
        place.position = {any(random), any(random), any(random)};
        place.box_center = glm::vec3(any(random), any(random), any(random));
        place.half_size = glm::abs(glm::vec3(any(random), any(random), any(random))) + 0.01f;
        const auto angle = static_cast<float>(any(random));
        if (i % 2 == 0) {
            place.axes[0] = {std::cos(angle), 0, -std::sin(angle)};
            place.axes[2] = {std::sin(angle), 0, std::cos(angle)};
        }
        place.blend_distance = std::abs(static_cast<float>(any(random)));
        place.importance = i - 25;
        place.near_distance = 0.01f * static_cast<float>(i);
        places.push_back(place);
    }
    return places;
}

TEST(ReflectionPlacesJson, WhatIsWrittenReadsBackToTheSame) {
    const std::vector<ReflectionPlace> places = random_places();
    const TempFolder folder;
    const std::string path = folder.path("r.json");
    const auto written = write_reflection_places_json(path, places);
    ASSERT_TRUE(written) << error_text(written.error());
    const auto read = read_reflection_places_json(path);
    ASSERT_TRUE(read) << error_text(read.error());
    EXPECT_EQ(*read, places);
    ASSERT_TRUE(write_reflection_places_json(path, {}));
    EXPECT_EQ(read_reflection_places_json(path)->size(), 0u);
}

TEST(ReflectionPlacesGltf, WhatIsWrittenReadsBackToTheSamePlaces) {
    std::vector<ReflectionPlace> places = random_places();
    const TempFolder folder;
    const std::string path = folder.path("r.glb");
    const auto written = write_reflection_places_glb(path, places);
    ASSERT_TRUE(written) << error_text(written.error());
    const auto scene = read_gltf(path);
    ASSERT_TRUE(scene) << error_text(scene.error());
    ASSERT_EQ(scene->reflection_places.size(), places.size());
    for (size_t i = 0; i < places.size(); ++i) {
        ReflectionPlace& found = places[i];
        const ReflectionPlace& read = scene->reflection_places[i];
        EXPECT_LT(glm::distance(read.box_center, found.box_center), 1e-4f) << i;
        EXPECT_LT(glm::distance(read.half_size, found.half_size), 1e-4f) << i;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LT(glm::distance(read.axes[axis], found.axes[axis]), 1e-6f) << i;
        }
        found.box_center = read.box_center;
        found.half_size = read.half_size;
        found.axes = read.axes;
        EXPECT_EQ(read, found);
    }
    ASSERT_TRUE(write_reflection_places_glb(path, {}));
    const auto empty = read_gltf(path);
    ASSERT_TRUE(empty) << error_text(empty.error());
    EXPECT_TRUE(empty->reflection_places.empty());
}

TEST(ReflectionPlacesGltf, AMirroredFrameIsTheSameBox) {
    ReflectionPlace place;
    place.name = "a";
    place.axes[2] = {0, 0, -1};
    place.box_center = {1, 2, 3};
    const TempFolder folder;
    ASSERT_TRUE(write_reflection_places_glb(folder.path("r.glb"), std::vector{place}));
    const auto scene = read_gltf(folder.path("r.glb"));
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->reflection_places.size(), 1u);
    EXPECT_EQ(scene->reflection_places[0].box_center, place.box_center);
    EXPECT_EQ(scene->reflection_places[0].axes, glm::mat3(1.0f));
}

TEST(ReflectionPlacesJson, ErrorsNameTheProbeTheMemberAndTheValue) {
    const std::string place = "reflection probe \"a\": ";
    const auto with = [&](const std::string& members) {
        return error_of(one(R"("position": [0, 0, 0], )" + members));
    };
    EXPECT_EQ(error_of(one(R"("importance": 1)")), place + "position is missing");
    EXPECT_EQ(error_of(one(R"("position": [0, 1])")),
              place + "position is not three numbers ([0,1])");
    EXPECT_EQ(with(R"("box": 3)"), place + "box is not an object (3)");
    EXPECT_EQ(with(R"("box": {"half_size": [1, 0, 1]})"),
              place + "box.half_size [1, 0, 1] is not three lengths above 0, up to 1e+12 m");
    EXPECT_EQ(with(R"("box": {"size": [1, 1, 1]})"), place + "box: unknown key \"size\"");
    EXPECT_EQ(with(R"("box": {"axes": [[1, 0, 0], [1, 0, 0], [0, 0, 1]]})"),
              place +
                  "box.axes [[1, 0, 0], [1, 0, 0], [0, 0, 1]] are not unit vectors at right "
                  "angles");
    EXPECT_EQ(with(R"("box": {"axes": [[1, 0, 0], [0, 1, 0]]})"),
              place + "box: axes is not three times three numbers ([[1,0,0],[0,1,0]])");
    EXPECT_EQ(with(R"("blend_distance": -1)"),
              place + "blend_distance -1 is not a length from 0 to 1e+12 m");
    EXPECT_EQ(with(R"("near": "x")"), place + "near is not a number (\"x\")");
    EXPECT_EQ(with(R"("importance": 0.5)"),
              place + "importance is not an integer from -2147483648 to 2147483647 (0.5)");
    EXPECT_EQ(with(R"("far": 1)"), place + "unknown key \"far\"");
}

TEST(ReflectionPlacesJson, ErrorsOfTheFileAreFound) {
    EXPECT_EQ(error_of("[]"), "is not a JSON object");
    EXPECT_EQ(error_of(R"({"reflection_probes": 7})"),
              "reflection_probes is missing or not an array");
    EXPECT_EQ(error_of(R"({"groups": []})"), "unknown key \"groups\"");
    EXPECT_EQ(error_of(R"({"reflection_probes": [1]})"), "reflection probe 0: is not an object");
    EXPECT_EQ(error_of(R"({"reflection_probes": [{"position": [0, 0, 0]}]})"),
              "reflection probe 0: has no name");
    EXPECT_EQ(error_of(R"({"reflection_probes": [{"name": "a", "position": [0, 0, 0]},
                                                 {"name": "a", "position": [0, 0, 0]}]})"),
              "two reflection probes are named \"a\"");
    EXPECT_EQ(error_of(one(R"("near": 0, "near": 1)")), "\"near\" is given twice in one object");
    EXPECT_NE(error_of("{"), "(no error)");
    const auto result = read_text(one(R"("position": [0, 0, 0], "near": -1)"));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().field, "reflection_probes[0].near");
    EXPECT_EQ(result.error().value, "-1");
}

TEST(ReflectionPlacesJson, WhatCannotBeReadIsNotWritten) {
    const TempFolder folder;
    const std::string path = folder.path("r.json");
    ReflectionPlace place;
    EXPECT_FALSE(write_reflection_places_json(path, std::vector{place}));  // no name
    place.name = "a";
    EXPECT_FALSE(write_reflection_places_json(path, std::vector{place, place}));
    place.half_size.x = 0.0f;
    const auto status = write_reflection_places_json(path, std::vector{place});
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().field, "reflection_probes[0].box.half_size");
    EXPECT_FALSE(read_file(path));
}

}  // namespace
}  // namespace tetralight
