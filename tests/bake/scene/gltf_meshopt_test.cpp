// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_meshopt.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

namespace tetralight {
namespace {

using Bytes = std::vector<std::byte>;

const std::vector<glm::vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.25f}};

/// For the encoders, which have their own type of bytes.
unsigned char* first_of(Bytes& bytes) {
    return reinterpret_cast<unsigned char*>(bytes.data());
}

Bytes encode_vertices(const void* vertices, size_t count, size_t stride) {
    Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(
        meshopt_encodeVertexBuffer(first_of(bytes), bytes.size(), vertices, count, stride));
    return bytes;
}

Bytes encode_triangles(const std::vector<uint32_t>& indices) {
    meshopt_encodeIndexVersion(1);
    Bytes bytes(meshopt_encodeIndexBufferBound(indices.size(), 100));
    bytes.resize(
        meshopt_encodeIndexBuffer(first_of(bytes), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

Bytes encode_sequence(const std::vector<uint32_t>& indices) {
    meshopt_encodeIndexVersion(1);
    Bytes bytes(meshopt_encodeIndexSequenceBound(indices.size(), 100));
    bytes.resize(
        meshopt_encodeIndexSequence(first_of(bytes), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

/// A document of one compressed buffer view, behind three other bytes of its buffer. Buffer 1 is
/// the fallback, which has no bytes.
detail::GltfDocument compressed(const Bytes& bytes, uint64_t count, uint64_t stride,
                                const std::string& mode, const std::string& filter = "NONE") {
    detail::GltfDocument document;
    document.buffers = {Bytes(3, std::byte{7}), {}};
    document.buffers[0].insert(document.buffers[0].end(), bytes.begin(), bytes.end());
    document.buffer_views = {{1, 0, count * stride, 0, std::nullopt}};
    document.buffer_views[0].meshopt =
        detail::GltfMeshopt{0, 3, bytes.size(), stride, count, mode, filter};
    return document;
}

detail::GltfDocument compressed_corners() {
    return compressed(encode_vertices(kCorners.data(), 4, 12), 4, 12, "ATTRIBUTES");
}

/// The decoded bytes of buffer view 0, as elements of type T.
template <class T>
std::vector<T> decoded(detail::GltfDocument document) {
    const auto status = detail::decode_meshopt(document);
    EXPECT_TRUE(status) << error_text(status.error());
    if (!status) return {};
    const detail::GltfBufferView& view = document.buffer_views[0];
    EXPECT_FALSE(view.meshopt);
    EXPECT_EQ(view.byte_offset, 0u);
    const Bytes& buffer = document.buffers[view.buffer];
    EXPECT_EQ(buffer.size(), view.byte_length);
    std::vector<T> elements(buffer.size() / sizeof(T));
    std::memcpy(elements.data(), buffer.data(), elements.size() * sizeof(T));
    return elements;
}

TEST(GltfMeshopt, AttributesComeBackAsTheyWere) {
    EXPECT_EQ(decoded<glm::vec3>(compressed_corners()), kCorners);
}

TEST(GltfMeshopt, ManyAttributesComeBackAsTheyWere) {
    std::vector<uint32_t> values(5000);
    for (uint32_t i = 0; i < values.size(); ++i) values[i] = i * 2654435761u;
    const Bytes bytes = encode_vertices(values.data(), 1250, 16);
    EXPECT_EQ(decoded<uint32_t>(compressed(bytes, 1250, 16, "ATTRIBUTES")), values);
}

TEST(GltfMeshopt, EqualElementsMayShrinkTo1Of64) {
    const std::vector<uint32_t> zeros(1 << 20, 0);
    const Bytes bytes = encode_vertices(zeros.data(), zeros.size() / 4, 16);
    EXPECT_LT(bytes.size(), zeros.size() * 4 / 60);
    EXPECT_EQ(decoded<uint32_t>(compressed(bytes, zeros.size() / 4, 16, "ATTRIBUTES")), zeros);
}

/// Turns each triangle so that its least index is first: the encoding may turn triangles.
template <class T>
std::vector<uint32_t> turned(const std::vector<T>& indices) {
    std::vector<uint32_t> result(indices.begin(), indices.end());
    for (auto corner = result.begin(); corner != result.end(); corner += 3) {
        std::rotate(corner, std::min_element(corner, corner + 3), corner + 3);
    }
    return result;
}

TEST(GltfMeshopt, TrianglesComeBackInBothSizes) {
    const std::vector<uint32_t> indices = {0, 1, 2, 2, 1, 3, 7, 0, 3, 40, 41, 42};
    const Bytes bytes = encode_triangles(indices);
    EXPECT_EQ(turned(decoded<uint16_t>(compressed(bytes, 12, 2, "TRIANGLES"))), turned(indices));
    EXPECT_EQ(turned(decoded<uint32_t>(compressed(bytes, 12, 4, "TRIANGLES"))), turned(indices));
}

TEST(GltfMeshopt, IndicesKeepTheirOrder) {
    const std::vector<uint32_t> indices = {5, 0, 9, 9, 1, 70000, 3};
    const Bytes bytes = encode_sequence(indices);
    EXPECT_EQ(decoded<uint32_t>(compressed(bytes, 7, 4, "INDICES")), indices);
}

TEST(GltfMeshopt, OctahedralNormalsAreUnitVectors) {
    const std::vector<glm::vec4> normals = {
        {0, 0, 1, 0}, {0.6f, -0.8f, 0, 0}, {-0.48f, 0.6f, -0.64f, 1}};
    std::vector<int16_t> filtered(12);
    meshopt_encodeFilterOct(filtered.data(), 3, 8, 16, &normals[0].x);
    const auto values = decoded<int16_t>(
        compressed(encode_vertices(filtered.data(), 3, 8), 3, 8, "ATTRIBUTES", "OCTAHEDRAL"));
    ASSERT_EQ(values.size(), 12u);
    for (size_t i = 0; i < 12; ++i) {
        const auto axis = static_cast<int>(i % 4);
        EXPECT_NEAR(values[i] / 32767.0f, normals[i / 4][axis], 1e-4f);
    }
}

TEST(GltfMeshopt, QuaternionsAreTheSameRotations) {
    const std::vector<glm::vec4> rotations = {{0, 0, 0, 1}, {0.5f, -0.5f, 0.5f, 0.5f}};
    std::vector<int16_t> filtered(8);
    meshopt_encodeFilterQuat(filtered.data(), 2, 8, 16, &rotations[0].x);
    const auto values = decoded<int16_t>(
        compressed(encode_vertices(filtered.data(), 2, 8), 2, 8, "ATTRIBUTES", "QUATERNION"));
    ASSERT_EQ(values.size(), 8u);
    for (size_t i = 0; i < 2; ++i) {
        const glm::vec4 q(values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]);
        EXPECT_NEAR(std::abs(glm::dot(q / 32767.0f, rotations[i])), 1.0f, 1e-4f);
    }
}

TEST(GltfMeshopt, ExponentialFloatsKeepTheirMantissa) {
    std::vector<uint32_t> filtered(12);
    meshopt_encodeFilterExp(filtered.data(), 4, 12, 20, &kCorners[0].x);
    const auto values = decoded<glm::vec3>(
        compressed(encode_vertices(filtered.data(), 4, 12), 4, 12, "ATTRIBUTES", "EXPONENTIAL"));
    ASSERT_EQ(values.size(), 4u);
    for (size_t i = 0; i < 4; ++i) EXPECT_LT(glm::distance(values[i], kCorners[i]), 1e-5f);
}

TEST(GltfMeshopt, PlainViewsStay) {
    detail::GltfDocument document = compressed_corners();
    document.buffer_views.push_back({0, 1, 2, 0, std::nullopt});
    ASSERT_TRUE(detail::decode_meshopt(document));
    EXPECT_EQ(document.buffer_views[1].buffer, 0u);
    EXPECT_EQ(document.buffer_views[1].byte_offset, 1u);
}

TEST(GltfMeshopt, DecodedBytesAreSummedWithoutOverflow) {
    detail::GltfDocument document = compressed_corners();
    document.buffer_views.push_back(document.buffer_views[0]);
    document.buffer_views.push_back({0, 0, 3, 0, std::nullopt});
    EXPECT_EQ(detail::meshopt_decoded_bytes(document), 2u * 48u);
    constexpr uint64_t kLargest = 0xffffffff;
    document.buffer_views[0].meshopt->count = kLargest;
    document.buffer_views[0].meshopt->byte_stride = kLargest;
    document.buffer_views[1].meshopt = document.buffer_views[0].meshopt;
    EXPECT_EQ(detail::meshopt_decoded_bytes(document), std::numeric_limits<uint64_t>::max());
}

TEST(GltfMeshopt, EveryTruncationIsAnError) {
    const detail::GltfDocument whole = compressed_corners();
    const uint64_t length = whole.buffer_views[0].meshopt->byte_length;
    for (uint64_t cut = 0; cut < length; ++cut) {
        detail::GltfDocument document = whole;
        document.buffers[0].resize(3 + cut);
        document.buffer_views[0].meshopt->byte_length = cut;
        EXPECT_FALSE(detail::decode_meshopt(document)) << cut;
    }
}

/// A change of a document, and the error that it has to give.
struct MeshoptRejection {
    const char* label;
    std::function<void(detail::GltfDocument&, detail::GltfMeshopt&)> change;
    const char* member;
    const char* error;
};

class GltfMeshoptRejects : public testing::TestWithParam<MeshoptRejection> {};

TEST_P(GltfMeshoptRejects, WithPlaceAndValue) {
    detail::GltfDocument document = compressed_corners();
    GetParam().change(document, *document.buffer_views[0].meshopt);
    const auto status = detail::decode_meshopt(document);
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              std::string("buffer view 0: EXT_meshopt_compression: ") + GetParam().error);
    EXPECT_EQ(
        status.error().field,
        std::string("bufferViews[0].extensions.EXT_meshopt_compression.") + GetParam().member);
}

using Document = detail::GltfDocument;
using Meshopt = detail::GltfMeshopt;

INSTANTIATE_TEST_SUITE_P(
    All, GltfMeshoptRejects,
    testing::Values(
        MeshoptRejection{"Mode", [](Document&, Meshopt& m) { m.mode = "POINTS"; }, "mode",
                         "mode \"POINTS\" is not \"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\""},
        MeshoptRejection{"OddStride", [](Document&, Meshopt& m) { m.byte_stride = 6; },
                         "byteStride", "byteStride 6 is not a multiple of 4 up to 256"},
        MeshoptRejection{"GreatStride", [](Document&, Meshopt& m) { m.byte_stride = 260; },
                         "byteStride", "byteStride 260 is not a multiple of 4 up to 256"},
        MeshoptRejection{"NoStride", [](Document&, Meshopt& m) { m.byte_stride = 0; }, "byteStride",
                         "byteStride 0 is not a multiple of 4 up to 256"},
        MeshoptRejection{"IndexStride", [](Document&, Meshopt& m) { m.mode = "INDICES"; },
                         "byteStride", "byteStride 12 is not 2 or 4, as mode \"INDICES\" needs"},
        MeshoptRejection{"TriangleCount",
                         [](Document&, Meshopt& m) {
                             m.mode = "TRIANGLES";
                             m.byte_stride = 4;
                         },
                         "count", "count 4 is not a multiple of 3, as mode \"TRIANGLES\" needs"},
        MeshoptRejection{"NoElements", [](Document&, Meshopt& m) { m.count = 0; }, "count",
                         "count is 0"},
        MeshoptRejection{"Filter", [](Document&, Meshopt& m) { m.filter = "COLOR"; }, "filter",
                         "filter \"COLOR\" is not \"NONE\", \"OCTAHEDRAL\", \"QUATERNION\" or "
                         "\"EXPONENTIAL\""},
        MeshoptRejection{"FilterOfIndices",
                         [](Document&, Meshopt& m) {
                             m.mode = "INDICES";
                             m.byte_stride = 4;
                             m.filter = "EXPONENTIAL";
                         },
                         "filter", "filter \"EXPONENTIAL\" does not go with mode \"INDICES\""},
        MeshoptRejection{"OctahedralStride", [](Document&, Meshopt& m) { m.filter = "OCTAHEDRAL"; },
                         "byteStride",
                         "byteStride 12 is not 4 or 8, as filter \"OCTAHEDRAL\" needs"},
        MeshoptRejection{"QuaternionStride", [](Document&, Meshopt& m) { m.filter = "QUATERNION"; },
                         "byteStride", "byteStride 12 is not 8, as filter \"QUATERNION\" needs"},
        MeshoptRejection{"StrideOfTheView",
                         [](Document& d, Meshopt&) { d.buffer_views[0].byte_stride = 16; },
                         "byteStride", "byteStride 12 is not the buffer view's 16"},
        MeshoptRejection{"SizeOfTheView", [](Document&, Meshopt& m) { m.count = 5; }, "count",
                         "5 elements of 12 bytes are not the buffer view's 48 bytes"},
        MeshoptRejection{"HugeCount",
                         [](Document& d, Meshopt& m) {
                             m.count = 1 << 30;
                             m.byte_length = 50;
                             d.buffer_views[0].byte_length = 12ull << 30;
                         },
                         "byteLength", "50 bytes are too few for 12884901888 decoded bytes"},
        MeshoptRejection{"Bytes",
                         [](Document&, Meshopt& m) {
                             m.buffer = 1;
                             m.byte_offset = 4000000000;
                             m.byte_length = 90;
                         },
                         "byteLength",
                         "bytes 4000000000 to 4000000090 are outside of buffer 1 (0 bytes)"},
        MeshoptRejection{"BytesOfAnotherMode",
                         [](Document& d, Meshopt&) { d.buffers[0][3] = std::byte{0xe1}; }, "mode",
                         "the bytes are not of mode \"ATTRIBUTES\""},
        MeshoptRejection{"Version",
                         [](Document& d, Meshopt&) { d.buffers[0][3] = std::byte{0xa1}; }, "mode",
                         "the bytes are of version 1 of the encoding, versions up to 0 are read; "
                         "export the file again with version 0 (gltfpack -c)"},
        MeshoptRejection{"Length", [](Document&, Meshopt& m) { m.byte_length = 40; }, "byteLength",
                         "40 bytes do not decode to 4 elements of 12 bytes"}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

TEST(GltfMeshopt, ALaterVersionIsUnsupported) {
    detail::GltfDocument document = compressed_corners();
    document.buffers[0][3] = std::byte{0xa1};
    EXPECT_EQ(detail::decode_meshopt(document).error().code, ErrorCode::Unsupported);
}

}  // namespace
}  // namespace tetralight
