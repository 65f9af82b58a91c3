// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // missing in Asio

#include <atomic>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <chrono>
#include <cstddef>
#include <list>
#include <memory>
#include <string>

namespace tetralight::server {

namespace net = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;
using net::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr size_t kReadSize = size_t{64} << 10;
/// The part of a body that must pass within the time limit of the settings.
constexpr size_t kSliceSize = size_t{64} << 10;

[[nodiscard]] Clock::duration to_duration(double seconds);

/// One connection. Everything but `is_idle`, `idle_since` and `place` is used on the strand of its
/// stream only.
struct Session : std::enable_shared_from_this<Session> {
    /// Counts itself in `all` while it lives.
    Session(std::atomic<uint32_t>& all, tcp::socket socket);

    ~Session() { --count; }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Cancels the stream's wait after this time, until `disarm`. The stream's own expiry would
    /// close it, so that the client could not be answered.
    void arm(double seconds);

    void disarm() { due_ = Clock::time_point::max(); }

    /// True if the client has closed its end.
    [[nodiscard]] bool is_abandoned();

    /// Waits until a request begins, after an empty line that may precede it (RFC 9112, section
    /// 2.2). Returns false if none comes in this time.
    net::awaitable<bool> wait_for_request(double seconds);

    /// Closes the connection at once if it waits for a request. Any thread may call it.
    void close_if_idle();

    /// Closes the connection after the sent bytes have arrived, even if the client still sends.
    net::awaitable<void> linger();

    std::atomic<uint32_t>& count;
    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    std::string remote;
    bool is_late = false;  ///< the time of the last `arm` has passed
    std::atomic<bool> is_idle = true;
    std::atomic<Clock::time_point> idle_since = Clock::now();
    std::list<std::weak_ptr<Session>>::iterator place;  ///< in the list of sessions

  private:
    /// One wait serves many requests: it is renewed only if it ends early.
    void watch();

    net::steady_timer timer_;
    Clock::time_point due_ = Clock::time_point::max();
    bool is_watched_ = false;
};

}  // namespace tetralight::server
