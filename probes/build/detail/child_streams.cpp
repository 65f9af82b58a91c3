// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/child_streams.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

Error system_error(const std::string& what) {
    return {str_cat("cannot ", what, " (", std::strerror(errno), ")")};
}

Descriptor::Descriptor(int descriptor) : descriptor_(descriptor) {
    if (descriptor < 0 || descriptor > STDERR_FILENO) return;
    descriptor_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    ::close(descriptor);
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

Descriptor::~Descriptor() {
    close();
}

void Descriptor::close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

Result<Descriptor> make_memory_file(std::span<const std::span<const std::byte>> parts) {
    Descriptor file(::memfd_create("stdin", MFD_CLOEXEC));
    if (!file) return system_error("make a file in memory");
    for (auto part : parts) {
        while (!part.empty()) {
            const ssize_t written = ::write(file.value(), part.data(), part.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) return system_error("write a file in memory");
            part = part.subspan(static_cast<size_t>(written));
        }
    }
    ::lseek(file.value(), 0, SEEK_SET);
    return file;
}

Status OutputPipe::open() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return system_error("make a pipe");
    read_end_ = Descriptor(ends[0]);
    write_end_ = Descriptor(ends[1]);
    if (!read_end_ || !write_end_) return system_error("make a pipe");
    ::fcntl(read_end_.value(), F_SETFL, O_NONBLOCK);
    return Ok{};
}

bool OutputPipe::read(std::vector<std::byte>& bytes) {
    if (has_ended()) return false;
    std::array<std::byte, 1 << 16> buffer;
    const ssize_t count = ::read(read_end_.value(), buffer.data(), buffer.size());
    if (count > 0) bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + count);
    if (count == 0) read_end_.close();
    return count > 0;
}

}  // namespace tetralight::detail
