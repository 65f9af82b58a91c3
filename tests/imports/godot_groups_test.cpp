// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/godot_groups.h>

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/base/str_cat.h>
#include "tests/imports/import_case.h"

namespace tetralight {
namespace {

const std::string kHead = "[gd_scene load_steps=2 format=3 uid=\"uid://c0\"]\n\n";
const std::string kRoot = "[node name=\"Level\" type=\"Node3D\"]\n";

/// A scene with these lines below the root.
std::string scene_with(const std::string& nodes) {
    return kHead + kRoot + nodes;
}

std::string at(double x, double y, double z) {
    return str_cat("transform = Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1, ", x, ", ", y, ", ", z,
                   ")\n");
}

/// The text of a transform, row by row.
std::string transform_text(const glm::dmat4& m) {
    std::string text = "transform = Transform3D(";
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) text += str_cat(m[column][row], ", ");
    return text + str_cat(m[3].x, ", ", m[3].y, ", ", m[3].z, ")\n");
}

std::string node(const std::string& name, const std::string& type, const std::string& parent) {
    return str_cat("[node name=\"", name, "\" type=\"", type, "\" parent=\"", parent, "\"]\n");
}

std::string probe(const std::string& name, const std::string& parent) {
    return node(name, "LightmapProbe", parent);
}

ImportedGroups read_godot(std::string_view text) {
    return sound_import("level.tscn", text);
}

std::string godot_error(std::string_view text) {
    return import_error("level.tscn", text);
}

std::vector<std::string> warnings_of(const ImportedGroups& imported) {
    std::vector<std::string> warnings;
    for (const std::string& warning : imported.warnings)
        warnings.push_back(from_name(warning, "level.tscn"));
    return warnings;
}

void expect_near(const glm::dvec3& value, const glm::dvec3& expected) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(value[axis], expected[axis], 1e-12);
}

TEST(GodotGroups, ProbesOfOneParentAreAGroup) {
    const auto read =
        read_godot(scene_with(node("Hall", "Node3D", ".") + probe("P", "Hall") + at(1, 2, 3) +
                              probe("P2", "Hall") + probe("Q", ".") + at(4, 5, 6)));
    ASSERT_EQ(read.groups.size(), 2u);
    EXPECT_EQ(read.groups[0].name, "Level/Hall");
    EXPECT_EQ(read.groups[0].positions, (std::vector<glm::dvec3>{{1, 2, 3}, {0, 0, 0}}));
    EXPECT_EQ(read.groups[1].name, "Level");
    EXPECT_EQ(read.groups[1].positions, (std::vector<glm::dvec3>{{4, 5, 6}}));
    EXPECT_TRUE(read.warnings.empty());
}

TEST(GodotGroups, TransformsOfAllParentsApply) {
    const glm::dmat4 root = glm::translate(glm::dmat4(1.0), {10, 0, -3});
    const glm::dmat4 hall = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    const glm::dmat4 row = glm::scale(glm::dmat4(1.0), {2, 3, -0.5});
    const auto read =
        read_godot(kHead + kRoot + transform_text(root) + node("Hall", "Node3D", ".") +
                   transform_text(hall) + node("Row", "Marker3D", "Hall") + transform_text(row) +
                   probe("P", "Hall/Row") + at(1, 2, 3));
    expect_near(read.groups.at(0).positions.at(0),
                glm::dvec3(root * hall * row * glm::dvec4(1, 2, 3, 1)));
    EXPECT_EQ(read.groups[0].name, "Level/Hall/Row");
}

TEST(GodotGroups, AQuarterTurnAboutYTakesXToMinusZ) {
    // The rows of the basis that turns x to -z and z to x.
    const std::string turned = "transform = Transform3D(0, 0, 1, 0, 1, 0, -1, 0, 0, 0, 0, 5)\n";
    const auto read = read_godot(
        scene_with(node("Hall", "Node3D", ".") + turned + probe("P", "Hall") + at(2, 1, 0)));
    EXPECT_EQ(read.groups.at(0).positions.at(0), glm::dvec3(0, 1, 3));
}

TEST(GodotGroups, ParentsThatAreNotSpatialEndTheChain) {
    const auto read = read_godot(kHead + kRoot + at(100, 0, 0) + node("Logic", "Node", ".") +
                                 node("Hall", "Node3D", "Logic") + at(1, 0, 0) +
                                 probe("P", "Logic/Hall") + at(0, 2, 0));
    EXPECT_EQ(read.groups.at(0).positions.at(0), glm::dvec3(1, 2, 0));
}

TEST(GodotGroups, TopLevelNodesStandInTheWorld) {
    const auto read = read_godot(kHead + kRoot + at(100, 0, 0) + probe("P", ".") +
                                 "top_level = true\n" + at(0, 2, 0) + node("H", "Node3D", ".") +
                                 at(0, 0, 7) + "top_level = true\n" + probe("Q", "H"));
    ASSERT_EQ(read.groups.size(), 2u);
    EXPECT_EQ(read.groups[0].name, "Level/P");
    EXPECT_EQ(read.groups[0].positions.at(0), glm::dvec3(0, 2, 0));
    EXPECT_EQ(read.groups[1].positions.at(0), glm::dvec3(0, 0, 7));
}

TEST(GodotGroups, OtherNodesAndPropertiesAreSkipped) {
    const auto read = read_godot(
        "[gd_scene format=4]\n[ext_resource type=\"Texture2D\" path=\"res://a.png\" id=\"1_a\"]\n"
        "[sub_resource type=\"BoxMesh\" id=\"B\"]\nsize = Vector3(1, 2, 3)\n"
        "transform = Transform3D(wrong)\n" +
        kRoot + "metadata/_notes = {\n\"text\": \"[node name=\\\"X\\\"]\"\n}\n" +
        node("Mesh", "MeshInstance3D", ".") + "mesh = SubResource(\"B\")\n" + probe("P", ".") +
        "[connection signal=\"a\" from=\".\" to=\".\" method=\"b\"]\n[editable path=\"Lamp\"]\n");
    EXPECT_EQ(read.groups.at(0).positions.size(), 1u);
}

const std::string kLamp =
    "[ext_resource type=\"PackedScene\" uid=\"uid://d\" path=\"res://lamp.tscn\" id=\"1_lamp\"]\n";

TEST(GodotGroups, InstancedScenesAreNotFollowed) {
    const auto read =
        read_godot(kHead + kLamp + kRoot +
                   "[node name=\"Lamp\" parent=\".\" instance=ExtResource(\"1_lamp\")]\n" +
                   at(5, 0, 0) + probe("P", "Lamp") + at(1, 0, 0));
    EXPECT_EQ(read.groups.at(0).positions.at(0), glm::dvec3(6, 0, 0));
    EXPECT_EQ(warnings_of(read),
              (std::vector<std::string>{
                  "level.tscn: 1 instanced scene is not followed, and its probes are not read "
                  "(\"res://lamp.tscn\"); in Godot, Make Local puts their nodes into this file"}));
}

TEST(GodotGroups, ModelsHaveNoProbesToFollow) {
    const auto read = read_godot(
        kHead + "[ext_resource type=\"PackedScene\" path=\"res://house.glb\" id=\"1_h\"]\n" +
        kRoot + "[node name=\"House\" parent=\".\" instance=ExtResource(\"1_h\")]\n" +
        probe("P", "."));
    EXPECT_TRUE(read.warnings.empty());
}

TEST(GodotGroups, ProbesBelowUnplacedNodesOfInstancesAreLeftOut) {
    const auto read = read_godot(
        kHead + kLamp + kRoot +
        "[node name=\"Lamp\" parent=\".\" instance=ExtResource(\"1_lamp\")]\n" + at(5, 0, 0) +
        "[node name=\"Bulb\" parent=\"Lamp\" index=\"0\"]\n" + at(0, 1, 0) +
        "[node name=\"Foot\" parent=\"Lamp\" index=\"1\"]\n" + probe("P", "Lamp/Bulb") +
        probe("Q", "Lamp/Foot") + probe("R", "Lamp/Arm/Hand") + probe("S", "Lamp/Arm/Hand"));
    ASSERT_EQ(read.groups.size(), 1u);
    EXPECT_EQ(read.groups[0].name, "Level/Lamp/Bulb");
    EXPECT_EQ(read.groups[0].positions, (std::vector<glm::dvec3>{{5, 1, 0}}));
    EXPECT_EQ(warnings_of(read).at(1),
              "level.tscn: 3 probes are left out, because their parents belong to instanced scenes "
              "and have no transform in this file (the first: \"Level/Lamp/Foot/Q\")");
}

TEST(GodotGroups, WarnsOfInstancesWithoutATransform) {
    const auto read =
        read_godot(kHead + kLamp + "[node name=\"Level\" instance=ExtResource(\"1_lamp\")]\n" +
                   probe("P", ".") + at(1, 0, 0));
    EXPECT_EQ(read.groups.at(0).positions.at(0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(warnings_of(read).at(1),
              "level.tscn: instance \"Level\" has no transform in this file: 1 probe below it is "
              "placed as if the root of its scene had none either");
}

TEST(GodotGroups, ErrorsNameLineAndNode) {
    EXPECT_EQ(godot_error(scene_with(probe("P", ".")) + "transform = Vector3(1, 2, 3)\n"),
              "level.tscn:5: node \"P\": transform is not a Transform3D (\"Vector3(1, 2, 3)\")");
    EXPECT_EQ(godot_error(scene_with(probe("P", "Hall"))),
              "level.tscn:4: node \"P\": its parent \"Hall\" is not before it in the file");
    EXPECT_EQ(godot_error(scene_with(probe("P", ".") + probe("P", "."))),
              "level.tscn:5: node \"P\": another node has the same name and parent");
    EXPECT_EQ(godot_error(scene_with(kRoot)),
              "level.tscn:4: node \"Level\": has no parent, as the root before it");
    EXPECT_EQ(godot_error(kHead + probe("P", ".")),
              "level.tscn:3: node \"P\": its parent \".\" is not before it in the file");
    EXPECT_EQ(godot_error(scene_with("[node name=P parent=\".\"]\n")),
              "level.tscn:4: node: name is not a string (\"P\")");
    EXPECT_EQ(godot_error(scene_with("[node type=\"LightmapProbe\" parent=\".\"]\n")),
              "level.tscn:4: node has no name");
    const std::string huge = "transform = Transform3D(1e200, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0)\n";
    EXPECT_EQ(godot_error(
                  scene_with(node("H", "Node3D", ".") + huge + probe("P", "H") + at(1e200, 0, 0))),
              "level.tscn:6: node \"P\": its position in the world is not finite (inf, 0, 0)");
}

TEST(GodotGroups, RefusesOtherFiles) {
    EXPECT_EQ(godot_error("[gd_resource type=\"Mesh\" format=3]\n"),
              "level.tscn:1: is not a text scene of Godot, which begins with [gd_scene]");
    EXPECT_EQ(godot_error("[gd_scene load_steps=2 format=2]\n"),
              "level.tscn:1: format is \"2\"; scenes of Godot 4 have 3 or 4");
    EXPECT_EQ(godot_error(""), "level.tscn: has no LightmapProbe nodes that can be placed");
    EXPECT_EQ(godot_error(scene_with("")),
              "level.tscn: has no LightmapProbe nodes that can be placed");
    EXPECT_EQ(import_text("level.tscn", scene_with("")).error().code, ErrorCode::NotFound);
}

TEST(GodotGroups, RefuseLongNames) {
    // The root's name is a part of the name of every group.
    const std::string name(5000, 'r');
    EXPECT_EQ(
        godot_error(kHead + "[node name=\"" + name + "\" type=\"Node3D\"]\n" + probe("P", "."))
            .substr(0, 58),
        "level.tscn:4: node \"P\": the name of the group, \"rrrrrrrrrr");
}

TEST(GodotGroups, ReadDeepTrees) {
    constexpr int kLevels = 1000;
    std::string text = kHead + kRoot;
    std::string parent = ".";
    for (int i = 0; i < kLevels; ++i) {
        text += node("n", "Node3D", parent) + at(0.5, 0, 0);
        parent = parent == "." ? "n" : parent + "/n";
    }
    const auto read = read_godot(text + probe("P", parent));
    EXPECT_EQ(read.groups.at(0).positions.at(0), glm::dvec3(kLevels * 0.5, 0, 0));
}

}  // namespace
}  // namespace tetralight
