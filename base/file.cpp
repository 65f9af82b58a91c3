// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace tetralight {
namespace {

Error system_error(const std::string& path, const char* what) {
    return {path + ": cannot " + what + " (" + std::strerror(errno) + ")"};
}

/// Owns a POSIX file descriptor.
class Descriptor {
  public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}

    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    ~Descriptor() { close(); }

    [[nodiscard]] int value() const { return descriptor_; }

    [[nodiscard]] explicit operator bool() const { return descriptor_ >= 0; }

    bool close() {
        const int descriptor = std::exchange(descriptor_, -1);
        return descriptor < 0 || ::close(descriptor) == 0;
    }

  private:
    int descriptor_;
};

/// Opens a regular file for reading; a folder or a device is an error, not a surprise later.
Result<size_t> regular_file_size(const Descriptor& file, const std::string& path) {
    if (!file) return system_error(path, "open");
    struct stat status = {};
    if (::fstat(file.value(), &status) != 0) return system_error(path, "read");
    if (!S_ISREG(status.st_mode)) return Error{path + ": is not a regular file"};
    return static_cast<size_t>(status.st_size);
}

bool write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

bool write_all(int descriptor, std::span<const std::span<const std::byte>> parts) {
    for (const auto part : parts) {
        if (!write_all(descriptor, part)) return false;
    }
    return true;
}

bool is_special_file(const std::string& path) {
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
           !S_ISDIR(status.st_mode);
}

Status write_in_place(const std::string& path, std::span<const std::span<const std::byte>> parts) {
    Descriptor file(path == "-" ? ::dup(STDOUT_FILENO)
                                : ::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file || !write_all(file.value(), parts) || !file.close()) {
        return system_error(path, "write");
    }
    return Ok{};
}

/// The permissions that a plain open() would have given a new file, or those of the old one.
mode_t final_mode(const std::string& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0) return status.st_mode & 07777;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

/// Follows a symbolic link, so that the link stays and its target is replaced.
std::string final_path(const std::string& path) {
    char* resolved = ::realpath(path.c_str(), nullptr);
    if (resolved == nullptr) return path;
    std::string result = resolved;
    std::free(resolved);
    return result;
}

}  // namespace

Result<std::vector<std::byte>> read_file(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto size = regular_file_size(file, path);
    if (!size) return size.error();
    std::vector<std::byte> bytes(*size);
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::read(file.value(), bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return system_error(path, "read");
        if (count == 0) break;
        done += static_cast<size_t>(count);
    }
    bytes.resize(done);
    return bytes;
}

Status write_file(const std::string& path, std::span<const std::span<const std::byte>> parts) {
    if (path == "-" || is_special_file(path)) return write_in_place(path, parts);
    const std::string target = final_path(path);
    std::string temporary = target + ".XXXXXX";
    Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
    if (!file) return system_error(path, "write");
    const bool is_written = write_all(file.value(), parts) &&
                            ::fchmod(file.value(), final_mode(target)) == 0 &&
                            ::fsync(file.value()) == 0 && file.close() &&
                            ::rename(temporary.c_str(), target.c_str()) == 0;
    if (is_written) return Ok{};
    const Error error = system_error(path, "write");
    ::unlink(temporary.c_str());
    return error;
}

Status write_file(const std::string& path, std::span<const std::byte> bytes) {
    return write_file(path, std::span(&bytes, 1));
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

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace tetralight
