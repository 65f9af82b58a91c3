// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_document.h>

#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <string_view>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/glb_container.h>
#include <tetralight/bake/scene/detail/gltf_check.h>
#include <tetralight/bake/scene/detail/gltf_model.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/gltf_uri.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

bool pretend_file_exists(const std::string&, void*) {
    return true;  // reading the file gives the system's reason if it is missing
}

std::string keep_path(const std::string& path, void*) {
    return path;
}

/// Reads the file of a buffer. `failure` is a `std::optional<Error>` that takes the reason.
bool read_buffer_file(std::vector<unsigned char>* out, std::string*, const std::string& path,
                      void* failure) {
    const auto bytes = read_file(path);
    if (!bytes) {
        *static_cast<std::optional<Error>*>(failure) = bytes.error();
        return false;
    }
    const auto* first = reinterpret_cast<const unsigned char*>(bytes->data());
    out->assign(first, first + bytes->size());
    return true;
}

/// Keeps the encoded bytes of a data URI. Images in buffer views are read through the view.
bool keep_encoded_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                        const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

/// A message of tinygltf, which may have several lines and hold a whole data URI, as one short
/// line.
std::string one_line(std::string message) {
    constexpr size_t kMaxLength = 200;
    while (!message.empty() && message.back() == '\n') message.pop_back();
    for (char& c : message) {
        if (c == '\n') c = ' ';
    }
    return message.size() <= kMaxLength ? message : message.substr(0, kMaxLength) + "...";
}

Result<tinygltf::Model> parse_model(Bytes bytes, const std::string& folder) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keep_encoded_image, nullptr);
    parser.SetStoreOriginalJSONForExtrasAndExtensions(true);  // its values lack empty objects
    std::optional<Error> failure;
    parser.SetFsCallbacks({pretend_file_exists, keep_path, read_buffer_file, nullptr, &failure});
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const auto* first = reinterpret_cast<const unsigned char*>(bytes.data());
    const auto size = static_cast<unsigned>(bytes.size());
    const bool is_parsed =
        is_glb(bytes)
            ? parser.LoadBinaryFromMemory(&model, &error, &warning, first, size, folder)
            : parser.LoadASCIIFromString(&model, &error, &warning,
                                         reinterpret_cast<const char*>(first), size, folder);
    // tinygltf also reports errors of a model that it parsed: in parts that are not read, and that
    // check_gltf_json() does not check (a skin without matrices, for example).
    if (is_parsed) return model;
    // The parser appends buffers one by one, so that the next one is the one it could not read.
    if (failure) {
        failure->value.clear();  // the path, where the file has a URI
        return in_element(in_member(*failure, ".uri"), "buffers", model.buffers.size(), "");
    }
    return Error{ErrorCode::Corrupt, one_line(error.empty() ? "cannot parse glTF" : error)};
}

Result<GltfDocument> parse_document(Bytes bytes, const std::string& path) {
    if (bytes.size() > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::Unsupported,
                     str_cat(bytes.size(), " bytes are too many for a glTF file")};
    }
    const auto container = is_glb(bytes) ? GltfContainer::Glb : GltfContainer::Gltf;
    const auto chunk = container == GltfContainer::Glb ? glb_json(bytes) : Result<Bytes>(bytes);
    if (!chunk) return chunk.error();
    const std::string_view json_text(reinterpret_cast<const char*>(chunk->data()), chunk->size());
    const auto status = check_gltf_json(json_text, container);
    if (!status) return status.error();
    auto model = parse_model(bytes, folder_of(path));
    if (!model) return model.error();
    return document_from(std::move(*model), path);
}

}  // namespace

Result<GltfDocument> read_gltf_document(const std::string& path) {
    const auto bytes = read_file(path);
    if (!bytes) return bytes.error();
    try {
        auto document = parse_document(*bytes, path);
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
