// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_check.h>

#include <algorithm>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_buffers.h>
#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_extension_table.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/gltf_sky.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

/// True for an extension of images that are not read, if each texture that has one has another
/// image, which is read.
bool has_other_images(const json& document, const std::string& extension) {
    if (extension != "EXT_texture_avif" && extension != "MSFT_texture_dds") return false;
    const json* textures = find_json(document, "textures");
    if (textures == nullptr) return true;
    return std::ranges::all_of(*textures, [&](const json& texture) {
        return find_json(texture, "extensions/" + extension) == nullptr ||
               find_json(texture, "source") != nullptr ||
               find_json(texture, "extensions/EXT_texture_webp/source") != nullptr;
    });
}

/// True if a file may require the extension.
bool is_supported(const json& document, const json& extension) {
    if (!extension.is_string()) return false;
    const auto& name = extension.get_ref<const std::string&>();
    const GltfExtension* known = find_gltf_extension(name);
    if (known == nullptr) return false;
    return known->may_be_required || has_other_images(document, name);
}

Error unsupported_extension(const json& extension) {
    std::string message =
        str_cat("required extension ", shown_json(extension), " is not supported");
    const GltfExtension* known = extension.is_string()
                                     ? find_gltf_extension(extension.get_ref<const std::string&>())
                                     : nullptr;
    if (known != nullptr && !known->remedy.empty()) message += str_cat("; ", known->remedy);
    return {ErrorCode::Unsupported, "extensionsRequired", shown_json(extension), message};
}

uint64_t size_or(const json& element, const char* key, uint64_t otherwise) {
    const auto value = element.find(key);
    return value == element.end() ? otherwise : value->get<uint64_t>();
}

/// A version that a file needs at least.
Status check_least_version(const json& document) {
    const json* version = find_json(document, "asset/minVersion");
    if (version == nullptr) return Ok{};
    if (!version->is_string())
        return in_member(wrong_type(*version, "asset.minVersion", "a string"), "");
    const auto& text = version->get_ref<const std::string&>();
    if (text == "2.0" || text.starts_with("1.") || text.starts_with("0.")) return Ok{};
    return Error{ErrorCode::Unsupported, "asset.minVersion", shown_json(*version),
                 str_cat("asset.minVersion ", shown_json(*version),
                         " is not supported (2.0 is); export the file as glTF 2.0")};
}

Status check_version(const json& document) {
    const json* version = find_json(document, "asset/version");
    if (version == nullptr) {
        return Error{ErrorCode::Corrupt, "asset.version", "", "asset.version is missing"};
    }
    if (!version->is_string())
        return in_member(wrong_type(*version, "asset.version", "a string"), "");
    const auto& text = version->get_ref<const std::string&>();
    if (text.starts_with("2.")) return check_least_version(document);
    const char* remedy =
        text.starts_with("1.") ? "; `gltf-pipeline -i IN.gltf -o OUT.glb` makes it glTF 2.0" : "";
    return Error{
        ErrorCode::Unsupported, "asset.version", shown_json(*version),
        str_cat("asset.version ", shown_json(*version), " is not supported (2.x is)", remedy)};
}

/// A list of names of extensions.
Status check_extension_names(const json& document, const char* member) {
    const json* names = find_json(document, member);
    if (names == nullptr) return Ok{};
    const auto is_name = [](const json& name) { return name.is_string(); };
    if (names->is_array() && std::ranges::all_of(*names, is_name)) return Ok{};
    return in_member(wrong_type(*names, member, "a list of names"), "");
}

Status check_required_extensions(const json& document) {
    for (const char* member : {"extensionsUsed", "extensionsRequired"}) {
        if (auto status = check_extension_names(document, member); !status) return status;
    }
    const json* required = find_json(document, "extensionsRequired");
    if (required == nullptr) return Ok{};
    for (const json& extension : *required) {
        if (is_supported(document, extension)) continue;
        return unsupported_extension(extension);
    }
    return Ok{};
}

Status check_default_scene(const json& document) {
    const json* scene = find_json(document, "scene");
    if (scene == nullptr) return Ok{};
    const json* scenes = find_json(document, "scenes");
    const size_t count = scenes == nullptr ? 0 : scenes->size();
    if (scene->is_number_unsigned() && scene->get<uint64_t>() < count) return Ok{};
    return Error{ErrorCode::Corrupt, "scene", shown_json(*scene),
                 str_cat("scene ", shown_json(*scene), " is out of range (", count, " scenes)")};
}

Status check_uri(const json& element) {
    const json* uri = find_json(element, "uri");
    if (uri == nullptr || is_data_uri(uri->get_ref<const std::string&>())) return Ok{};
    const auto path = relative_path_from_uri(uri->get_ref<const std::string&>());
    if (!path) return path.error();
    return Ok{};
}

/// Returns corrupt with the member `key` of an element as its field.
Error element_error(const char* section, size_t index, const char* key, std::string value,
                    const std::string& message) {
    const Error error{ErrorCode::Corrupt, str_cat(".", key), std::move(value), message};
    return in_element(error, section, index, "");
}

Status check_buffers(const json& document, GltfContainer container) {
    const json* buffers = find_json(document, "buffers");
    if (buffers == nullptr) return Ok{};
    for (size_t i = 0; i < buffers->size(); ++i) {
        const json& buffer = (*buffers)[i];
        const bool is_embedded = container == GltfContainer::Glb && i == 0;
        if (!buffer.contains("uri") && !is_embedded && !is_fallback_buffer(buffer)) {
            return element_error("buffers", i, "uri", "", "has no uri");
        }
        if (buffer["byteLength"] == 0) {
            return element_error("buffers", i, "byteLength", "0", "byteLength is 0");
        }
        const auto uri = check_uri(buffer);
        if (!uri) return in_element(uri.error(), "buffers", i, "");
    }
    return Ok{};
}

Status check_image_uris(const json& document) {
    const json* images = find_json(document, "images");
    if (images == nullptr) return Ok{};
    for (size_t i = 0; i < images->size(); ++i) {
        const auto uri = check_uri((*images)[i]);
        if (!uri) return in_element(uri.error(), "images", i, "");
    }
    return Ok{};
}

/// Where EXT_meshopt_compression has the bytes of a buffer view. Views without it may not lie in
/// buffers without bytes.
Status check_compressed_view(const json& document, size_t i) {
    const json& view = document["bufferViews"][i];
    const json* meshopt = find_json(view, "extensions/EXT_meshopt_compression");
    const json& place = meshopt == nullptr ? view : *meshopt;
    const auto buffer = place["buffer"].get<size_t>();
    const json& source = document["buffers"][buffer];
    const char* member =
        meshopt == nullptr ? "buffer" : "extensions.EXT_meshopt_compression.byteLength";
    if (is_fallback_buffer(source)) {
        return element_error("bufferViews", i, member, str_cat(buffer),
                             str_cat("buffer ", buffer,
                                     " has no bytes: it is a fallback of EXT_meshopt_compression"));
    }
    if (meshopt == nullptr) return Ok{};
    const uint64_t end = size_or(place, "byteOffset", 0) + size_or(place, "byteLength", 0);
    const uint64_t size = size_or(source, "byteLength", 0);
    if (end <= size) return Ok{};
    return element_error("bufferViews", i, member, str_cat(size_or(place, "byteLength", 0)),
                         str_cat("EXT_meshopt_compression: its bytes end at ", end,
                                 ", outside of buffer ", buffer, " (", size, " bytes)"));
}

Status check_buffer_views(const json& document) {
    const json* views = find_json(document, "bufferViews");
    if (views == nullptr) return Ok{};
    for (size_t i = 0; i < views->size(); ++i) {
        const json& view = (*views)[i];
        const auto buffer = view["buffer"].get<size_t>();
        const uint64_t buffer_length = document["buffers"][buffer]["byteLength"].get<uint64_t>();
        const uint64_t offset = size_or(view, "byteOffset", 0);
        const uint64_t length = size_or(view, "byteLength", 0);
        if (length == 0) {
            return element_error("bufferViews", i, "byteLength", "0", "byteLength is 0");
        }
        if (offset + length > buffer_length) {  // both < 2^32
            return element_error(
                "bufferViews", i, "byteLength", str_cat(length),
                str_cat("bytes ", offset, " to ", offset + length, " are outside of buffer ",
                        buffer, " (", buffer_length, " bytes)"));
        }
        if (auto status = check_compressed_view(document, i); !status) return status;
    }
    return Ok{};
}

/// A node has a matrix or else a translation, rotation and scale.
Status check_node_transforms(const json& document) {
    const json* nodes = find_json(document, "nodes");
    if (nodes == nullptr) return Ok{};
    for (size_t i = 0; i < nodes->size(); ++i) {
        const json& node = (*nodes)[i];
        if (!node.contains("matrix")) continue;
        for (const char* part : {"translation", "rotation", "scale"}) {
            if (!node.contains(part)) continue;
            const json* name = find_json(node, "name");
            return in_element({ErrorCode::Corrupt, ".matrix", "",
                               str_cat("has a matrix beside a ", part,
                                       "; glTF allows one of them, so remove the other")},
                              "nodes", i, name == nullptr ? "" : name->get<std::string>());
        }
    }
    return Ok{};
}

/// The samplers of the channels of animations.
Status check_animations(const json& document) {
    const json* animations = find_json(document, "animations");
    if (animations == nullptr) return Ok{};
    for (size_t i = 0; i < animations->size(); ++i) {
        const json& animation = (*animations)[i];
        const size_t count = animation["samplers"].size();
        for (size_t c = 0; c < animation["channels"].size(); ++c) {
            const auto sampler = animation["channels"][c]["sampler"].get<size_t>();
            if (sampler < count) continue;
            return element_error("animations", i, str_cat("channels[", c, "].sampler").c_str(),
                                 str_cat(sampler),
                                 str_cat("channel ", c, ": sampler ", sampler, " is out of range (",
                                         count, " samplers)"));
        }
    }
    return Ok{};
}

Status check_document(const json& document, GltfContainer container) {
    if (!document.is_object()) return Error{ErrorCode::Corrupt, "is not a JSON object"};
    if (const auto status = check_version(document); !status) return status;
    if (const auto status = check_required_extensions(document); !status) return status;
    if (const auto status = check_gltf_sections(document); !status) return status;
    if (const auto status = check_default_scene(document); !status) return status;
    if (const auto status = check_buffers(document, container); !status) return status;
    if (const auto status = check_image_uris(document); !status) return status;
    if (const auto status = check_node_transforms(document); !status) return status;
    if (const auto status = check_animations(document); !status) return status;
    return check_buffer_views(document);
}

/// Refuses what does not begin as an object, by what it begins with: an empty file, a page of HTML,
/// a pointer of Git LFS.
Status check_beginning(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos)
        return Error{ErrorCode::Corrupt, "is not glTF: it is empty"};
    if (text[first] == '{') return Ok{};
    constexpr size_t kShown = 24;
    return Error{ErrorCode::Corrupt, str_cat("is not glTF: it begins with \"",
                                             quoted_value(text.substr(first, kShown)), "\"")};
}

}  // namespace

Result<json> parse_gltf_json(std::string_view json_text, GltfContainer container) {
    if (auto status = check_beginning(json_text); !status) return status.error();
    if (auto status = check_json_shape(json_text); !status) return status.error();
    try {
        json document = json::parse(json_text);
        if (auto status = expand_skies(document); !status) return status.error();
        if (auto status = check_document(document, container); !status) return status.error();
        return document;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Corrupt,
                     str_cat("is not glTF (", json_error_reason(exception), ")")};
    }
}

}  // namespace tetralight::detail
