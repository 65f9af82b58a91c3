// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/system_error.h>
#include <tetralight/cli/byte_reader.h>

#include <fcntl.h>
#include <poll.h>

namespace tetralight::cli {

Result<ByteReader> ByteReader::open(const std::string& path) {
    const bool is_stdin = path == "-";
    ByteReader reader(is_stdin ? "stdin" : path,
                      Descriptor(is_stdin ? ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)
                                          : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)));
    if (!reader.file_) return system_error(reader.name_, "open");
    return reader;
}

/// Also true at the end of the file and for errors, which read() then returns.
bool ByteReader::has_input(int timeout_milliseconds) const {
    pollfd query{file_.value(), POLLIN, 0};
    return ::poll(&query, 1, timeout_milliseconds) != 0;
}

Result<size_t> ByteReader::read(std::span<char> memory) {
    if (before_wait_ && !has_input(0)) {
        if (auto status = before_wait_(); !status) return status.error();
    }
    while (true) {
        const ssize_t count = ::read(file_.value(), memory.data(), memory.size());
        if (count >= 0) return static_cast<size_t>(count);
        if (errno == EAGAIN) {  // another program made the pipe or terminal non-blocking
            constexpr int kForever = -1;
            (void)has_input(kForever);
        } else if (errno != EINTR) {
            return system_error(name_, "read");
        }
    }
}

}  // namespace tetralight::cli
