// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/session.h>

#include <poll.h>

#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>

namespace tetralight::server {

Clock::duration to_duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

Session::Session(std::atomic<uint32_t>& all, tcp::socket socket)
    : count(all), stream(std::move(socket)), timer_(stream.get_executor()) {
    buffer.reserve(kReadSize);  // else the first reads are of 512 bytes
    ++count;
    error_code error;
    const auto endpoint = stream.socket().remote_endpoint(error);
    if (!error) remote = endpoint.address().to_string();
}

void Session::arm(double seconds) {
    is_late = false;
    stream.expires_never();
    due_ = Clock::now() + to_duration(seconds);
    if (!is_watched_ || timer_.expiry() > due_) watch();
}

void Session::watch() {
    is_watched_ = true;
    timer_.expires_at(due_);
    timer_.async_wait([weak = weak_from_this()](const error_code& error) {
        const auto self = weak.lock();
        if (error || !self) return;  // another wait took its place, or the session is over
        self->is_watched_ = false;
        if (self->due_ == Clock::time_point::max()) return;
        if (Clock::now() < self->due_) return self->watch();
        self->is_late = true;
        self->stream.cancel();
    });
}

bool Session::is_abandoned() {
    pollfd end{stream.socket().native_handle(), POLLRDHUP, 0};
    return ::poll(&end, 1, 0) != 0;
}

net::awaitable<void> Session::linger() {
    constexpr size_t kMost = size_t{8} << 20;
    constexpr auto kLongest = std::chrono::seconds(2);
    error_code error;
    stream.socket().shutdown(tcp::socket::shutdown_send, error);
    const auto end = Clock::now() + kLongest;
    buffer.consume(buffer.size());
    for (size_t total = 0; !error && total < kMost && Clock::now() < end;) {
        stream.expires_at(end);
        const auto target = buffer.prepare(kReadSize);
        total +=
            co_await stream.async_read_some(target, net::redirect_error(net::use_awaitable, error));
    }
    stream.close();
}

}  // namespace tetralight::server
