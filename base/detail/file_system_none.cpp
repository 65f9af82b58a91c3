// SPDX-License-Identifier: Apache-2.0
// For platforms without files, for example WebAssembly.
#include <tetralight/base/detail/file_system.h>
#include <tetralight/base/shown_path.h>

namespace tetralight::detail {
namespace {

Error unsupported(const std::string& path, const char* why) {
    return {ErrorCode::Unsupported, "", path, shown_path(path) + why};
}

Error cannot_read(const std::string& path) {
    return unsupported(path, ": this build reads no files; use open_memory");
}

}  // namespace

Result<std::vector<std::byte>> read_whole_file(const std::string& path) {
    return cannot_read(path);
}

Result<std::span<const std::byte>> map_file(const std::string& path) {
    return cannot_read(path);
}

void unmap_file(std::span<const std::byte>) noexcept {}

void release_mapped_pages(std::span<const std::byte>) noexcept {}

Result<std::string> follow_file_links(const std::string& path) {
    return path;
}

Result<std::unique_ptr<NewFile>> open_new_file(const std::string& path) {
    return unsupported(path, ": this build writes no files");
}

}  // namespace tetralight::detail
