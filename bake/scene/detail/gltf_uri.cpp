// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_uri.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

std::string percent_decoded(std::string_view uri) {
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned code = 0;
        const bool is_escape = uri[i] == '%' && i + 2 < uri.size();
        const char* digits = uri.data() + i + 1;
        if (is_escape && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            path += static_cast<char>(code);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

bool has_parent_step(std::string_view path) {
    while (!path.empty()) {
        const size_t length = std::min(path.find('/'), path.size());
        if (path.substr(0, length) == "..") return true;
        path.remove_prefix(std::min(length + 1, path.size()));
    }
    return false;
}

/// Folder of a file, to be joined with a name: "" or ends in '/'.
std::string folder_of(const std::string& path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

/// Both are paths without links.
bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
    return std::ranges::mismatch(folder, file).in1 == folder.end();
}

/// True if a file is read by way of a link from the scene's folder to another folder. Links to
/// files beside the file to which the scene is a link are how some build systems lay out folders.
bool is_link_outside(const std::string& path, const std::string& scene_path) {
    std::error_code error;
    const auto file = std::filesystem::canonical(path, error);
    if (error) return false;  // what opens the file says that there is none
    const std::string folder = folder_of(scene_path);
    const auto open_folder = std::filesystem::canonical(folder.empty() ? "." : folder, error);
    if (!error && is_below(file, open_folder)) return false;
    const auto scene = std::filesystem::canonical(scene_path, error);
    return error || !is_below(file, scene.parent_path());
}

}  // namespace

bool is_data_uri(std::string_view uri) {
    return uri.starts_with("data:");
}

Result<std::string> relative_path_from_uri(std::string_view uri) {
    std::string path = percent_decoded(uri);
    const bool is_plain = path.find_first_of(std::string_view(":\\\0", 3)) == std::string::npos;
    if (path.empty() || path.front() == '/' || !is_plain || has_parent_step(path)) {
        return Error{
            ErrorCode::Unsupported, ".uri", quoted_value(uri),
            str_cat("uri \"", quoted_value(uri), "\" is not a path below the scene's folder")};
    }
    return path;
}

Result<std::string> path_from_uri(std::string_view uri, const std::string& scene_path) {
    const auto relative = relative_path_from_uri(uri);
    if (!relative) return relative.error();
    std::string path = folder_of(scene_path) + *relative;
    if (is_link_outside(path, scene_path)) {
        return Error{ErrorCode::Unsupported, ".uri", quoted_value(uri),
                     str_cat("uri \"", quoted_value(uri),
                             "\" is a symbolic link to a file outside of the scene's folder")};
    }
    return path;
}

}  // namespace tetralight::detail
