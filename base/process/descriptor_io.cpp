// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/descriptor_io.h>

#include <unistd.h>

#include <cerrno>

namespace tetralight {

std::optional<size_t> read_up_to(const Descriptor& file, std::span<std::byte> memory) {
    size_t done = 0;
    while (done < memory.size()) {
        const ssize_t count = ::read(file.value(), memory.data() + done, memory.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return std::nullopt;
        if (count == 0) break;
        done += static_cast<size_t>(count);
    }
    return done;
}

bool write_all(const Descriptor& file, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.value(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

std::string path_of_descriptor(const Descriptor& file) {
    return "/proc/self/fd/" + std::to_string(file.value());
}

}  // namespace tetralight
