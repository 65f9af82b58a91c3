// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/reserve.h>

#include <fcntl.h>
#include <unistd.h>

#include <tetralight/base/process/descriptor.h>

namespace tetralight::server {

void keep_reserve(const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    if (!file) return;
    constexpr off_t kMost = off_t{8} << 20;
    constexpr off_t kStep = off_t{256} << 10;
    for (off_t bytes = kMost; bytes > 0; bytes -= kStep) {
        if (::posix_fallocate(file.value(), 0, bytes) == 0) return;
    }
}

void drop_reserve(const std::string& path) {
    ::unlink(path.c_str());
}

}  // namespace tetralight::server
