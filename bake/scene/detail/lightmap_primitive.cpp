// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/lightmap_primitive.h>

#include <bit>
#include <cstring>
#include <string>
#include <unordered_map>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kUnsignedShortType = 5123, kUnsignedIntType = 5125, kFloatType = 5126;

/// Vertices of which each has one UV.
struct SplitVertices {
    std::vector<uint32_t> sources;  ///< the vertex that each is a copy of
    std::vector<glm::vec2> uvs;
    std::vector<uint32_t> indices;
};

/// A vertex with the bits of a UV.
struct VertexKey {
    uint32_t vertex = 0;
    uint64_t uv = 0;

    bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
    size_t operator()(const VertexKey& key) const noexcept {
        return (key.uv ^ (key.uv >> 31)) * 0x9e3779b97f4a7c15u + key.vertex * 0xbf58476d1ce4e5b9u;
    }
};

SplitVertices split_vertices(std::span<const uint32_t> corners, std::span<const glm::vec2> uvs) {
    SplitVertices split;
    std::unordered_map<VertexKey, uint32_t, VertexKeyHash> known;
    for (size_t i = 0; i < corners.size(); ++i) {
        const uint64_t bits =
            uint64_t{std::bit_cast<uint32_t>(uvs[i].x)} << 32 | std::bit_cast<uint32_t>(uvs[i].y);
        const auto next = static_cast<uint32_t>(split.sources.size());
        const auto [entry, is_new] = known.try_emplace({corners[i], bits}, next);
        split.indices.push_back(entry->second);
        if (!is_new) continue;
        split.sources.push_back(corners[i]);
        split.uvs.push_back(uvs[i]);
    }
    return split;
}

template <class T>
RawElements raw_from(const std::vector<T>& values, uint32_t component_type, uint32_t components) {
    const auto bytes = std::as_bytes(std::span(values));
    return {{bytes.begin(), bytes.end()}, values.size(), sizeof(T), component_type, components};
}

uint32_t add_indices(GltfParts& parts, const SplitVertices& split) {
    const GltfJson scalar = {{"type", "SCALAR"}};
    if (split.sources.size() <= 0xffff) {  // 0xffff as an index restarts strips
        const std::vector<uint16_t> small(split.indices.begin(), split.indices.end());
        return parts.add_accessor(scalar, raw_from(small, kUnsignedShortType, 1),
                                  GltfParts::View::Indices);
    }
    return parts.add_accessor(scalar, raw_from(split.indices, kUnsignedIntType, 1),
                              GltfParts::View::Indices);
}

/// Copies the attributes of an object to the vertices of `split`, and changes their accessors.
/// `read` has the accessors that the elements are in.
Status split_attributes(const GltfDocument& document, GltfParts& parts, const SplitVertices& split,
                        const GltfAttributes& read, GltfJson& attributes) {
    for (const auto& [name, value] : attributes.items()) {
        const bool is_index =
            value.is_number_unsigned() && value.get<uint64_t>() < document.accessors.size();
        if (!is_index) return Error{ErrorCode::Corrupt, str_cat(name, " is not an accessor")};
        const auto accessor = value.get<uint32_t>();
        const auto source = read.find(name);
        const auto elements =
            read_raw_elements(document, source == read.end() ? accessor : source->second);
        if (!elements) return elements.error().in(name);
        for (const uint32_t vertex : split.sources) {
            if (vertex < elements->count) continue;
            return Error{ErrorCode::Corrupt, str_cat(name, " has fewer elements than POSITION")};
        }
        value = parts.add_accessor(parts.source_accessors[accessor],
                                   gather_elements(*elements, split.sources),
                                   GltfParts::View::Vertices);
    }
    return Ok{};
}

/// Collects the UV sets that textures below this value use.
void add_uv_sets(const GltfJson& value, std::set<uint64_t>& sets) {
    if (!value.is_structured()) return;
    if (value.is_object()) {
        const auto set = value.find("texCoord");
        if (set != value.end() && set->is_number_unsigned()) sets.insert(set->get<uint64_t>());
    }
    for (const GltfJson& child : value) add_uv_sets(child, sets);
}

/// Collects the materials that a primitive may have, those of KHR_materials_variants among them.
void add_materials(const GltfJson& value, std::set<uint64_t>& materials) {
    if (!value.is_structured()) return;
    if (value.is_object()) {
        const auto material = value.find("material");
        if (material != value.end() && material->is_number_unsigned())
            materials.insert(material->get<uint64_t>());
    }
    for (const GltfJson& child : value) add_materials(child, materials);
}

/// TEXCOORD_1, or the first set behind those of the primitive if a texture uses TEXCOORD_1.
uint32_t lightmap_uv_set(const GltfJson& document, const GltfJson& primitive) {
    if (!primitive["attributes"].contains("TEXCOORD_1")) return 1;
    std::set<uint64_t> materials, sets;
    add_materials(primitive, materials);
    const auto all = document.find("materials");
    for (const uint64_t material : materials) {
        if (all != document.end() && material < all->size()) add_uv_sets((*all)[material], sets);
    }
    if (!sets.contains(1)) return 1;
    uint32_t set = 2;
    while (primitive["attributes"].contains(str_cat("TEXCOORD_", set))) ++set;
    return set;
}

}  // namespace

Result<LightmapPrimitive> make_lightmap_primitive(const GltfDocument& document, GltfParts& parts,
                                                  const SourcePrimitive& primitive,
                                                  const Mesh& mesh,
                                                  std::span<const glm::vec2> corner_uvs) {
    const SplitVertices split = split_vertices(mesh.indices, corner_uvs);
    LightmapPrimitive result{primitive.json, lightmap_uv_set(parts.json, primitive.json)};
    const std::string uv_name = str_cat("TEXCOORD_", result.uv_set);
    GltfJson& attributes = result.json["attributes"];
    attributes.erase(uv_name);
    auto status = split_attributes(document, parts, split, primitive.read.attributes, attributes);
    if (!status) return status.error();
    if (result.json.contains("targets")) {
        for (GltfJson& target : result.json["targets"]) {
            status = split_attributes(document, parts, split, {}, target);
            if (!status) return status.error().in("morph target");
        }
    }
    attributes[uv_name] = parts.add_accessor({{"type", "VEC2"}}, raw_from(split.uvs, kFloatType, 2),
                                             GltfParts::View::Vertices);
    // Sets of UVs are numbered without gaps.
    if (!attributes.contains("TEXCOORD_0")) attributes["TEXCOORD_0"] = attributes[uv_name];
    result.json["indices"] = add_indices(parts, split);
    result.json.erase("mode");
    const auto extensions = result.json.find("extensions");
    if (extensions != result.json.end()) {
        extensions->erase("KHR_draco_mesh_compression");
        if (extensions->empty()) result.json.erase("extensions");
    }
    return result;
}

}  // namespace tetralight::detail
