// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_meshopt.h>

#include <meshoptimizer.h>

#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/process/memory.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using MeshoptBytes = std::vector<std::byte>;

constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// Decoded bytes of a compressed byte, at most. The encoding of attributes spends 2 bits on 16
/// bytes that are equal to those of the element before; the others spend more.
constexpr uint64_t kMaxMeshoptRatio = 64;

/// How the bytes of a mode begin: the high half of the first byte is the mode, the low half the
/// version of the encoding.
struct MeshoptHeader {
    unsigned mode = 0;
    unsigned last_version = 0;
};

MeshoptHeader header_of(const std::string& mode) {
    if (mode == "ATTRIBUTES") return {0xa, 0};
    if (mode == "TRIANGLES") return {0xe, 1};
    return {0xd, 1};
}

Error meshopt_error(const char* member, const std::string& value, const std::string& message) {
    return {ErrorCode::Corrupt, str_cat(".extensions.", kMeshoptExtension, ".", member), value,
            str_cat(kMeshoptExtension, ": ", message)};
}

Error stride_error(const GltfMeshopt& meshopt, const std::string& rule) {
    return meshopt_error("byteStride", str_cat(meshopt.byte_stride),
                         str_cat("byteStride ", meshopt.byte_stride, " is not ", rule));
}

Status check_mode(const GltfMeshopt& meshopt) {
    const std::string& mode = meshopt.mode;
    const uint64_t stride = meshopt.byte_stride;
    if (mode == "ATTRIBUTES") {
        if (stride > 0 && stride <= 256 && stride % 4 == 0) return Ok{};
        return stride_error(meshopt, "a multiple of 4 up to 256");
    }
    if (mode != "TRIANGLES" && mode != "INDICES") {
        return meshopt_error("mode", quoted_value(mode),
                             str_cat("mode \"", quoted_value(mode),
                                     "\" is not \"ATTRIBUTES\", \"TRIANGLES\" or \"INDICES\""));
    }
    if (stride != 2 && stride != 4) {
        return stride_error(meshopt, str_cat("2 or 4, as mode \"", mode, "\" needs"));
    }
    if (mode == "INDICES" || meshopt.count % 3 == 0) return Ok{};
    return meshopt_error(
        "count", str_cat(meshopt.count),
        str_cat("count ", meshopt.count, " is not a multiple of 3, as mode \"TRIANGLES\" needs"));
}

Status check_filter(const GltfMeshopt& meshopt) {
    const std::string& filter = meshopt.filter;
    const uint64_t stride = meshopt.byte_stride;
    if (filter == "NONE") return Ok{};
    if (filter != "OCTAHEDRAL" && filter != "QUATERNION" && filter != "EXPONENTIAL") {
        return meshopt_error(
            "filter", quoted_value(filter),
            str_cat("filter \"", quoted_value(filter),
                    "\" is not \"NONE\", \"OCTAHEDRAL\", \"QUATERNION\" or \"EXPONENTIAL\""));
    }
    if (meshopt.mode != "ATTRIBUTES") {
        return meshopt_error(
            "filter", filter,
            str_cat("filter \"", filter, "\" does not go with mode \"", meshopt.mode, "\""));
    }
    if (filter == "OCTAHEDRAL" && stride != 4 && stride != 8) {
        return stride_error(meshopt, "4 or 8, as filter \"OCTAHEDRAL\" needs");
    }
    if (filter == "QUATERNION" && stride != 8) {
        return stride_error(meshopt, "8, as filter \"QUATERNION\" needs");
    }
    return Ok{};
}

/// The size and the stride of the view are those of the decoded elements.
Status check_view(const GltfBufferView& view) {
    const GltfMeshopt& meshopt = *view.meshopt;
    if (meshopt.count == 0) return meshopt_error("count", "0", "count is 0");
    const uint64_t size = meshopt.count * meshopt.byte_stride;
    if (view.byte_stride != 0 && view.byte_stride != meshopt.byte_stride) {
        return stride_error(meshopt, str_cat("the buffer view's ", view.byte_stride));
    }
    if (view.byte_length != size) {
        return meshopt_error(
            "count", str_cat(meshopt.count),
            str_cat(meshopt.count, " elements of ", meshopt.byte_stride,
                    " bytes are not the buffer view's ", view.byte_length, " bytes"));
    }
    if (size / kMaxMeshoptRatio <= meshopt.byte_length) return Ok{};
    return meshopt_error(
        "byteLength", str_cat(meshopt.byte_length),
        str_cat(meshopt.byte_length, " bytes are too few for ", size, " decoded bytes"));
}

Result<std::span<const std::byte>> compressed_bytes(const GltfDocument& document,
                                                    const GltfMeshopt& meshopt) {
    const MeshoptBytes& buffer = document.buffers[meshopt.buffer];
    const uint64_t end = meshopt.byte_offset + meshopt.byte_length;
    if (meshopt.byte_length > 0 && end <= buffer.size()) {
        return std::span(buffer).subspan(meshopt.byte_offset, meshopt.byte_length);
    }
    return meshopt_error(
        "byteLength", str_cat(meshopt.byte_length),
        str_cat("bytes ", meshopt.byte_offset, " to ", end, " are outside of buffer ",
                meshopt.buffer, " (", buffer.size(), " bytes)"));
}

Status check_header(const GltfMeshopt& meshopt, unsigned first) {
    const MeshoptHeader header = header_of(meshopt.mode);
    const unsigned version = first & 0xfu;
    if (first >> 4u != header.mode) {
        return meshopt_error("mode", meshopt.mode,
                             str_cat("the bytes are not of mode \"", meshopt.mode, "\""));
    }
    if (version <= header.last_version) return Ok{};
    Error error =
        meshopt_error("mode", meshopt.mode,
                      str_cat("the bytes are of version ", version,
                              " of the encoding, versions up to ", header.last_version,
                              " are read; export the file again with version 0 (gltfpack -c)"));
    error.code = ErrorCode::Unsupported;
    return error;
}

void apply_filter(const GltfMeshopt& meshopt, MeshoptBytes& elements) {
    const size_t count = meshopt.count, stride = meshopt.byte_stride;
    if (meshopt.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(elements.data(), count, stride);
    if (meshopt.filter == "QUATERNION") meshopt_decodeFilterQuat(elements.data(), count, stride);
    if (meshopt.filter == "EXPONENTIAL") meshopt_decodeFilterExp(elements.data(), count, stride);
}

Result<MeshoptBytes> decode_elements(const GltfMeshopt& meshopt,
                                     std::span<const std::byte> compressed) {
    const size_t count = meshopt.count, stride = meshopt.byte_stride;
    const std::span bytes(reinterpret_cast<const unsigned char*>(compressed.data()),
                          compressed.size());
    MeshoptBytes elements(count * stride);
    int failure = 0;
    if (meshopt.mode == "ATTRIBUTES") {
        failure =
            meshopt_decodeVertexBuffer(elements.data(), count, stride, bytes.data(), bytes.size());
    } else if (meshopt.mode == "TRIANGLES") {
        failure =
            meshopt_decodeIndexBuffer(elements.data(), count, stride, bytes.data(), bytes.size());
    } else {
        failure =
            meshopt_decodeIndexSequence(elements.data(), count, stride, bytes.data(), bytes.size());
    }
    if (failure != 0) {
        return meshopt_error("byteLength", str_cat(meshopt.byte_length),
                             str_cat(meshopt.byte_length, " bytes do not decode to ", count,
                                     " elements of ", stride, " bytes"));
    }
    apply_filter(meshopt, elements);
    return elements;
}

Result<MeshoptBytes> decode_view(const GltfDocument& document, const GltfBufferView& view) {
    const GltfMeshopt& meshopt = *view.meshopt;
    for (const Status& status : {check_mode(meshopt), check_filter(meshopt), check_view(view)}) {
        if (!status) return status.error();
    }
    const auto bytes = compressed_bytes(document, meshopt);
    if (!bytes) return bytes.error();
    if (auto status = check_header(meshopt, std::to_integer<unsigned>(bytes->front())); !status)
        return status.error();
    return decode_elements(meshopt, *bytes);
}

}  // namespace

Status decode_meshopt(GltfDocument& document) {
    for (size_t i = 0; i < document.buffer_views.size(); ++i) {
        GltfBufferView& view = document.buffer_views[i];
        if (!view.meshopt) continue;
        auto elements = decode_view(document, view);
        if (!elements) return in_element(elements.error(), "bufferViews", i, "");
        view.buffer = static_cast<uint32_t>(document.buffers.size());
        view.byte_offset = 0;
        view.meshopt.reset();
        document.buffers.push_back(std::move(*elements));
    }
    return Ok{};
}

uint64_t meshopt_decoded_bytes(const GltfDocument& document) {
    uint64_t sum = 0;
    for (const GltfBufferView& view : document.buffer_views) {
        if (view.meshopt) sum = add_bytes(sum, view.meshopt->count, view.meshopt->byte_stride);
    }
    return sum;
}

}  // namespace tetralight::detail
