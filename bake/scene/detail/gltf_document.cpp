// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_document.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_buffers.h>
#include <tetralight/bake/scene/detail/gltf_check.h>
#include <tetralight/bake/scene/detail/gltf_draco.h>
#include <tetralight/bake/scene/detail/gltf_elements.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_memory.h>
#include <tetralight/bake/scene/detail/gltf_meshopt.h>
#include <tetralight/bake/scene/detail/gltf_names.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/gltf_unknown_extras.h>
#include <tetralight/bake/scene/detail/gltf_unknown_members.h>
#include <tetralight/bake/scene/detail/gltf_unread.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/bake/scene/glb_container.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

std::string scene_name(const json& scene) {
    return string_at(scene, "name");
}

/// The names of the scenes of a file, as a message lists them.
std::string scene_list(const json& scenes) {
    std::string list;
    for (size_t i = 0; i < scenes.size(); ++i) {
        if (i > 0) list += ", ";
        list += str_cat(i, " \"", scene_name(scenes[i]), "\"");
    }
    return list.empty() ? "none" : list;
}

/// The scene of this name, else the one whose index the text is.
Result<uint32_t> find_scene(const json& document, const std::string& text) {
    const json& scenes = array_at(document, "scenes");
    if (text.empty()) return static_cast<uint32_t>(size_at(document, "scene", 0));
    const auto named_count = std::ranges::count(scenes, text, scene_name);
    if (named_count > 1) {
        return Error{ErrorCode::InvalidArgument, "scene", quoted_value(text),
                     str_cat("has ", named_count, " scenes \"", quoted_value(text),
                             "\", which a number tells apart: it has ", scene_list(scenes))};
    }
    const auto named = std::ranges::find(scenes, text, scene_name);
    if (named != scenes.end()) return static_cast<uint32_t>(named - scenes.begin());
    uint32_t index = 0;
    const char* end = text.data() + text.size();
    const bool is_index = std::from_chars(text.data(), end, index).ptr == end;
    if (is_index && index < scenes.size()) return index;
    return Error{ErrorCode::InvalidArgument, "scene", quoted_value(text),
                 str_cat("has no scene \"", quoted_value(text), "\"; it has ", scene_list(scenes))};
}

/// Decodes the images in data URIs.
Status decode_image_uris(GltfDocument& document) {
    for (size_t i = 0; i < document.images.size(); ++i) {
        GltfImage& image = document.images[i];
        if (!is_data_uri(image.uri)) continue;
        auto bytes = decode_data_uri(image.uri);
        if (!bytes) return in_element(bytes.error(), "images", i, image.name);
        image.encoded = std::move(*bytes);
    }
    return Ok{};
}

Result<GltfDocument> parse_document(Bytes bytes, const std::string& path,
                                    const std::string& scene) {
    if (bytes.size() > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::Unsupported,
                     str_cat(bytes.size(), " bytes are too many for a glTF file")};
    }
    const auto container = is_glb(bytes) ? GltfContainer::Glb : GltfContainer::Gltf;
    const auto chunks = container == GltfContainer::Glb
                            ? glb_chunks(bytes)
                            : Result<GlbChunks>(GlbChunks{bytes, std::nullopt});
    if (!chunks) return chunks.error();
    const std::string_view json_text(reinterpret_cast<const char*>(chunks->json.data()),
                                     chunks->json.size());
    auto source = parse_gltf_json(json_text, container);
    if (!source) return source.error();
    const std::vector<ScenePart> changed_names = clean_names(*source);
    const auto chosen = find_scene(*source, scene);
    if (!chosen) return chosen.error();
    GltfDocument document = document_from(*source);
    document.path = path;
    for (const ScenePart& part : changed_names) document.warnings.push_back(part_warning(part));
    document.memory = geometry_memory(*source, document, bytes);
    if (auto status = check_reading_memory(document.memory); !status) return status.error();
    auto buffers = read_buffers(*source, path, chunks->binary);
    if (!buffers) return buffers.error();
    document.buffers = std::move(*buffers);
    choose_scene(*source, *chosen, document);
    if (auto status = decode_meshopt(document); !status) return status.error();
    if (auto status = decode_draco(document); !status) return status.error();
    PartList parts;
    parts.append(changed_names);
    add_unread_parts(*source, document, parts);
    add_unknown_extras(*source, parts);
    add_unknown_members(*source, parts);
    document.parts = parts.parts();
    if (auto status = decode_image_uris(document); !status) return status.error();
    return document;
}

}  // namespace

Result<GltfDocument> read_gltf_document(const std::string& path, const std::string& scene) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    try {
        auto document = parse_document(file->bytes(), path, scene);
        if (!document) return document.error().in(path);
        return document;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Corrupt,
                     str_cat(path, ": cannot parse glTF (", exception.what(), ")")};
    }
}

Error in_element(const Error& error, std::string_view section, size_t index,
                 const std::string& name) {
    for (const GltfSection& s : gltf_sections()) {
        if (section != s.name) continue;
        return in_member(error.in(gltf_place(s.element, index, name)),
                         str_cat(member_path(s.path), "[", index, "]"));
    }
    return error;
}

std::string gltf_place(const char* kind, size_t index, const std::string& name) {
    return name.empty() ? str_cat(kind, " ", index) : str_cat(kind, " ", index, " \"", name, "\"");
}

}  // namespace tetralight::detail
