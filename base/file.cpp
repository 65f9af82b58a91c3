// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/file.h>

#include <utility>

#include <tetralight/base/detail/file_system.h>

namespace tetralight {

Result<std::vector<std::byte>> read_file(const std::string& path) {
    return detail::read_whole_file(path);
}

Result<MappedFile> MappedFile::open(const std::string& path) {
    const auto bytes = detail::map_file(path);
    if (!bytes) return bytes.error();
    return MappedFile(*bytes);
}

void MappedFile::release_pages() const noexcept {
    if (!bytes_.empty()) detail::release_mapped_pages(bytes_);
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) detail::unmap_file(bytes_);
}

}  // namespace tetralight
