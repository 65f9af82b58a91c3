// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/file.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cstring>
#include <new>
#include <utility>

#include <tetralight/base/descriptor_io.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>

namespace tetralight {
namespace {

/// Opens a regular file for reading; a folder or a device is an error, not a surprise later.
Result<size_t> regular_file_size(const Descriptor& file, const std::string& path) {
    if (!file) return system_error(path, "open");
    struct stat status = {};
    if (::fstat(file.value(), &status) != 0) return system_error(path, "read");
    if (!S_ISREG(status.st_mode)) {
        const char* what = S_ISDIR(status.st_mode) ? ": is a folder" : ": is not a regular file";
        return Error{ErrorCode::InvalidArgument, "", path, shown_path(path) + what};
    }
    return static_cast<size_t>(status.st_size);
}

constexpr std::align_val_t kCopyAlignment{64};

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto size = regular_file_size(file, path);
    if (!size) return size.error();
    std::vector<std::byte> bytes(*size);
    const auto count = read_up_to(file, bytes);
    if (!count) return system_error(path, "read");
    bytes.resize(*count);
    return bytes;
}

Result<MappedFile> MappedFile::open(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto size = regular_file_size(file, path);
    if (!size) return size.error();
    if (*size == 0) return MappedFile();
    void* address = ::mmap(nullptr, *size, PROT_READ, MAP_PRIVATE, file.value(), 0);
    if (address == MAP_FAILED) return system_error(path, "map");
    return MappedFile({static_cast<const std::byte*>(address), *size});
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
    // Pages of a private mapping that were never written are read from the file again.
    if (!bytes_.empty() && !is_copy_) {
        (void)::madvise(const_cast<std::byte*>(bytes_.data()), bytes_.size(), MADV_DONTNEED);
    }
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
    auto* memory = const_cast<std::byte*>(bytes_.data());
    if (is_copy_) {
        ::operator delete(memory, kCopyAlignment);
    } else {
        ::munmap(memory, bytes_.size());
    }
}

}  // namespace tetralight
