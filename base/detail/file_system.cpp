// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/detail/file_system.h>

#include <limits>

#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

std::string output_name(const std::string& path) {
    return path == "-" ? "stdout" : path;
}

Error not_a_regular_file(const std::string& path, bool is_folder) {
    const char* what = is_folder ? ": is a folder" : ": is not a regular file";
    return {ErrorCode::InvalidArgument, "", path, shown_path(path) + what};
}

Result<size_t> size_in_memory(const std::string& path, uint64_t size) {
    // A vector and a mapping hold half of the address space at most.
    if (size <= std::numeric_limits<size_t>::max() / 2) return static_cast<size_t>(size);
    return Error{ErrorCode::Unsupported, "", path,
                 str_cat(shown_path(path), ": has ", size,
                         " bytes, more than a 32-bit program has memory for")};
}

}  // namespace tetralight::detail
