// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_animation.h>
#include <tetralight/bake/scene/detail/gltf_transform.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/bake/scene/gltf_document_builder.h"

namespace tetralight {
namespace {

using Document = detail::GltfDocument;
using Floats = std::vector<float>;

uint32_t width_of(const std::string& path) {
    if (path == "weights") return 1;
    return path == "rotation" ? 4 : 3;
}

/// A document of one node and an animation "walk" of one property of it.
Document animated(const std::string& path, const std::string& interpolation, const Floats& times,
                  const Floats& values) {
    Document document;
    document.nodes.resize(1);
    document.nodes[0].name = "box";
    const uint32_t input = add_floats(document, times, 1);
    const uint32_t output = add_floats(document, values, width_of(path));
    document.animations = {{"walk", {{0, path, input, output, interpolation}}}};
    return document;
}

detail::GltfNode node_at(Document document, double time) {
    const auto status = detail::pose_nodes(document, 0, time);
    EXPECT_TRUE(status) << error_text(status.error());
    return document.nodes[0];
}

TEST(GltfAnimation, LinearTranslationsLieOnALine) {
    const auto document = animated("translation", "LINEAR", {1, 3}, {0, 0, 0, 4, -2, 8});
    const auto node = node_at(document, 1.5);
    EXPECT_EQ(node.translation, glm::dvec3(1, -0.5, 2));
    EXPECT_EQ(node.parent_from_node[3], glm::dvec4(1, -0.5, 2, 1));
}

TEST(GltfAnimation, TheFirstAndTheLastValueApplyOutsideOfTheKeys) {
    const auto document = animated("scale", "LINEAR", {1, 3}, {1, 1, 1, 4, 5, 6});
    EXPECT_EQ(node_at(document, -7.0).scale, glm::dvec3(1));
    EXPECT_EQ(node_at(document, 1.0).scale, glm::dvec3(1));
    EXPECT_EQ(node_at(document, 3.0).scale, glm::dvec3(4, 5, 6));
    EXPECT_EQ(node_at(document, 1e9).scale, glm::dvec3(4, 5, 6));
}

TEST(GltfAnimation, StepsKeepTheValueOfTheKeyBefore) {
    const auto document = animated("translation", "STEP", {0, 1, 2}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
    EXPECT_EQ(node_at(document, 0.999).translation.x, 1.0);
    EXPECT_EQ(node_at(document, 1.0).translation.x, 2.0);
    EXPECT_EQ(node_at(document, 1.999).translation.x, 2.0);
    EXPECT_EQ(node_at(document, 2.0).translation.x, 3.0);
}

/// A rotation about +Z.
glm::dquat turn(double radians) {
    return {std::cos(radians / 2), 0, 0, std::sin(radians / 2)};
}

TEST(GltfAnimation, RotationsTakeTheShortestWayAtAConstantSpeed) {
    const auto z = static_cast<float>(std::sqrt(0.5));
    // A quarter of a turn, its quaternion negated, and longer than 1.
    const auto document =
        animated("rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, -3 * z, -3 * z});
    for (const double time : {0.25, 0.5, 0.8}) {
        const glm::dquat expected = turn(time * std::numbers::pi / 2);
        const glm::dquat actual = node_at(document, time).rotation;
        EXPECT_NEAR(std::abs(glm::dot(actual, expected)), 1.0, 1e-7) << time;
        EXPECT_NEAR(glm::length(actual), 1.0, 1e-12);
    }
}

TEST(GltfAnimation, RotationsAtAKeyAreNormalized) {
    const auto document = animated("rotation", "LINEAR", {0}, {0, 0, 0, 2});
    EXPECT_EQ(node_at(document, 0).rotation, glm::dquat(1, 0, 0, 0));
}

TEST(GltfAnimation, RotationsMayBeNormalizedShorts) {
    Document document = animated("rotation", "LINEAR", {0}, {0, 0, 0, 1});
    const uint32_t shorts = add_elements(document, std::vector<int16_t>{0, 32767, 0, 0}, 5122, 4);
    document.accessors[shorts].is_normalized = true;
    document.animations[0].channels[0].output = shorts;
    EXPECT_EQ(node_at(document, 0).rotation, glm::dquat(0, 0, 1, 0));
}

TEST(GltfAnimation, CubicSplinesFollowTheirPolynomial) {
    // x = t³ − 2t² + 3 from t = 1 to t = 3: its values, and its slope 3t² − 4t as tangents. The
    // tangents before the first key and behind the last one do not count.
    const auto x = [](double t) { return t * t * t - 2 * t * t + 3; };
    const auto slope = [](double t) { return static_cast<float>(3 * t * t - 4 * t); };
    const Floats values = {99,       0, 0, static_cast<float>(x(1)), 0, 0, slope(1), 0, 0,
                           slope(3), 0, 0, static_cast<float>(x(3)), 0, 0, 99,       0, 0};
    const auto document = animated("translation", "CUBICSPLINE", {1, 3}, values);
    for (const double time : {1.0, 1.25, 2.0, 2.9, 3.0}) {
        EXPECT_NEAR(node_at(document, time).translation.x, x(time), 1e-12) << time;
    }
}

TEST(GltfAnimation, CubicRotationsAreNormalized) {
    Floats values(24, 0.0f);
    values[4 + 3] = 1.0f;       // the first rotation: none
    values[3 * 4 + 4 + 2] = 1;  // the second: half a turn
    const auto document = animated("rotation", "CUBICSPLINE", {0, 1}, values);
    const glm::dquat middle = node_at(document, 0.5).rotation;
    EXPECT_NEAR(std::abs(glm::dot(middle, turn(std::numbers::pi / 2))), 1.0, 1e-12);
}

/// An animation of weights of a mesh with two morph targets.
Document animated_weights(const Floats& values, const std::string& interpolation = "LINEAR") {
    Document document = animated("weights", interpolation, {0, 1}, values);
    detail::GltfPrimitive primitive;
    primitive.targets.resize(2);
    document.meshes = {{"face", {primitive}, {}}};
    document.nodes[0].mesh = 0;
    return document;
}

TEST(GltfAnimation, WeightsAreListedKeyByKey) {
    const auto node = node_at(animated_weights({0, 1, 1, 3}), 0.5);
    EXPECT_EQ(node.weights, (std::vector<double>{0.5, 2}));
    EXPECT_EQ(node.parent_from_node, glm::dmat4(1.0));
}

TEST(GltfAnimation, CubicWeightsAreListedTangentByTangent) {
    const auto document = animated_weights({0, 0, 0, 2, 0, 0, 0, 0, 1, 4, 0, 0}, "CUBICSPLINE");
    EXPECT_EQ(node_at(document, 0.5).weights, (std::vector<double>{0.5, 3}));
}

TEST(GltfAnimation, OtherPropertiesOfTheNodeStay) {
    Document document = animated("translation", "LINEAR", {0}, {1, 2, 3});
    document.nodes[0].scale = glm::dvec3(2);
    document.nodes[0].rotation = turn(1.0);
    document.nodes[0].parent_from_node = detail::compose_transform({}, turn(1.0), glm::dvec3(2));
    const auto node = node_at(document, 0);
    EXPECT_EQ(node.parent_from_node,
              detail::compose_transform({1, 2, 3}, turn(1.0), glm::dvec3(2)));
}

TEST(GltfAnimation, UnknownTargetsAreLeftOut) {
    Document document = animated("translation", "LINEAR", {0}, {1, 2, 3});
    document.animations[0].channels[0].path = "pointer";
    EXPECT_EQ(node_at(document, 0).translation, glm::dvec3(0));
    document.animations[0].channels[0].path = "translation";
    document.animations[0].channels[0].node = kNoIndex;
    EXPECT_EQ(node_at(document, 0).translation, glm::dvec3(0));
}

TEST(GltfAnimation, IsFoundByNameOrIndex) {
    Document document;
    document.animations = {{"walk", {}}, {"run", {}}, {"0", {}}};
    EXPECT_EQ(*detail::find_animation(document, ""), 0u);
    EXPECT_EQ(*detail::find_animation(document, "run"), 1u);
    EXPECT_EQ(*detail::find_animation(document, "1"), 1u);
    EXPECT_EQ(*detail::find_animation(document, "0"), 2u);  // a name goes first
}

TEST(GltfAnimation, NamesTheAnimationsThatThereAre) {
    Document document;
    EXPECT_EQ(error_text(detail::find_animation(document, "").error()), "has no animations");
    document.animations = {{"walk", {}}, {"run", {}}};
    for (const char* text : {"jump", "2", "-1", "1x"}) {
        const auto found = detail::find_animation(document, text);
        ASSERT_FALSE(found);
        EXPECT_EQ(error_text(found.error()),
                  std::string("has no animation \"") + text + "\"; it has 0 \"walk\", 1 \"run\"");
        EXPECT_EQ(found.error().field, "animation");
    }
}

/// A change of an animation of two keys, and the error that it has to give.
struct AnimationRejection {
    const char* label;
    std::function<void(Document&, detail::GltfChannel&)> change;
    const char* error;
};

class GltfAnimationRejects : public testing::TestWithParam<AnimationRejection> {};

TEST_P(GltfAnimationRejects, WithPlaceAndValue) {
    Document document = animated("translation", "LINEAR", {0, 1}, {1, 2, 3, 4, 5, 6});
    GetParam().change(document, document.animations[0].channels[0]);
    const auto status = detail::pose_nodes(document, 0, 0.5);
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              std::string("animation 0 \"walk\": channel 0: ") + GetParam().error);
}

using Channel = detail::GltfChannel;

INSTANTIATE_TEST_SUITE_P(
    All, GltfAnimationRejects,
    testing::Values(
        AnimationRejection{"Interpolation",
                           [](Document&, Channel& c) { c.interpolation = "CUBIC"; },
                           "interpolation \"CUBIC\" is not \"LINEAR\", \"STEP\" or "
                           "\"CUBICSPLINE\""},
        AnimationRejection{"EqualTimes",
                           [](Document& d, Channel& c) {
                               c.input = add_floats(d, {0.5f, 0.5f}, 1);
                           },
                           "time 1 (0.5) is not after time 0 (0.5)"},
        AnimationRejection{"TimesOfAnotherType", [](Document&, Channel& c) { c.input = c.output; },
                           "times: accessor 1: is not of type SCALAR"},
        AnimationRejection{"ValuesOfAnotherType", [](Document&, Channel& c) { c.output = c.input; },
                           "values: accessor 0: is not of type VEC3"},
        AnimationRejection{"Count",
                           [](Document& d, Channel& c) {
                               c.input = add_floats(d, {0, 1, 2}, 1);
                           },
                           "3 times need 9 numbers of translation, there are 6"},
        AnimationRejection{"CubicCount",
                           [](Document&, Channel& c) { c.interpolation = "CUBICSPLINE"; },
                           "2 times need 18 numbers of translation, there are 6"},
        AnimationRejection{"WeightCount",
                           [](Document& d, Channel&) {
                               d = animated_weights({1, 2, 3, 4, 5});
                           },
                           "2 times need 4 numbers of weights, there are 5"},
        AnimationRejection{"NoTargets", [](Document&, Channel& c) { c.path = "weights"; },
                           "animates weights of node 0 \"box\", which has no morph targets"},
        AnimationRejection{"Matrix",
                           [](Document& d, Channel&) { d.nodes[0].parent_from_node[3].x = 7; },
                           "node 0 \"box\" has a matrix, which cannot be animated"},
        AnimationRejection{"ZeroRotation",
                           [](Document& d, Channel&) {
                               d = animated("rotation", "LINEAR", {0}, {0, 0, 0, 0});
                           },
                           "rotation is (0, 0, 0, 0)"}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

TEST(GltfAnimation, FieldsNameTheChannel) {
    Document document = animated("translation", "LINEAR", {1, 0}, {1, 2, 3, 4, 5, 6});
    EXPECT_EQ(detail::pose_nodes(document, 0, 0).error().field, "animations[0].channels[0]");
}

}  // namespace
}  // namespace tetralight
