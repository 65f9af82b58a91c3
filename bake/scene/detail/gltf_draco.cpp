// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_draco.h>

#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/process/memory.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using DracoBytes = std::vector<std::byte>;

constexpr uint32_t kTriangleList = 4;
constexpr const char* kDracoMember = ".extensions.KHR_draco_mesh_compression";

/// The id of the indices in `DracoSource`, where attributes have theirs.
constexpr uint32_t kDracoIndices = kNoIndex;

/// Where an accessor's elements come from: a buffer view of compressed data, and the id of an
/// attribute in it.
using DracoSource = std::pair<uint32_t, uint32_t>;

/// The sources of the accessors that have decoded elements.
using DracoSources = std::map<uint32_t, DracoSource>;

Error draco_error(const std::string& member, const std::string& value, const std::string& message) {
    return {ErrorCode::Corrupt, member, value, str_cat("KHR_draco_mesh_compression: ", message)};
}

Error undecodable(const std::string& reason) {
    return draco_error(str_cat(kDracoMember, ".bufferView"), "",
                       str_cat("the data do not decode (", reason, ")"));
}

Error count_error(const std::string& member, const std::string& name, uint64_t own,
                  uint64_t compressed) {
    return draco_error(member, str_cat(own),
                       str_cat("the accessor of ", name, " has ", own,
                               " elements, the compressed data have ", compressed));
}

/// What compressed data say of their size before it is decoded.
struct DracoCounts {
    uint64_t faces = 0;
    /// Nothing if the encoding tells it later.
    std::optional<uint64_t> points{};
};

/// A number of bitstreams from `varint_version` on as a varint, before as 32 bits.
bool read_draco_number(draco::DecoderBuffer& buffer, uint16_t varint_version, uint32_t& number) {
    if (buffer.bitstream_version() < varint_version) return buffer.Decode(&number);
    return draco::DecodeVarint(&number, &buffer);
}

/// Reads the counts of a mesh from behind the header and the metadata.
bool read_connectivity_counts(draco::DecoderBuffer& buffer, uint8_t method, DracoCounts& counts) {
    constexpr uint16_t kVersion20 = DRACO_BITSTREAM_VERSION(2, 0);
    constexpr uint16_t kVersion22 = DRACO_BITSTREAM_VERSION(2, 2);
    uint32_t faces = 0, vertices = 0;
    if (method == draco::MESH_SEQUENTIAL_ENCODING) {
        if (!read_draco_number(buffer, kVersion22, faces)) return false;
        if (!read_draco_number(buffer, kVersion22, vertices)) return false;
        counts = {faces, vertices};
        return true;
    }
    uint8_t traversal = 0;
    uint32_t new_vertices = 0;
    if (!buffer.Decode(&traversal)) return false;
    const bool has_new_vertices = buffer.bitstream_version() < kVersion22;
    if (has_new_vertices && !read_draco_number(buffer, kVersion20, new_vertices)) return false;
    if (!read_draco_number(buffer, kVersion20, vertices)) return false;
    if (!read_draco_number(buffer, kVersion20, faces)) return false;
    counts = {faces, std::nullopt};
    return true;
}

/// The size of a mesh by its header; nothing if the data are not those of a mesh.
std::optional<DracoCounts> announced_counts(std::span<const char> data) {
    draco::DecoderBuffer buffer;
    buffer.Init(data.data(), data.size());
    draco::DracoHeader header{};
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return std::nullopt;
    if (header.encoder_type != draco::TRIANGULAR_MESH) return std::nullopt;
    const auto version =
        static_cast<uint16_t>(DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    buffer.set_bitstream_version(version);
    if (version >= DRACO_BITSTREAM_VERSION(1, 3) && (header.flags & METADATA_FLAG_MASK) != 0) {
        draco::GeometryMetadata metadata;
        draco::MetadataDecoder decoder;
        if (!decoder.DecodeGeometryMetadata(&buffer, &metadata)) return std::nullopt;
    }
    DracoCounts counts;
    if (!read_connectivity_counts(buffer, header.encoder_method, counts)) return std::nullopt;
    return counts;
}

std::string attribute_member(const std::string& name) {
    return str_cat(".attributes.", name);
}

/// Each compressed attribute has an accessor.
Status check_accessors(const GltfPrimitive& primitive) {
    if (primitive.mode != kTriangleList) {
        Error error = draco_error(
            ".mode", str_cat(primitive.mode),
            str_cat("mode ", primitive.mode, " is not supported; export as triangles (mode 4)"));
        error.code = ErrorCode::Unsupported;
        return error;
    }
    if (primitive.indices == kNoIndex) return draco_error(".indices", "", "has no indices");
    for (const auto& [name, id] : primitive.draco->attributes) {
        if (primitive.attributes.contains(name)) continue;
        return draco_error(str_cat(kDracoMember, ".attributes.", name), str_cat(id),
                           str_cat(name, " is not an attribute of the primitive"));
    }
    return Ok{};
}

Status check_counts(const GltfDocument& document, const GltfPrimitive& primitive,
                    const DracoCounts& counts) {
    const uint64_t corners = document.accessors[primitive.indices].count;
    if (counts.faces * 3 != corners) {
        return count_error(".indices", "the indices", corners, counts.faces * 3);
    }
    if (!counts.points) return Ok{};
    for (const auto& [name, id] : primitive.draco->attributes) {
        const uint64_t count = document.accessors[primitive.attributes.at(name)].count;
        if (count == *counts.points) continue;
        return count_error(attribute_member(name), name, count, *counts.points);
    }
    return Ok{};
}

std::span<const char> compressed_data(const GltfDocument& document, const GltfDraco& compressed) {
    const GltfBufferView& view = document.buffer_views[compressed.buffer_view];
    const auto* first = reinterpret_cast<const char*>(document.buffers[view.buffer].data());
    return {first + view.byte_offset, view.byte_length};
}

/// Decodes a mesh, after its announced size is found to be that of the accessors.
Result<std::unique_ptr<draco::Mesh>> decode_mesh(const GltfDocument& document,
                                                 const GltfPrimitive& primitive) {
    const std::span<const char> data = compressed_data(document, *primitive.draco);
    const auto counts = announced_counts(data);
    if (!counts) return undecodable("not a mesh of Draco");
    if (auto status = check_counts(document, primitive, *counts); !status) return status.error();
    draco::DecoderBuffer buffer;
    buffer.Init(data.data(), data.size());
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) return undecodable(mesh.status().error_msg_string());
    auto decoded = std::move(mesh).value();
    const DracoCounts final_counts{decoded->num_faces(), decoded->num_points()};
    if (auto status = check_counts(document, primitive, final_counts); !status) {
        return status.error();
    }
    return decoded;
}

/// Converts the values of all points; nothing if one does not fit the type.
template <class T>
std::optional<DracoBytes> convert_values(const draco::PointAttribute& attribute,
                                         uint64_t point_count) {
    const auto components = static_cast<size_t>(attribute.num_components());
    DracoBytes bytes(point_count * components * sizeof(T));
    T values[4] = {};
    for (uint32_t point = 0; point < point_count; ++point) {
        const auto index = attribute.mapped_index(draco::PointIndex(point));
        if (!attribute.ConvertValue(index, static_cast<int8_t>(components), values)) {
            return std::nullopt;
        }
        std::memcpy(&bytes[point * components * sizeof(T)], values, components * sizeof(T));
    }
    return bytes;
}

std::optional<DracoBytes> convert_attribute(const draco::PointAttribute& attribute,
                                            const GltfAccessor& accessor) {
    switch (accessor.component_type) {
        case 5120:
            return convert_values<int8_t>(attribute, accessor.count);
        case 5121:
            return convert_values<uint8_t>(attribute, accessor.count);
        case 5122:
            return convert_values<int16_t>(attribute, accessor.count);
        case 5123:
            return convert_values<uint16_t>(attribute, accessor.count);
        case 5125:
            return convert_values<uint32_t>(attribute, accessor.count);
        case 5126:
            return convert_values<float>(attribute, accessor.count);
        default:
            return std::nullopt;
    }
}

Result<DracoBytes> decode_attribute(const draco::Mesh& mesh, uint32_t id, const std::string& name,
                                    const GltfAccessor& accessor) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr) {
        return draco_error(str_cat(kDracoMember, ".attributes.", name), str_cat(id),
                           str_cat(name, ": the compressed data have no attribute ", id));
    }
    const uint32_t components = attribute->num_components();
    if (components != accessor.component_count || components > 4) {
        return draco_error(attribute_member(name), "",
                           str_cat(name, ": the accessor has ", accessor.component_count,
                                   " components, the compressed data have ", components));
    }
    auto bytes = convert_attribute(*attribute, accessor);
    if (bytes) return std::move(*bytes);
    return draco_error(
        attribute_member(name), "",
        str_cat(name, ": the values do not fit component type ", accessor.component_type));
}

template <class T>
std::optional<DracoBytes> convert_indices(const draco::Mesh& mesh) {
    DracoBytes bytes(size_t{mesh.num_faces()} * 3 * sizeof(T));
    std::byte* next = bytes.data();
    for (uint32_t face = 0; face < mesh.num_faces(); ++face) {
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(face))) {
            if (point.value() > std::numeric_limits<T>::max()) return std::nullopt;
            const auto index = static_cast<T>(point.value());
            std::memcpy(next, &index, sizeof index);
            next += sizeof index;
        }
    }
    return bytes;
}

Result<DracoBytes> decode_indices(const draco::Mesh& mesh, const GltfAccessor& accessor) {
    std::optional<DracoBytes> bytes;
    if (accessor.component_type == 5121) bytes = convert_indices<uint8_t>(mesh);
    if (accessor.component_type == 5123) bytes = convert_indices<uint16_t>(mesh);
    if (accessor.component_type == 5125) bytes = convert_indices<uint32_t>(mesh);
    if (bytes && accessor.component_count == 1) return std::move(*bytes);
    return draco_error(".indices", "",
                       str_cat("the indices do not fit component type ", accessor.component_type));
}

/// Gives decoded elements to an accessor, or to a copy of it if it has those of another source.
uint32_t store_elements(GltfDocument& document, uint32_t accessor_index, DracoSource source,
                        DracoBytes bytes, DracoSources& sources) {
    const auto known = sources.find(accessor_index);
    if (known != sources.end() && known->second == source) return accessor_index;
    if (known != sources.end()) {
        document.accessors.push_back(document.accessors[accessor_index]);
        accessor_index = static_cast<uint32_t>(document.accessors.size() - 1);
    }
    sources[accessor_index] = source;
    GltfAccessor& accessor = document.accessors[accessor_index];
    accessor.buffer_view = static_cast<uint32_t>(document.buffer_views.size());
    accessor.byte_offset = 0;
    accessor.sparse.reset();
    const auto buffer = static_cast<uint32_t>(document.buffers.size());
    document.buffer_views.push_back({buffer, 0, bytes.size(), 0, std::nullopt});
    document.buffers.push_back(std::move(bytes));
    return accessor_index;
}

Status decode_primitive(GltfDocument& document, GltfPrimitive& primitive, DracoSources& sources) {
    if (auto status = check_accessors(primitive); !status) return status;
    const auto mesh = decode_mesh(document, primitive);
    if (!mesh) return mesh.error();
    const GltfDraco& compressed = *primitive.draco;
    auto indices = decode_indices(**mesh, document.accessors[primitive.indices]);
    if (!indices) return indices.error();
    primitive.indices =
        store_elements(document, primitive.indices, {compressed.buffer_view, kDracoIndices},
                       std::move(*indices), sources);
    for (const auto& [name, id] : compressed.attributes) {
        uint32_t& accessor = primitive.attributes.at(name);
        auto elements = decode_attribute(**mesh, id, name, document.accessors[accessor]);
        if (!elements) return elements.error();
        accessor = store_elements(document, accessor, {compressed.buffer_view, id},
                                  std::move(*elements), sources);
    }
    primitive.draco.reset();
    return Ok{};
}

/// decode_primitive(), with the exceptions of the library as errors.
Status try_decode(GltfDocument& document, GltfPrimitive& primitive, DracoSources& sources) {
    try {
        return decode_primitive(document, primitive, sources);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return undecodable(exception.what());
    }
}

/// Bytes of all elements of an accessor, as decoded.
uint64_t element_bytes(const GltfAccessor& accessor) {
    constexpr uint64_t kLargestComponent = 4;
    return accessor.count * accessor.component_count * kLargestComponent;
}

}  // namespace

Status decode_draco(GltfDocument& document) {
    DracoSources sources;
    for (size_t m = 0; m < document.meshes.size(); ++m) {
        GltfMesh& mesh = document.meshes[m];
        for (size_t i = 0; i < mesh.primitives.size(); ++i) {
            if (!mesh.primitives[i].draco) continue;
            const auto status = try_decode(document, mesh.primitives[i], sources);
            if (status) continue;
            const Error error = in_member(status.error().in(str_cat("primitive ", i)),
                                          str_cat(".primitives[", i, "]"));
            return in_element(error, "meshes", m, mesh.name);
        }
    }
    return Ok{};
}

uint64_t draco_decoded_bytes(const GltfDocument& document) {
    uint64_t sum = 0;
    const auto add = [&](uint32_t accessor) {
        sum = add_bytes(sum, element_bytes(document.accessors[accessor]));
    };
    for (const GltfMesh& mesh : document.meshes) {
        for (const GltfPrimitive& primitive : mesh.primitives) {
            if (!primitive.draco) continue;
            if (primitive.indices != kNoIndex) add(primitive.indices);
            for (const auto& [name, id] : primitive.draco->attributes) {
                const auto attribute = primitive.attributes.find(name);
                if (attribute != primitive.attributes.end()) add(attribute->second);
            }
        }
    }
    return sum;
}

}  // namespace tetralight::detail
