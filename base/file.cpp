// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/file.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <utility>

#include <tetralight/base/descriptor_io.h>
#include <tetralight/base/shown_path.h>
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

void MappedFile::release_pages() const noexcept {
    // Pages of a private mapping that were never written are read from the file again.
    if (!bytes_.empty()) {
        (void)::madvise(const_cast<std::byte*>(bytes_.data()), bytes_.size(), MADV_DONTNEED);
    }
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace tetralight
