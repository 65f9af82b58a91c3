// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // which Asio forgets

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
/// So much of a body has to come, or go, in the time of the settings.
constexpr size_t kSliceSize = size_t{64} << 10;

[[nodiscard]] Clock::duration to_duration(double seconds);

/// One connection. All of it belongs to the strand of its stream, but for `is_idle` and `place`.
struct Session : std::enable_shared_from_this<Session> {
    /// Counts itself in `all` while it lives.
    Session(std::atomic<uint32_t>& all, tcp::socket socket);

    ~Session() { --count; }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Cancels what the stream waits for when time is up, until `disarm`. The stream's own expiry
    /// closes it, so that nobody can be told.
    void arm(double seconds);

    void disarm() { due_ = Clock::time_point::max(); }

    /// Whether the client has closed its end.
    [[nodiscard]] bool is_abandoned();

    /// Closes the connection so that what was sent arrives, even while the client still sends.
    net::awaitable<void> linger();

    std::atomic<uint32_t>& count;
    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    std::string remote;
    bool is_late = false;  ///< time was up since the last `arm`
    std::atomic<bool> is_idle = true;
    std::list<std::weak_ptr<Session>>::iterator place;  ///< in the list of all

  private:
    /// One wait outlasts many requests: it is only moved when it ends before its time.
    void watch();

    net::steady_timer timer_;
    Clock::time_point due_ = Clock::time_point::max();
    bool is_watched_ = false;
};

}  // namespace tetralight::server
