// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_parts.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string_view>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_animation.h>
#include <tetralight/bake/scene/detail/gltf_references.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/bake/scene/glb_container.h>
#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr uint32_t kVertexTarget = 34962, kIndexTarget = 34963;

/// Compressions of buffer views, whose plain bytes are at hand.
constexpr const char* kViewCompressions[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// The type of an encoded image by its first bytes; empty if it is not known.
std::string image_type(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x89PNG")) return "image/png";
    if (text.starts_with("\xff\xd8\xff")) return "image/jpeg";
    if (text.starts_with("\xabKTX 20")) return "image/ktx2";
    if (text.starts_with("RIFF") &&
        text.substr(std::min<size_t>(8, text.size())).starts_with("WEBP"))
        return "image/webp";
    return "";
}

/// True if some element below this value has the extension.
bool has_extension(const GltfJson& value, const char* name) {
    if (value.is_object()) {
        const auto extensions = value.find("extensions");
        if (extensions != value.end() && extensions->is_object() && extensions->contains(name))
            return true;
    }
    if (!value.is_structured()) return false;
    return std::ranges::any_of(value,
                               [&](const GltfJson& child) { return has_extension(child, name); });
}

void erase_extension(GltfJson& element, const char* name) {
    const auto extensions = element.find("extensions");
    if (extensions == element.end()) return;
    extensions->erase(name);
    if (extensions->empty()) element.erase("extensions");
}

/// Removes a name from a list of names, and the list if nothing is left.
void erase_name(GltfJson& root, const char* list, const char* name) {
    const auto names = root.find(list);
    if (names == root.end()) return;
    GltfJson kept = GltfJson::array();
    for (const GltfJson& other : *names) {
        if (other != name) kept.push_back(other);
    }
    if (kept.empty()) {
        root.erase(list);
    } else {
        *names = kept;
    }
}

Result<GltfJson> read_json(const std::string& path) {
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    std::span<const std::byte> text = *bytes;
    if (is_glb(text)) {
        const auto chunks = glb_chunks(text);
        if (!chunks) return chunks.error().in(path);
        text = chunks->json;
    }
    const auto* first = reinterpret_cast<const char*>(text.data());
    auto root = GltfJson::parse(first, first + text.size(), nullptr, false);
    if (root.is_object()) return root;
    return Error{ErrorCode::Corrupt, path + ": is not a JSON object"};
}

/// Vertices with padding, so that each starts at a multiple of four bytes.
std::vector<std::byte> padded_elements(const RawElements& elements, size_t stride) {
    std::vector<std::byte> bytes(elements.count * stride);
    for (size_t i = 0; i < elements.count; ++i) {
        std::memcpy(&bytes[i * stride], &elements.bytes[i * elements.element_size],
                    elements.element_size);
    }
    return bytes;
}

}  // namespace

Result<GltfParts> GltfParts::open(const GltfDocument& document) {
    GltfParts parts;
    auto file = read_json(document.path);
    if (!file) return file.error();
    parts.json = std::move(*file);
    if (parts.json.contains("accessors")) parts.source_accessors = parts.json["accessors"];
    // Views behind those of the file have what its compressed primitives decode to.
    const size_t view_count = parts.json.value("bufferViews", GltfJson::array()).size();
    for (size_t i = 0; i < view_count; ++i) {
        const GltfBufferView& view = document.buffer_views[i];
        const auto bytes = std::as_bytes(std::span(document.buffers[view.buffer]))
                               .subspan(view.byte_offset, view.byte_length);
        parts.views_.emplace_back(bytes.begin(), bytes.end());
    }
    if (parts.json.contains("bufferViews")) {
        for (GltfJson& view : parts.json["bufferViews"]) {
            for (const char* name : kViewCompressions) erase_extension(view, name);
        }
    }
    if (auto status = parts.embed_images(document.path); !status)
        return status.error().in(document.path);
    return parts;
}

Status GltfParts::embed_images(const std::string& path) {
    if (!json.contains("images")) return Ok{};
    for (size_t i = 0; i < json["images"].size(); ++i) {
        const std::string uri = json["images"][i].value("uri", "");
        if (uri.empty() || is_data_uri(uri)) continue;
        const auto file = path_from_uri(uri, path);
        if (!file) return in_element(file.error(), "images", i, "");
        auto bytes = read_file(*file);
        if (!bytes) return in_element(in_member(bytes.error(), ".uri"), "images", i, "");
        GltfJson& image = json["images"][i];
        const std::string type = image.value("mimeType", image_type(*bytes));
        if (type.empty()) {
            return in_element({ErrorCode::Unsupported, ".uri", uri,
                               str_cat("\"", uri, "\" is not PNG, JPEG, KTX 2.0 or WebP")},
                              "images", i, "");
        }
        image["mimeType"] = type;
        image.erase("uri");
        const uint32_t view = add_view(std::move(*bytes));
        json["images"][i]["bufferView"] = view;
    }
    return Ok{};
}

void GltfParts::release_primitives(const std::set<GltfPrimitivePlace>& places) {
    const std::set<uint32_t> kept = used_accessors(json, places);
    for (const uint32_t accessor : primitive_accessors(json, places)) {
        if (!kept.contains(accessor)) free_accessors_.push_back(accessor);
    }
    const std::set<uint32_t> gone(free_accessors_.begin(), free_accessors_.end());
    const std::set<uint32_t> kept_views = used_views(json, gone);
    for (const uint32_t view : accessor_views(json, gone)) {
        if (!kept_views.contains(view)) free_views_.push_back(view);
    }
    std::ranges::reverse(free_accessors_);
    std::ranges::reverse(free_views_);
    for (const uint32_t view : free_views_) {
        views_[view].clear();
        json["bufferViews"][view] = GltfJson::object();
    }
}

uint32_t GltfParts::add(const char* array, GltfJson element) {
    json[array].push_back(std::move(element));
    return static_cast<uint32_t>(json[array].size() - 1);
}

uint32_t GltfParts::add_view(std::vector<std::byte> bytes, GltfJson members) {
    if (free_views_.empty()) {
        views_.push_back(std::move(bytes));
        return add("bufferViews", std::move(members));
    }
    const uint32_t view = free_views_.back();
    free_views_.pop_back();
    views_[view] = std::move(bytes);
    json["bufferViews"][view] = std::move(members);
    return view;
}

uint32_t GltfParts::add_accessor(GltfJson accessor, const RawElements& elements, View use) {
    GltfJson view = GltfJson::object();
    view["target"] = use == View::Vertices ? kVertexTarget : kIndexTarget;
    const size_t stride = (elements.element_size + 3) / 4 * 4;
    const bool is_padded = use == View::Vertices && stride != elements.element_size;
    if (is_padded) view["byteStride"] = stride;
    for (const char* member : {"byteOffset", "sparse"}) accessor.erase(member);
    accessor["bufferView"] =
        add_view(is_padded ? padded_elements(elements, stride) : elements.bytes, view);
    accessor["componentType"] = elements.component_type;
    accessor["count"] = elements.count;
    if (accessor.contains("min") || accessor.contains("max")) {
        const RawBounds bounds = raw_bounds(elements);
        accessor["min"] = bounds.min;
        accessor["max"] = bounds.max;
    }
    if (free_accessors_.empty()) return add("accessors", std::move(accessor));
    const uint32_t index = free_accessors_.back();
    free_accessors_.pop_back();
    json["accessors"][index] = std::move(accessor);
    return index;
}

void GltfParts::use_extension(const char* name) {
    GltfJson& used = json["extensionsUsed"];
    if (std::ranges::find(used, name) == used.end()) used.push_back(name);
}

void GltfParts::drop_unused_extension(const char* name) {
    if (has_extension(json, name)) return;
    erase_name(json, "extensionsUsed", name);
    erase_name(json, "extensionsRequired", name);
}

Result<std::vector<std::byte>> GltfParts::glb() {
    std::vector<std::byte> binary;
    for (size_t i = 0; i < views_.size(); ++i) {
        if (views_[i].empty()) views_[i].resize(4);  // released, and not taken again
        GltfJson& view = json["bufferViews"][i];
        view["buffer"] = 0;
        view["byteOffset"] = binary.size();
        view["byteLength"] = views_[i].size();
        binary.insert(binary.end(), views_[i].begin(), views_[i].end());
        binary.resize((binary.size() + 3) / 4 * 4);
    }
    json.erase("buffers");
    if (!binary.empty()) json["buffers"] = GltfJson::array({{{"byteLength", binary.size()}}});
    for (const char* name : kViewCompressions) drop_unused_extension(name);
    return make_glb(json.dump(), binary);
}

Result<std::vector<std::byte>> rewrite_gltf(const std::string& path, const SceneReading& reading,
                                            const WriteGlb& write) {
    const auto document = read_posed_document(path, reading);
    if (!document) return document.error();
    try {
        auto bytes = write(*document);
        if (!bytes) return bytes.error().in(path);
        return bytes;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const nlohmann::json::exception& exception) {
        return Error{ErrorCode::Corrupt,
                     str_cat(path, ": is not glTF (", json_error_reason(exception), ")")};
    }
}

}  // namespace tetralight::detail
