// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_buffers.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;
using BufferBytes = std::vector<std::byte>;

/// The six bits of a character of base64 (RFC 4648); −1 for others.
int base64_bits(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

Result<BufferBytes> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    BufferBytes bytes;
    bytes.reserve(text.size() * 3 / 4);
    uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int value = base64_bits(c);
        if (value < 0) {
            return Error{ErrorCode::Corrupt, ".uri", std::string(1, c),
                         str_cat("data URI is not base64 (character \"", std::string(1, c), "\")")};
        }
        bits = bits << 6 | static_cast<uint32_t>(value);
        bit_count += 6;
        if (bit_count < 8) continue;
        bit_count -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> bit_count));
    }
    return bytes;
}

Result<BufferBytes> read_uri(const std::string& uri, const std::string& scene_path) {
    if (is_data_uri(uri)) return decode_data_uri(uri);
    const auto path = path_from_uri(uri, scene_path);
    if (!path) return path.error();
    auto bytes = read_file(*path);
    if (!bytes) {
        Error error = in_member(bytes.error(), ".uri");
        error.value.clear();  // the path, where the file has a URI
        return error;
    }
    return bytes;
}

Result<BufferBytes> read_buffer(const json& buffer, const std::string& scene_path,
                                std::optional<std::span<const std::byte>> binary_chunk) {
    if (is_fallback_buffer(buffer)) return BufferBytes();
    const auto length = size_at(buffer, "byteLength", 0);
    const std::string uri = string_at(buffer, "uri");
    Result<BufferBytes> bytes = BufferBytes();
    if (!uri.empty()) {
        bytes = read_uri(uri, scene_path);
    } else if (binary_chunk && length <= binary_chunk->size()) {
        bytes = BufferBytes(binary_chunk->begin(), binary_chunk->begin() + length);
    } else if (binary_chunk) {
        bytes->resize(binary_chunk->size());
    }
    if (!bytes || bytes->size() == length) return bytes;
    if (bytes->size() < length) {
        const std::string source = uri.empty()        ? "the binary chunk"
                                   : is_data_uri(uri) ? "its data URI"
                                                      : quoted_value(uri);
        return Error{
            ErrorCode::Corrupt, ".byteLength", str_cat(length),
            str_cat("byteLength is ", length, ", ", source, " has ", bytes->size(), " bytes")};
    }
    bytes->resize(length);
    return bytes;
}

}  // namespace

Result<BufferBytes> decode_data_uri(std::string_view uri) {
    constexpr std::string_view kMark = ";base64";
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(kMark)) {
        return Error{ErrorCode::Unsupported, ".uri", quoted_value(uri),
                     "kind of data URI is not supported"};
    }
    return decode_base64(uri.substr(comma + 1));
}

bool is_fallback_buffer(const json& buffer) {
    return boolean_at(buffer, "extensions/EXT_meshopt_compression/fallback").value_or(false);
}

Result<std::vector<BufferBytes>> read_buffers(
    const json& document, const std::string& scene_path,
    std::optional<std::span<const std::byte>> binary_chunk) {
    std::vector<BufferBytes> buffers;
    const json& sources = array_at(document, "buffers");
    for (size_t i = 0; i < sources.size(); ++i) {
        const bool is_first = i == 0;
        auto bytes = read_buffer(sources[i], scene_path, is_first ? binary_chunk : std::nullopt);
        if (!bytes) return in_element(bytes.error(), "buffers", i, "");
        buffers.push_back(std::move(*bytes));
    }
    return buffers;
}

}  // namespace tetralight::detail
