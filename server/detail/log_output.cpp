// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/log_output.h>

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace tetralight::server {

LogOutput::LogOutput() {
    struct stat facts = {};
    if (::fstat(STDERR_FILENO, &facts) != 0) return;
    if (S_ISSOCK(facts.st_mode)) way_ = Way::Socket;
    if (!S_ISFIFO(facts.st_mode) && !S_ISCHR(facts.st_mode)) return;
    own_ = Descriptor(
        ::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_APPEND | O_CLOEXEC));
    way_ = own_ ? Way::Reopened : Way::Polled;
}

size_t LogOutput::write(std::string_view text) {
    size_t written = 0;
    while (written < text.size()) {
        const std::string_view rest = text.substr(written);
        ssize_t count = 0;
        if (way_ == Way::Socket) {
            count = ::send(STDERR_FILENO, rest.data(), rest.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        } else if (way_ == Way::Polled) {
            // A pipe that is ready takes this many bytes at once.
            pollfd ready{STDERR_FILENO, POLLOUT, 0};
            if (::poll(&ready, 1, 0) == 0) break;
            count = ::write(STDERR_FILENO, rest.data(), std::min<size_t>(rest.size(), PIPE_BUF));
        } else {
            count = ::write(own_ ? own_.value() : STDERR_FILENO, rest.data(), rest.size());
        }
        if (count < 0 && errno == EINTR) continue;
        if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOBUFS)) break;
        if (count <= 0) return text.size();
        written += static_cast<size_t>(count);
    }
    return written;
}

}  // namespace tetralight::server
