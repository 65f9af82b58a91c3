// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_meshes.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_accessors.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kTriangles = 4;
constexpr uint32_t kTriangleStrip = 5;
constexpr uint32_t kTriangleFan = 6;

/// The vertex of each corner, in the order of the primitive: its indices, or each vertex once.
Result<std::vector<uint32_t>> read_corners(const GltfDocument& document,
                                           const GltfPrimitive& primitive, size_t vertex_count) {
    if (primitive.indices == kNoIndex) {
        std::vector<uint32_t> corners(vertex_count);
        std::iota(corners.begin(), corners.end(), 0u);
        return corners;
    }
    auto corners = read_indices(document, primitive.indices);
    if (!corners) return corners.error();
    for (const uint32_t index : *corners) {
        if (index < vertex_count) continue;
        return Error{ErrorCode::Corrupt, ".indices", str_cat(index),
                     str_cat("index ", index, " is out of range (", vertex_count, " vertices)")};
    }
    return corners;
}

/// Triangle i of a strip is (i, i + 1 + i % 2, i + 2 - i % 2). Skips the triangles without area
/// that join two parts of a strip.
std::vector<uint32_t> triangles_from_strip(const std::vector<uint32_t>& corners) {
    std::vector<uint32_t> indices;
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
        const uint32_t a = corners[i];
        const uint32_t b = corners[i + 1 + i % 2];
        const uint32_t c = corners[i + 2 - i % 2];
        if (a != b && b != c && c != a) indices.insert(indices.end(), {a, b, c});
    }
    return indices;
}

std::vector<uint32_t> triangles_from_fan(const std::vector<uint32_t>& corners) {
    std::vector<uint32_t> indices;
    for (size_t i = 0; i + 2 < corners.size(); ++i) {
        indices.insert(indices.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
    return indices;
}

Result<std::vector<uint32_t>> triangles_from(std::vector<uint32_t> corners, uint32_t mode) {
    if (corners.size() < 3 || (mode == kTriangles && corners.size() % 3 != 0)) {
        return Error{ErrorCode::Corrupt, ".indices", str_cat(corners.size()),
                     str_cat(corners.size(), " corners do not make whole triangles")};
    }
    if (mode == kTriangleStrip) return triangles_from_strip(corners);
    if (mode == kTriangleFan) return triangles_from_fan(corners);
    return corners;
}

/// False for triangles that are degenerate by construction: two equal corners, or three on a line
/// along an axis or a diagonal. True for thin triangles.
bool has_area(const Mesh& mesh, const uint32_t* corners) {
    const glm::dvec3 a(mesh.positions[corners[0]]);
    const glm::dvec3 b(mesh.positions[corners[1]]);
    const glm::dvec3 c(mesh.positions[corners[2]]);
    return glm::cross(b - a, c - a) != glm::dvec3(0.0);
}

Status check_count(size_t count, const char* attribute, const Mesh& mesh) {
    if (count == mesh.positions.size()) return Ok{};
    return Error{
        ErrorCode::Corrupt, str_cat(".attributes.", attribute), "",
        str_cat(attribute, " has ", count, " elements, POSITION has ", mesh.positions.size())};
}

/// Integers that stand for 0 to 1 have to say so.
Status check_normalized(const GltfAccessor& accessor, const char* attribute, const char* remedy) {
    constexpr uint32_t kFloatComponents = 5126;
    if (accessor.component_type == kFloatComponents || accessor.is_normalized) return Ok{};
    return Error{ErrorCode::Corrupt, str_cat(".attributes.", attribute), "",
                 str_cat(attribute, ": has integers that are not \"normalized\"; ", remedy)};
}

Status check_color_type(const GltfAccessor& accessor) {
    return check_normalized(accessor, "COLOR_0",
                            "set \"normalized\": true, so that the largest integer is 1");
}

Status check_uv_type(const GltfDocument& document, const GltfAccessor& accessor,
                     const char* attribute) {
    if (document.is_quantized) return Ok{};
    return check_normalized(accessor, attribute,
                            "set \"normalized\": true, or list KHR_mesh_quantization in "
                            "extensionsUsed if they count texels");
}

Status read_vertex_colors(const GltfDocument& document, const GltfAttributes& attributes,
                          Mesh& mesh) {
    const auto color = attributes.find("COLOR_0");
    if (color == attributes.end()) return Ok{};
    const auto type = check_color_type(document.accessors[color->second]);
    if (!type) return type;
    auto colors = read_colors(document, color->second);
    if (!colors) return colors.error().in("COLOR_0");
    const auto status = check_count(colors->size(), "COLOR_0", mesh);
    if (!status) return status;
    mesh.colors = std::move(*colors);
    return Ok{};
}

/// Reads TANGENT. Its length has no meaning; w is 1 or −1.
Status read_tangents(const GltfDocument& document, const GltfAttributes& attributes, Mesh& mesh) {
    const auto tangent = attributes.find("TANGENT");
    if (tangent == attributes.end()) return Ok{};
    auto tangents = read_vec4s(document, tangent->second);
    if (!tangents) return tangents.error().in("TANGENT");
    const auto status = check_count(tangents->size(), "TANGENT", mesh);
    if (!status) return status;
    mesh.tangents = std::move(*tangents);
    return Ok{};
}

/// Reads normals, texture coordinates and colours, if the primitive has them.
Status read_optional_attributes(const GltfDocument& document, const GltfAttributes& attributes,
                                Mesh& mesh) {
    if (const auto normal = attributes.find("NORMAL"); normal != attributes.end()) {
        auto normals = read_vec3s(document, normal->second);
        if (!normals) return normals.error().in("NORMAL");
        const auto status = check_count(normals->size(), "NORMAL", mesh);
        if (!status) return status;
        mesh.normals = std::move(*normals);
    }
    constexpr const char* kUvNames[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (size_t set = 0; set < std::size(kUvNames); ++set) {
        const auto uv = attributes.find(kUvNames[set]);
        if (uv == attributes.end()) continue;
        const auto type = check_uv_type(document, document.accessors[uv->second], kUvNames[set]);
        if (!type) return type;
        auto uvs = read_vec2s(document, uv->second);
        if (!uvs) return uvs.error().in(kUvNames[set]);
        const auto status = check_count(uvs->size(), kUvNames[set], mesh);
        if (!status) return status;
        mesh.uvs[set] = std::move(*uvs);
    }
    return read_vertex_colors(document, attributes, mesh);
}

Status read_mesh(const GltfDocument& document, const GltfMesh& source, NormalMaps normal_maps,
                 GltfMeshes& result) {
    auto& meshes_of_source = result.meshes_of.emplace_back();
    size_t flat_count = 0;
    for (size_t i = 0; i < source.primitives.size(); ++i) {
        const GltfPrimitive& primitive = source.primitives[i];
        const std::string place = str_cat("primitive ", i);
        if (primitive.mode > kTriangleFan) {
            return Error{ErrorCode::Corrupt, str_cat(".primitives[", i, "].mode"),
                         str_cat(primitive.mode),
                         str_cat(place, ": mode ", primitive.mode, " is not known")};
        }
        if (!has_triangles(primitive)) continue;  // points and lines reflect no light
        auto mesh = read_primitive(document, primitive, normal_maps);
        if (!mesh) return in_member(mesh.error().in(place), str_cat(".primitives[", i, "]"));
        flat_count += remove_flat_triangles(*mesh);
        if (mesh->indices.empty()) continue;
        meshes_of_source.push_back(static_cast<uint32_t>(result.meshes.size()));
        result.meshes.push_back(std::move(*mesh));
        result.primitive_of.push_back(static_cast<uint32_t>(i));
    }
    if (flat_count > 0) {
        ScenePart part;
        part.use = PartUse::Ignored;
        part.name = "triangles without area";
        part.note = "are left out: no ray can hit them";
        result.parts.add(part, gltf_place("mesh", result.meshes_of.size() - 1, source.name));
        result.parts.add_count(part, flat_count - 1);
    }
    return Ok{};
}

}  // namespace

bool has_triangles(const GltfPrimitive& primitive) {
    return primitive.mode >= kTriangles && primitive.mode <= kTriangleFan;
}

size_t remove_flat_triangles(Mesh& mesh) {
    auto& indices = mesh.indices;
    size_t kept = 0;
    for (size_t i = 0; i < indices.size(); i += 3) {
        if (!has_area(mesh, &indices[i])) continue;
        std::copy_n(&indices[i], 3, &indices[kept]);
        kept += 3;
    }
    const size_t removed = (indices.size() - kept) / 3;
    indices.resize(kept);
    return removed;
}

Result<Mesh> read_primitive(const GltfDocument& document, const GltfPrimitive& primitive,
                            NormalMaps normal_maps) {
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        return Error{ErrorCode::Corrupt, ".attributes.POSITION", "", "has no POSITION"};
    }
    auto positions = read_vec3s(document, position->second);
    if (!positions) return positions.error().in("POSITION");
    Mesh mesh;
    mesh.positions = std::move(*positions);
    mesh.material = primitive.material;
    const auto status = read_optional_attributes(document, primitive.attributes, mesh);
    if (!status) return status.error();
    if (normal_maps == NormalMaps::Read) {
        const auto tangents = read_tangents(document, primitive.attributes, mesh);
        if (!tangents) return tangents.error();
    }
    auto corners = read_corners(document, primitive, mesh.positions.size());
    if (!corners) return corners.error();
    auto indices = triangles_from(std::move(*corners), primitive.mode);
    if (!indices) return indices.error();
    mesh.indices = std::move(*indices);
    return mesh;
}

Result<GltfMeshes> read_meshes(const GltfDocument& document, NormalMaps normal_maps) {
    GltfMeshes result;
    for (size_t i = 0; i < document.meshes.size(); ++i) {
        const auto status = read_mesh(document, document.meshes[i], normal_maps, result);
        if (!status) return in_element(status.error(), "meshes", i, document.meshes[i].name);
    }
    return result;
}

}  // namespace tetralight::detail
