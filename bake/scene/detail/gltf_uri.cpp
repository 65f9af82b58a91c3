// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_uri.h>

#include <algorithm>
#include <charconv>

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

std::string folder_of(const std::string& path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

}  // namespace tetralight::detail
