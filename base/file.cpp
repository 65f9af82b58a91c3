// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/file.h>

#include <cstring>
#include <new>
#include <utility>

#include <tetralight/base/detail/file_system.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr std::align_val_t kCopyAlignment{64};

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path) {
    return detail::read_whole_file(path);
}

Result<MappedFile> MappedFile::open(const std::string& path) {
    const auto bytes = detail::map_file(path);
    if (!bytes) return bytes.error();
    return MappedFile(*bytes);
}

Result<MappedFile> MappedFile::copy_of(std::span<const std::byte> bytes) {
    MappedFile copy;
    if (bytes.empty()) return copy;
    auto* memory =
        static_cast<std::byte*>(::operator new(bytes.size(), kCopyAlignment, std::nothrow));
    if (!memory) {
        return Error{ErrorCode::OutOfResources,
                     str_cat("no memory for a copy of ", bytes.size(), " bytes")};
    }
    std::memcpy(memory, bytes.data(), bytes.size());
    copy.bytes_ = {memory, bytes.size()};
    copy.is_copy_ = true;
    return copy;
}

void MappedFile::release_pages() const noexcept {
    if (!bytes_.empty() && !is_copy_) detail::release_mapped_pages(bytes_);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : bytes_(std::exchange(other.bytes_, {})), is_copy_(std::exchange(other.is_copy_, false)) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(is_copy_, other.is_copy_);
    return *this;
}

MappedFile::~MappedFile() {
    if (bytes_.empty()) return;
    if (is_copy_) {
        ::operator delete(const_cast<std::byte*>(bytes_.data()), kCopyAlignment);
    } else {
        detail::unmap_file(bytes_);
    }
}

}  // namespace tetralight
