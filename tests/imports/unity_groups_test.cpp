// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/unity_groups.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include <tetralight/base/str_cat.h>
#include "tests/imports/import_case.h"

namespace tetralight {
namespace {

const std::string kHead = "%YAML 1.1\n%TAG !u! tag:unity3d.com,2011:\n";

/// An object with ID `id` and its transform with ID `id + 1`.
struct UnityNode {
    int64_t id = 0;
    std::string name;
    int64_t parent = 0;
    glm::dvec3 position{0.0};
    glm::dvec4 rotation{0, 0, 0, 1};
    glm::dvec3 scale{1.0};
    bool is_active = true;
};

std::string vector_text(const glm::dvec3& v) {
    return str_cat("{x: ", v.x, ", y: ", v.y, ", z: ", v.z, "}");
}

std::string text_of(const UnityNode& node) {
    const glm::dvec4& q = node.rotation;
    return str_cat("--- !u!1 &", node.id, "\nGameObject:\n  m_ObjectHideFlags: 0\n  m_Component:\n",
                   "  - component: {fileID: ", node.id + 1, "}\n  m_Name: ", node.name,
                   "\n  m_IsActive: ", node.is_active ? 1 : 0, "\n--- !u!4 &", node.id + 1,
                   "\nTransform:\n  m_GameObject: {fileID: ", node.id,
                   "}\n  m_LocalRotation: {x: ", q.x, ", y: ", q.y, ", z: ", q.z, ", w: ", q.w,
                   "}\n  m_LocalPosition: ", vector_text(node.position),
                   "\n  m_LocalScale: ", vector_text(node.scale),
                   "\n  m_Children: []\n  m_Father: {fileID: ", node.parent, "}\n");
}

std::string probes_text(int64_t id, int64_t object, const std::string& positions,
                        const std::string& more = "") {
    return str_cat("--- !u!220 &", id, "\nLightProbeGroup:\n  m_GameObject: {fileID: ", object,
                   "}\n  m_Enabled: 1\n  serializedVersion: 2\n  m_SourcePositions:", positions,
                   "\n", more);
}

const std::string kTwoPositions = "\n  - {x: 1, y: 2, z: 3}\n  - {x: -4.5, y: 0, z: 1e-1}";

/// A file with one object named Hall at the origin and a group of two probes.
std::string hall(const std::string& more = "") {
    return kHead + text_of({.id = 10, .name = "Hall"}) + probes_text(12, 10, kTwoPositions, more);
}

ImportedGroups read_unity(std::string_view text) {
    return sound_import("level.unity", text);
}

std::string unity_error(std::string_view text) {
    return import_error("level.unity", text);
}

void expect_near(const glm::dvec3& value, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(value[axis], expected[axis], 1e-12);
}

TEST(UnityGroups, NegateXOfPositions) {
    const auto read = read_unity(hall());
    ASSERT_EQ(read.groups.size(), 1u);
    EXPECT_EQ(read.groups[0].name, "Hall");
    EXPECT_EQ(read.groups[0].positions, (std::vector<glm::dvec3>{{-1, 2, 3}, {4.5, 0, 0.1}}));
    EXPECT_FALSE(read.groups[0].dering);
    EXPECT_TRUE(read.warnings.empty());
}

TEST(UnityGroups, RemoveRingingIsDering) {
    EXPECT_TRUE(read_unity(hall("  m_Dering: 1\n")).groups.at(0).dering);
}

/// The quaternion of a turn by an angle about an axis, in axes of either handedness.
glm::dvec4 quaternion(double angle, const glm::dvec3& axis) {
    return {glm::normalize(axis) * std::sin(angle / 2), std::cos(angle / 2)};
}

TEST(UnityGroups, ATurnAboutYIsClockwiseFromAbove) {
    // In Unity a turn by 90 degrees about y takes forward, z, to the right, x.
    const auto read =
        read_unity(kHead +
                   text_of({.id = 10,
                            .name = "Hall",
                            .position = {5, 0, 0},
                            .rotation = quaternion(std::numbers::pi / 2, {0, 1, 0})}) +
                   probes_text(12, 10, "\n  - {x: 0, y: 1, z: 2}"));
    expect_near(read.groups.at(0).positions.at(0), {-7, 1, 0});
}

TEST(UnityGroups, TransformsOfAllParentsApply) {
    const UnityNode level{.id = 10,
                          .name = "Level",
                          .position = {1, 2, 3},
                          .rotation = quaternion(0.7, {1, 2, 3}),
                          .scale = {2, 1, 0.5}};
    const UnityNode room{.id = 20,
                         .name = "Room",
                         .parent = 11,
                         .position = {-3, 0, 1},
                         .rotation = quaternion(-1.3, {0, 1, -1}),
                         .scale = {1, -2, 3}};
    // The formula of a rotation is the same in axes of either handedness.
    const auto matrix = [](const UnityNode& node, double angle, const glm::dvec3& axis) {
        return glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), node.position), angle,
                                      glm::normalize(axis)),
                          node.scale);
    };
    const glm::dvec4 world =
        matrix(level, 0.7, {1, 2, 3}) * matrix(room, -1.3, {0, 1, -1}) * glm::dvec4(1, 2, 3, 1);
    // Children may stand before their parents.
    const auto read = read_unity(kHead + probes_text(30, 20, "\n  - {x: 1, y: 2, z: 3}") +
                                 text_of(room) + text_of(level));
    EXPECT_EQ(read.groups.at(0).name, "Level/Room");
    expect_near(read.groups[0].positions.at(0), {-world.x, world.y, world.z});
}

TEST(UnityGroups, QuaternionsNeedNotBeUnit) {
    const auto read =
        read_unity(kHead + text_of({.id = 10, .name = "Hall", .rotation = {0, 3, 0, 3}}) +
                   probes_text(12, 10, "\n  - {x: 0, y: 0, z: 1}"));
    expect_near(read.groups.at(0).positions.at(0), {-1, 0, 0});
}

TEST(UnityGroups, NamesAreThoseOfObjects) {
    const std::string one = "\n  - {x: 0, y: 0, z: 0}";
    const auto read = read_unity(
        kHead + text_of({.id = 10, .name = "'Hall: \"A\" # 1'"}) + probes_text(12, 10, one) +
        text_of({.id = 20, .name = "7", .parent = 11}) + probes_text(22, 20, one) +
        text_of({.id = 30, .name = "7", .parent = 11}) + probes_text(-32, 30, one) +
        text_of({.id = 40, .name = ""}) + probes_text(42, 40, one));
    ASSERT_EQ(read.groups.size(), 4u);
    EXPECT_EQ(read.groups[0].name, "Hall: \"A\" # 1");
    EXPECT_EQ(read.groups[1].name, "Hall: \"A\" # 1/7");
    EXPECT_EQ(read.groups[2].name, "Hall: \"A\" # 1/7 #-32");
    EXPECT_EQ(read.groups[3].name, "#42");
}

TEST(UnityGroups, PrefabsAndOtherClassesAreTaken) {
    // Headers of components that are not needed may hold anything.
    const std::string other = "--- !u!114 &99\nMonoBehaviour:\n  m_Text: [not, closed\n";
    const auto read = sound_import("hall.prefab", hall() + other);
    EXPECT_EQ(read.groups.at(0).positions.size(), 2u);
    const std::string windows = [] {
        std::string text;
        for (const char letter : hall())
            text += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
        return text;
    }();
    EXPECT_EQ(sound_import("hall.prefab", windows).groups.at(0).positions.size(), 2u);
}

TEST(UnityGroups, AGroupWithoutPositionsHasAWarning) {
    const auto read =
        read_unity(kHead + text_of({.id = 10, .name = "Hall"}) + probes_text(12, 10, " []"));
    EXPECT_EQ(from_name(read.groups.at(0).empty_warning, "level.unity"),
              "level.unity: the LightProbeGroup of \"Hall\" has no probes");
}

/// The reasons for which groups are left out, beside one that is read.
std::vector<std::string> left_out(const std::string& text) {
    const auto read = read_unity(hall() + text);
    EXPECT_EQ(read.groups.size(), 1u);
    std::vector<std::string> warnings;
    for (const std::string& warning : read.warnings)
        warnings.push_back(from_name(warning, "level.unity").substr(13));
    return warnings;
}

TEST(UnityGroups, WhatIsOffIsLeftOut) {
    const UnityNode off{.id = 20, .name = "Off", .is_active = false};
    EXPECT_EQ(left_out(text_of(off) + text_of({.id = 30, .name = "Below", .parent = 21}) +
                       probes_text(40, 30, kTwoPositions)),
              (std::vector<std::string>{"LightProbeGroup: that of \"Off/Below\" is left out: the "
                                        "object or a parent is not active"}));
    EXPECT_EQ(
        left_out(
            "--- !u!220 &50\nLightProbeGroup:\n  m_GameObject: {fileID: 10}\n  m_Enabled: 0\n"),
        (std::vector<std::string>{
            "LightProbeGroup: that of \"Hall\" is left out: the component is off"}));
    EXPECT_EQ(
        unity_error(kHead + text_of(off) + probes_text(22, 20, kTwoPositions)),
        "level.unity: has no LightProbeGroup that can be read: that of \"Off\" is left out: the "
        "object or a parent is not active");
}

const std::string kInstance =
    "--- !u!1001 &60\nPrefabInstance:\n  m_SourcePrefab: {fileID: 1, guid: ab, type: 3}\n"
    "--- !u!4 &61 stripped\nTransform:\n  m_CorrespondingSourceObject: {fileID: 1, guid: ab, type: "
    "3}\n"
    "  m_PrefabInstance: {fileID: 60}\n"
    "--- !u!1 &62 stripped\nGameObject:\n  m_PrefabInstance: {fileID: 60}\n"
    "--- !u!220 &63 stripped\nLightProbeGroup:\n  m_PrefabInstance: {fileID: 60}\n";

TEST(UnityGroups, PrefabInstancesAreNotFollowed) {
    const std::string prefab =
        "1 prefab instance is not followed, and its probes are not read; in Unity, Unpack Prefab "
        "puts their objects into this file";
    const std::string reason =
        " is left out: it belongs to a prefab instance, or is below one, and its place is not in "
        "this file";
    EXPECT_EQ(left_out(kInstance + text_of({.id = 70, .name = "Below", .parent = 61}) +
                       probes_text(72, 70, kTwoPositions) + probes_text(73, 62, kTwoPositions)),
              (std::vector<std::string>{
                  "LightProbeGroup: that of \"(prefab instance)/Below\"" + reason,
                  "LightProbeGroup: that of \"(prefab instance)\"" + reason, prefab}));
    EXPECT_EQ(unity_error(kHead + kInstance), "level.unity: has no LightProbeGroup; " + prefab);
}

TEST(UnityGroups, ErrorsNameLineObjectAndValue) {
    const auto with = [](const std::string& positions) {
        return unity_error(kHead + probes_text(12, 10, positions));
    };
    EXPECT_EQ(with("\n  - {x: 1, y: 2, z: 3}\n  - {x: 1, y: a, z: 3}"),
              "level.unity:10: object 12: LightProbeGroup: m_SourcePositions: probe 1: y is not a "
              "number (\"a\")");
    EXPECT_EQ(with("\n  - {x: 1, y: .nan, z: 3}"),
              "level.unity:9: object 12: LightProbeGroup: m_SourcePositions: probe 0: y is not a "
              "number (\".nan\")");
    EXPECT_TRUE(with("\n  - {x: 1, y: nan, z: 3}").ends_with(": y is not finite (\"nan\")"));
    EXPECT_TRUE(with("\n  - {x: 1, y: 2}").ends_with(": z is missing"));
    EXPECT_TRUE(with("\n  - 7").ends_with(": probe 0: is not a mapping (\"7\")"));
    EXPECT_TRUE(with(" 7").ends_with(": m_SourcePositions: is not a list (\"7\")"));
    EXPECT_TRUE(with("\n  - {x: 1, y: 2, z: 1e400}")
                    .ends_with(": z is not a number that doubles can hold (\"1e400\")"));
}

TEST(UnityGroups, ErrorsNameMissingObjects) {
    const std::string group = "LightProbeGroup 12: ";
    EXPECT_EQ(unity_error(kHead + probes_text(12, 10, kTwoPositions)),
              "level.unity:3: " + group + "the object with ID 10 is not in the file");
    EXPECT_EQ(unity_error(kHead + "--- !u!1 &10\nGameObject:\n  m_Name: A\n" +
                          probes_text(12, 10, kTwoPositions)),
              "level.unity:6: " + group + "the transform of object 10 is not in the file");
    EXPECT_EQ(from_name(unity_error(kHead + text_of({.id = 10, .name = "A", .parent = 99}) +
                                    probes_text(12, 10, kTwoPositions)),
                        group),
              group + "transform 99 is not in the file");
}

TEST(UnityGroups, ParentsInACircleAreAnError) {
    const std::string text = kHead + text_of({.id = 10, .name = "A", .parent = 21}) +
                             text_of({.id = 20, .name = "B", .parent = 11}) +
                             probes_text(12, 10, kTwoPositions);
    EXPECT_EQ(from_name(unity_error(text), "LightProbeGroup 12"),
              "LightProbeGroup 12: line 10: transform 11 is its own parent or that of one of its "
              "parents");
    EXPECT_NE(unity_error(kHead + text_of({.id = 10, .name = "A", .parent = 11}) +
                          probes_text(12, 10, kTwoPositions))
                  .find("is its own parent"),
              std::string::npos);
}

TEST(UnityGroups, ErrorsNameWrongIdsAndHeaders) {
    EXPECT_EQ(unity_error(kHead + "--- !u!1 &99999999999999999999\nGameObject:\n"),
              "level.unity:3: the header of an object does not have &ID, an integer of 64 bits "
              "(\"--- !u!1 &99999999999999999999\")");
    EXPECT_EQ(unity_error(kHead + "--- !u!1 &9 strip\nGameObject:\n").substr(0, 58),
              "level.unity:3: the header of an object does not end after ");
    EXPECT_EQ(unity_error(kHead + "--- a: 1\n").substr(0, 71),
              "level.unity:3: the header of an object does not begin with --- !u!CLASS");
    EXPECT_EQ(unity_error(hall() + text_of({.id = 10, .name = "B"})),
              "level.unity:27: object 10: another object has the same ID");
    EXPECT_EQ(unity_error(kHead + "--- !u!4 &11\nTransform:\n  m_Father: {fileID: 1e3}\n"),
              "level.unity:5: object 11: Transform: m_Father: fileID is not an integer of 64 bits "
              "(\"1e3\")");
    EXPECT_EQ(
        unity_error(kHead +
                    "--- !u!4 &11\nTransform:\n  m_LocalRotation: {x: 0, y: 0, z: 0, w: 0}\n"),
        "level.unity:5: object 11: Transform: m_LocalRotation: the length of the quaternion is "
        "0");
}

TEST(UnityGroups, ErrorsNameAGroupThatIsThereThreeTimes) {
    const std::string group = probes_text(12, 10, kTwoPositions);
    EXPECT_EQ(from_name(unity_error(hall() + group + group), "LightProbeGroup 12"),
              "LightProbeGroup 12: another group is named \"Hall #12\"");
}

TEST(UnityGroups, PositionsThatBecomeInfiniteAreAnError) {
    EXPECT_EQ(
        from_name(unity_error(kHead + text_of({.id = 10, .name = "A", .scale = {1e300, 1, 1}}) +
                              probes_text(12, 10, "\n  - {x: 1e300, y: 0, z: 0}")),
                  "LightProbeGroup 12"),
        "LightProbeGroup 12: probe 0: its position in the world is not finite (-inf, 0, 0)");
}

TEST(UnityGroups, RefusesBinaryFiles) {
    EXPECT_EQ(unity_error("\1\2\3").substr(0, 72),
              "level.unity:1: is not a text file of Unity, which begins with %YAML; set");
    EXPECT_EQ(unity_error(kHead), "level.unity: has no LightProbeGroup");
}

TEST(UnityGroups, ReadDeepParents) {
    constexpr int64_t kLevels = 3000;
    std::string text = kHead;
    for (int64_t i = 1; i <= kLevels; ++i)
        text += text_of(
            {.id = 10 * i, .name = "n", .parent = i == 1 ? 0 : 10 * i - 9, .position = {1, 0, 0}});
    // The path of the deepest object is longer than the name of a group may be.
    EXPECT_NE(
        unity_error(text + probes_text(5, 10 * kLevels, kTwoPositions)).find("is longer than"),
        std::string::npos);
    const auto read = read_unity(text + probes_text(5, 10 * 1000, kTwoPositions));
    EXPECT_EQ(read.groups.at(0).positions.at(0), glm::dvec3(-1001, 2, 3));
}

}  // namespace
}  // namespace tetralight
