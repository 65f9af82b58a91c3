// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/bake/scene/detail/gltf_draco.h>
#include <tetralight/base/error_text.h>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

namespace tetralight {
namespace {

using Triangle = std::array<glm::vec3, 3>;
using Document = detail::GltfDocument;

enum class Method : uint8_t { Sequential, Edgebreaker };

/// Triangles of a bumpy sheet of n × n squares.
std::vector<Triangle> sheet(int n) {
    const auto corner = [](int x, int y) {
        const auto u = static_cast<float>(x), v = static_cast<float>(y);
        return glm::vec3(u, v, std::sin(u + 2.0f * v));
    };
    std::vector<Triangle> triangles;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            triangles.push_back({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)});
            triangles.push_back({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)});
        }
    }
    return triangles;
}

struct Compressed {
    std::vector<std::byte> bytes;
    uint64_t point_count = 0;
};

/// Attribute 0: the corners. Attribute 1: bytes of RGBA, of which red is the corner's x.
std::unique_ptr<draco::Mesh> draco_mesh(const std::vector<Triangle>& triangles) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(triangles.size()));
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color =
        builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(i), &a, &b, &c);
        const auto red = [](const glm::vec3& corner) {
            return std::array<uint8_t, 4>{static_cast<uint8_t>(corner.x), 0, 0, 255};
        };
        builder.SetAttributeValuesForFace(color, draco::FaceIndex(i), red(a).data(), red(b).data(),
                                          red(c).data());
    }
    return builder.Finalize();
}

Compressed compress(const std::vector<Triangle>& triangles, Method method) {
    const auto mesh = draco_mesh(triangles);
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method == Method::Sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                           : draco::MESH_EDGEBREAKER_ENCODING);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    const auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
    return {{bytes.begin(), bytes.end()}, mesh->num_points()};
}

/// A mesh whose accessors 0 to 2 (positions, colours, indices) have no data but Draco's.
Document document_of(const Compressed& compressed, uint64_t triangle_count) {
    Document document;
    document.buffers = {compressed.bytes};
    document.buffer_views = {{0, 0, compressed.bytes.size(), 0, std::nullopt}};
    document.accessors.resize(3);
    document.accessors[0] = {kNoIndex, 0, 5126, 3, false, compressed.point_count, std::nullopt};
    document.accessors[1] = {kNoIndex, 0, 5121, 4, true, compressed.point_count, std::nullopt};
    document.accessors[2] = {kNoIndex, 0, 5123, 1, false, triangle_count * 3, std::nullopt};
    detail::GltfPrimitive primitive;
    primitive.attributes = {{"POSITION", 0}, {"COLOR_0", 1}};
    primitive.indices = 2;
    primitive.draco = detail::GltfDraco{0, {{"POSITION", 0}, {"COLOR_0", 1}}};
    document.meshes = {{"sheet", {primitive}, {}}};
    return document;
}

Document small_document() {
    return document_of(compress(sheet(2), Method::Edgebreaker), 8);
}

bool is_less(const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Triangles with their least corner first, in ascending order.
std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end(), is_less), t.end());
    }
    std::sort(triangles.begin(), triangles.end(), [](const Triangle& a, const Triangle& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_less);
    });
    return triangles;
}

/// The triangles of a primitive. Checks that each vertex has the colour of its x.
std::vector<Triangle> triangles_of(const Document& document, size_t primitive_index = 0) {
    const detail::GltfPrimitive& primitive = document.meshes[0].primitives[primitive_index];
    const auto positions = detail::read_vec3s(document, primitive.attributes.at("POSITION"));
    const auto colors = detail::read_colors(document, primitive.attributes.at("COLOR_0"));
    const auto indices = detail::read_indices(document, primitive.indices);
    EXPECT_TRUE(positions && colors && indices);
    if (!positions || !colors || !indices) return {};
    for (size_t i = 0; i < positions->size(); ++i) {
        EXPECT_NEAR((*colors)[i].x * 255.0f, (*positions)[i].x, 1e-4f);
    }
    std::vector<Triangle> triangles;
    for (size_t i = 0; i + 2 < indices->size(); i += 3) {
        const uint32_t* corner = &(*indices)[i];
        triangles.push_back(
            {(*positions)[corner[0]], (*positions)[corner[1]], (*positions)[corner[2]]});
    }
    return sorted(triangles);
}

void expect_round_trip(Method method) {
    const auto triangles = sheet(9);
    Document document = document_of(compress(triangles, method), triangles.size());
    const auto status = detail::decode_draco(document);
    ASSERT_TRUE(status) << error_text(status.error());
    EXPECT_FALSE(document.meshes[0].primitives[0].draco);
    EXPECT_EQ(document.accessors.size(), 3u);
    EXPECT_EQ(triangles_of(document), sorted(triangles));
}

TEST(GltfDraco, SequentialMeshesComeBackAsTheyWere) {
    expect_round_trip(Method::Sequential);
}

TEST(GltfDraco, EdgebreakerMeshesComeBackAsTheyWere) {
    expect_round_trip(Method::Edgebreaker);
}

TEST(GltfDraco, IndicesHaveTheTypeOfTheirAccessor) {
    for (const uint32_t type : {5121u, 5123u, 5125u}) {
        Document document = small_document();
        document.accessors[2].component_type = type;
        const auto status = detail::decode_draco(document);
        ASSERT_TRUE(status) << error_text(status.error());
        EXPECT_EQ(triangles_of(document), sorted(sheet(2))) << type;
    }
}

TEST(GltfDraco, NormalizedBytesBecomeFloatsIfTheAccessorSaysSo) {
    Document document = small_document();
    document.accessors[1].component_type = 5126;
    ASSERT_TRUE(detail::decode_draco(document));
    EXPECT_EQ(triangles_of(document), sorted(sheet(2)));
}

TEST(GltfDraco, AttributesThatAreNotCompressedStay) {
    Document document = small_document();
    detail::GltfPrimitive& primitive = document.meshes[0].primitives[0];
    primitive.draco->attributes.erase("COLOR_0");
    const uint64_t count = document.accessors[1].count;
    document.buffers.emplace_back(count * 4, std::byte{255});
    document.buffer_views.push_back({1, 0, count * 4, 0, std::nullopt});
    document.accessors[1].buffer_view = 1;
    ASSERT_TRUE(detail::decode_draco(document));
    const auto colors = detail::read_colors(document, primitive.attributes.at("COLOR_0"));
    ASSERT_TRUE(colors);
    EXPECT_EQ(*colors, std::vector<glm::vec4>(count, glm::vec4(1.0f)));
}

TEST(GltfDraco, PrimitivesThatShareDataShareAccessors) {
    Document document = small_document();
    document.meshes[0].primitives.push_back(document.meshes[0].primitives[0]);
    ASSERT_TRUE(detail::decode_draco(document));
    EXPECT_EQ(document.buffers.size(), 4u);
    EXPECT_EQ(triangles_of(document, 1), sorted(sheet(2)));
}

TEST(GltfDraco, PrimitivesWithOtherDataGetAccessorsOfTheirOwn) {
    auto moved = sheet(2);
    for (Triangle& triangle : moved) {
        for (glm::vec3& corner : triangle) corner.y += 5.0f;
    }
    Document document = small_document();
    document.buffers.push_back(compress(moved, Method::Edgebreaker).bytes);
    document.buffer_views.push_back({1, 0, document.buffers[1].size(), 0, std::nullopt});
    document.meshes[0].primitives.push_back(document.meshes[0].primitives[0]);
    document.meshes[0].primitives[1].draco->buffer_view = 1;
    ASSERT_TRUE(detail::decode_draco(document));
    EXPECT_EQ(triangles_of(document, 0), sorted(sheet(2)));
    EXPECT_EQ(triangles_of(document, 1), sorted(moved));
}

TEST(GltfDraco, DecodedBytesFollowTheCounts) {
    Document document = small_document();
    const uint64_t points = document.accessors[0].count;
    EXPECT_EQ(detail::draco_decoded_bytes(document), points * 12 + points * 16 + 24 * 4);
    document.meshes[0].primitives[0].draco.reset();
    EXPECT_EQ(detail::draco_decoded_bytes(document), 0u);
}

TEST(GltfDraco, EveryTruncationIsAnErrorOrTheWholeMesh) {
    for (const Method method : {Method::Sequential, Method::Edgebreaker}) {
        const Document whole = document_of(compress(sheet(2), method), 8);
        size_t failures = 0;
        for (size_t cut = 0; cut < whole.buffers[0].size(); ++cut) {
            Document document = whole;
            document.buffers[0].resize(cut);
            document.buffers[0].shrink_to_fit();
            document.buffer_views[0].byte_length = cut;
            if (!detail::decode_draco(document)) ++failures;
        }
        EXPECT_GT(failures, whole.buffers[0].size() / 2);
    }
}

TEST(GltfDraco, ChangedBytesNeverGiveIndicesThatAreOutOfRange) {
    const Document whole = small_document();
    for (size_t i = 11; i < whole.buffers[0].size(); ++i) {
        Document document = whole;
        document.buffers[0][i] ^= std::byte{0x55};
        if (!detail::decode_draco(document)) continue;
        const auto indices = detail::read_indices(document, 2);
        ASSERT_TRUE(indices);
        EXPECT_EQ(indices->size(), 24u);
        for (const uint32_t index : *indices) EXPECT_LT(index, document.accessors[0].count);
    }
}

/// A change of a document, and the error that it has to give.
struct DracoRejection {
    const char* label;
    std::function<void(Document&, detail::GltfPrimitive&)> change;
    const char* member;
    const char* error;
};

class GltfDracoRejects : public testing::TestWithParam<DracoRejection> {};

TEST_P(GltfDracoRejects, WithPlaceAndValue) {
    Document document = small_document();
    GetParam().change(document, document.meshes[0].primitives[0]);
    const auto status = detail::decode_draco(document);
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              std::string("mesh 0 \"sheet\": primitive 0: KHR_draco_mesh_compression: ") +
                  GetParam().error);
    EXPECT_EQ(status.error().field, std::string("meshes[0].primitives[0]") + GetParam().member);
}

constexpr const char* kData = ".extensions.KHR_draco_mesh_compression.bufferView";

using Primitive = detail::GltfPrimitive;

INSTANTIATE_TEST_SUITE_P(
    All, GltfDracoRejects,
    testing::Values(
        DracoRejection{"Strip", [](Document&, Primitive& p) { p.mode = 5; }, ".mode",
                       "mode 5 is not supported; export as triangles (mode 4)"},
        DracoRejection{"NoIndices", [](Document&, Primitive& p) { p.indices = kNoIndex; },
                       ".indices", "has no indices"},
        DracoRejection{"Name", [](Document&, Primitive& p) { p.attributes.erase("COLOR_0"); },
                       ".extensions.KHR_draco_mesh_compression.attributes.COLOR_0",
                       "COLOR_0 is not an attribute of the primitive"},
        DracoRejection{"Id", [](Document&, Primitive& p) { p.draco->attributes["COLOR_0"] = 7; },
                       ".extensions.KHR_draco_mesh_compression.attributes.COLOR_0",
                       "COLOR_0: the compressed data have no attribute 7"},
        DracoRejection{"IndexCount", [](Document& d, Primitive&) { d.accessors[2].count = 21; },
                       ".indices",
                       "the accessor of the indices has 21 elements, the compressed data have 24"},
        DracoRejection{"PointCount", [](Document& d, Primitive&) { d.accessors[0].count = 10; },
                       ".attributes.POSITION",
                       "the accessor of POSITION has 10 elements, the compressed data have 9"},
        DracoRejection{"Components",
                       [](Document& d, Primitive&) { d.accessors[1].component_count = 3; },
                       ".attributes.COLOR_0",
                       "COLOR_0: the accessor has 3 components, the compressed data have 4"},
        DracoRejection{"ComponentType",
                       [](Document& d, Primitive&) { d.accessors[1].component_type = 5120; },
                       ".attributes.COLOR_0", "COLOR_0: the values do not fit component type 5120"},
        DracoRejection{"IndexType",
                       [](Document& d, Primitive&) { d.accessors[2].component_type = 5122; },
                       ".indices", "the indices do not fit component type 5122"},
        DracoRejection{"NoDraco", [](Document& d, Primitive&) { d.buffers[0][0] = std::byte{'X'}; },
                       kData, "the data do not decode (not a mesh of Draco)"}),
    [](const auto& param_info) { return std::string(param_info.param.label); });

TEST(GltfDraco, AHugeMeshIsRejectedByItsHeader) {
    Document document = document_of(compress(sheet(2), Method::Sequential), 8);
    const std::array huge = {std::byte{0xff}, std::byte{0xff}, std::byte{0xff}, std::byte{0xff},
                             std::byte{0x04}};  // 1342177279 faces
    std::vector<std::byte>& bytes = document.buffers[0];
    constexpr size_t kHeader = 11;
    bytes.erase(bytes.begin() + kHeader);
    bytes.insert(bytes.begin() + kHeader, huge.begin(), huge.end());
    document.buffer_views[0].byte_length = bytes.size();
    const auto status = detail::decode_draco(document);
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()),
              "mesh 0 \"sheet\": primitive 0: KHR_draco_mesh_compression: the accessor of the "
              "indices has 24 elements, the compressed data have 4026531837");
}

}  // namespace
}  // namespace tetralight
