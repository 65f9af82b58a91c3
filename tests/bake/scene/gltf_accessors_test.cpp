// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <limits>

#include "tests/bake/scene/gltf_builder.h"

namespace tetralight {
namespace {

constexpr int kByte = 5120;
constexpr int kShort = 5122;
constexpr int kUnsignedShort = 5123;

/// Positions of the scene's first mesh.
std::vector<glm::vec3> positions_of(const GltfBuilder& gltf) {
    const auto scene = gltf.read();
    EXPECT_TRUE(scene) << error_text(scene.error());
    return scene ? scene->meshes[0].positions : std::vector<glm::vec3>();
}

/// One triangle of quantized positions: four components a vertex, of which three are read.
template <class T>
GltfBuilder quantized_triangle(const std::vector<T>& values, int component_type) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const size_t view = gltf.add_view(values);
    gltf.json["bufferViews"][view]["byteStride"] = 4 * sizeof(T);
    gltf.json["accessors"][0] = {
        {"bufferView", view}, {"componentType", component_type}, {"count", 3}, {"type", "VEC3"}};
    return gltf;
}

TEST(GltfAccessors, QuantizedPositionsKeepTheirIntegers) {
    const auto gltf =
        quantized_triangle<int16_t>({0, 0, 0, 0, 100, -5, 0, 0, 3, 32767, -32768, 0}, kShort);
    EXPECT_EQ(positions_of(gltf),
              (std::vector<glm::vec3>{{0, 0, 0}, {100, -5, 0}, {3, 32767, -32768}}));
}

TEST(GltfAccessors, NormalizedSignedBytesReachOneAndStopAtMinusOne) {
    auto gltf = quantized_triangle<int8_t>({127, -127, -128, 0, 0, 0, 0, 0, 0, 9, 0, 0}, kByte);
    gltf.json["accessors"][0]["normalized"] = true;
    EXPECT_EQ(positions_of(gltf)[0], glm::vec3(1, -1, -1));
}

TEST(GltfAccessors, NormalizedUnsignedShorts) {
    auto gltf =
        quantized_triangle<uint16_t>({65535, 0, 13107, 0, 0, 0, 0, 0, 0, 9, 0, 0}, kUnsignedShort);
    gltf.json["accessors"][0]["normalized"] = true;
    EXPECT_EQ(positions_of(gltf)[0], glm::vec3(1.0f, 0.0f, 13107.0f / 65535.0f));
}

TEST(GltfAccessors, ReadsInterleavedViews) {
    GltfBuilder gltf;
    gltf.add_triangle();
    const size_t view = gltf.add_view<float>({9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0});
    gltf.json["bufferViews"][view]["byteStride"] = 16;
    gltf.json["accessors"][0]["bufferView"] = view;
    gltf.json["accessors"][0]["byteOffset"] = 4;
    EXPECT_EQ(positions_of(gltf), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

/// A triangle at zero, whose corners 0 and 2 a sparse accessor replaces.
GltfBuilder sparse_triangle() {
    GltfBuilder gltf;
    gltf.add_triangle();
    const size_t indices = gltf.add_view<uint16_t>({0, 2});
    const size_t values = gltf.add_view<float>({1, 2, 3, 4, 5, 6});
    gltf.json["accessors"][0].erase("bufferView");
    gltf.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", values}}}};
    return gltf;
}

TEST(GltfAccessors, SparseReplacesZeros) {
    EXPECT_EQ(positions_of(sparse_triangle()),
              (std::vector<glm::vec3>{{1, 2, 3}, {0, 0, 0}, {4, 5, 6}}));
}

TEST(GltfAccessors, SparseReplacesPartOfAView) {
    auto gltf = sparse_triangle();
    gltf.json["accessors"][0]["bufferView"] = 0;
    EXPECT_EQ(positions_of(gltf), (std::vector<glm::vec3>{{1, 2, 3}, {1, 0, 0}, {4, 5, 6}}));
}

/// What changes in the accessor of a good triangle, and the error it has to give.
struct AccessorRejection {
    const char* label;
    const char* key;
    nlohmann::json value;
    const char* error;
};

class GltfAccessorsReject : public testing::TestWithParam<AccessorRejection> {};

TEST_P(GltfAccessorsReject, WithPlaceAndValue) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.json["accessors"][0][GetParam().key] = GetParam().value;
    EXPECT_EQ(gltf.error(), std::string("scene.glb: mesh 0: primitive 0: POSITION: accessor 0: ") +
                                GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfAccessorsReject,
    testing::Values(
        AccessorRejection{"Count", "count", 4,
                          "bytes 0 to 48 are outside of buffer view 0 (36 bytes)"},
        AccessorRejection{"LargestCount", "count", 4294967295u,
                          "bytes 0 to 51539607540 are outside of buffer view 0 (36 bytes)"},
        AccessorRejection{"NoElements", "count", 0, "has no elements"},
        AccessorRejection{"Offset", "byteOffset", 4,
                          "bytes 4 to 40 are outside of buffer view 0 (36 bytes)"},
        AccessorRejection{"LargestOffset", "byteOffset", 4294967295u,
                          "bytes 4294967295 to 4294967331 are outside of buffer view 0 (36 bytes)"},
        AccessorRejection{"Type", "type", "VEC2", "is not of type VEC3"},
        AccessorRejection{"Matrix", "type", "MAT2", "is not of type VEC3"},
        AccessorRejection{"UnsignedInt", "componentType", 5125,
                          "component type 5125 is not supported here"},
        AccessorRejection{"Double", "componentType", 5130,
                          "component type 5130 is not supported here"}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

TEST(GltfAccessors, RejectsPositionsThatAreNotFinite) {
    GltfBuilder gltf;
    gltf.add_mesh({0, 0, 0, 1, std::numeric_limits<float>::quiet_NaN(), 0, 0, 1, 0});
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0: primitive 0: POSITION: accessor 0: element 1 is not finite "
              "(component 1 is nan)");
}

TEST(GltfAccessors, RejectsAStrideBelowTheElementSize) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.json["bufferViews"][0]["byteStride"] = 8;
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0: primitive 0: POSITION: accessor 0: byteStride 8 of buffer view 0 "
              "is less than an element's 12 bytes");
}

TEST(GltfAccessors, RejectsMillionsOfZerosFromNothing) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.json["accessors"][0].erase("bufferView");
    gltf.json["accessors"][0]["count"] = 4000000000u;
    EXPECT_EQ(gltf.error(),
              "scene.glb: mesh 0: primitive 0: POSITION: accessor 0: 4000000000 elements without a "
              "buffer view are more than 1048576");
}

TEST(GltfAccessors, RejectsIndicesOfAFloatType) {
    GltfBuilder gltf;
    gltf.add_triangle();
    gltf.primitive(0)["indices"] = gltf.add_floats({0, 1, 2}, "SCALAR");
    EXPECT_EQ(
        gltf.error(),
        "scene.glb: mesh 0: primitive 0: accessor 1: component type 5126 is not supported for "
        "indices");
}

/// What changes in a good sparse accessor, by JSON pointer.
struct SparseRejection {
    const char* label;
    const char* pointer;
    nlohmann::json value;
};

class GltfSparseReject : public testing::TestWithParam<SparseRejection> {};

TEST_P(GltfSparseReject, WithPlace) {
    auto gltf = sparse_triangle();
    const nlohmann::json::json_pointer pointer(std::string("/accessors/0/sparse") +
                                               GetParam().pointer);
    gltf.json[pointer] = GetParam().value;
    EXPECT_NE(gltf.error().find("accessor 0: sparse"), std::string::npos) << gltf.error();
}

INSTANTIATE_TEST_SUITE_P(
    All, GltfSparseReject,
    testing::Values(SparseRejection{"NoCount", "/count", 0},
                    SparseRejection{"CountAboveElements", "/count", 4},
                    SparseRejection{"CountAboveView", "/count", 3},
                    SparseRejection{"LargestCount", "/count", 4294967295u},
                    SparseRejection{"IndexType", "/indices/componentType", 5126},
                    SparseRejection{"IndexView", "/indices/bufferView", 99},
                    SparseRejection{"IndexViewNegative", "/indices/bufferView", -1},
                    SparseRejection{"IndexOffset", "/indices/byteOffset", 3},
                    SparseRejection{"LargestIndexOffset", "/indices/byteOffset", 4294967295u},
                    SparseRejection{"ValueView", "/values/bufferView", 99},
                    SparseRejection{"ValueOffset", "/values/byteOffset", 1}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

TEST(GltfAccessors, RejectsASparseIndexOutOfRange) {
    auto gltf = sparse_triangle();
    gltf.json["accessors"][0]["sparse"]["indices"]["bufferView"] = gltf.add_view<uint16_t>({0, 3});
    EXPECT_EQ(
        gltf.error(),
        "scene.glb: mesh 0: primitive 0: POSITION: accessor 0: sparse index 3 is out of range "
        "(3 elements)");
}

}  // namespace
}  // namespace tetralight
