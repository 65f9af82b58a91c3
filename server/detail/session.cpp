// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/session.h>

#include <poll.h>

#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <string_view>

namespace tetralight::server {
namespace {

std::string_view text_of(const beast::flat_buffer& buffer) {
    const auto bytes = buffer.data();
    return {static_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

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

net::awaitable<bool> Session::wait_for_request(double seconds) {
    constexpr std::string_view kEmptyLine = "\r\n";
    for (bool may_skip = true; true;) {
        if (may_skip && text_of(buffer).starts_with(kEmptyLine)) {
            buffer.consume(kEmptyLine.size());
            may_skip = false;
        }
        const std::string_view text = text_of(buffer);
        if (!text.empty() && !(may_skip && text == "\r")) co_return true;
        error_code error;
        stream.expires_after(to_duration(seconds));
        const auto target = buffer.prepare(kReadSize - buffer.size());
        const size_t received =
            co_await stream.async_read_some(target, net::redirect_error(net::use_awaitable, error));
        if (error) co_return false;
        buffer.commit(received);
    }
}

void Session::close_if_idle() {
    net::post(stream.get_executor(), [self = shared_from_this()] {
        if (self->is_idle) self->stream.close();
    });
}

net::awaitable<void> Session::linger() {
    constexpr size_t kMost = size_t{8} << 20;
    constexpr auto kLongest = std::chrono::seconds(2);
    error_code error;
    if (!stream.socket().is_open()) co_return;
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
