// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/beast_baseline.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace tetralight::bench {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using net::ip::tcp;

class Session : public std::enable_shared_from_this<Session> {
  public:
    Session(tcp::socket socket, const PlainHandler& handler)
        : stream_(std::move(socket)), handler_(handler) {
        buffer_.reserve(size_t{64} << 10);
    }

    void read() {
        parser_.emplace();
        parser_->body_limit(uint64_t{64} << 20);
        stream_.expires_after(std::chrono::seconds(30));
        http::async_read(stream_, buffer_, *parser_,
                         [self = shared_from_this()](const error_code& error, size_t) {
                             if (!error) self->write();
                         });
    }

  private:
    using View = boost::beast::span<const char>;

    void write() {
        response_ = {};
        response_.version(11);
        response_.set(http::field::content_type, "application/octet-stream");
        response_.keep_alive(true);
        answer_ = handler_(parser_->get().body());
        response_.body() = View(answer_.bytes.get(), answer_.size);
        response_.prepare_payload();
        http::async_write(stream_, response_,
                          [self = shared_from_this()](const error_code& error, size_t) {
                              if (!error) self->read();
                          });
    }

    beast::tcp_stream stream_;
    beast::flat_buffer buffer_;
    std::optional<http::request_parser<http::string_body>> parser_;
    http::response<http::span_body<const char>> response_;
    PlainAnswer answer_;
    const PlainHandler& handler_;
};

void accept(tcp::acceptor& acceptor, net::io_context& io, const PlainHandler& handler) {
    acceptor.async_accept(net::make_strand(io), [&](const error_code& error, tcp::socket socket) {
        if (!error) {
            socket.set_option(tcp::no_delay(true));
            std::make_shared<Session>(std::move(socket), handler)->read();
        }
        accept(acceptor, io, handler);
    });
}

}  // namespace

void serve_plainly(const PlainHandler& handler,
                   const std::function<void(uint16_t port)>& is_listening) {
    net::io_context io;
    tcp::acceptor acceptor(io, tcp::endpoint(net::ip::address_v4::loopback(), 0));
    is_listening(acceptor.local_endpoint().port());
    accept(acceptor, io, handler);
    std::vector<std::thread> threads;
    for (uint32_t i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
        threads.emplace_back([&] { io.run(); });
    }
    io.run();
    for (std::thread& thread : threads) thread.join();
}

PlainHandler same_answer(const std::string& text) {
    const std::shared_ptr<char[]> bytes(new char[text.size()]);
    text.copy(bytes.get(), text.size());
    return [answer = PlainAnswer{bytes, text.size()}](const std::string&) { return answer; };
}

}  // namespace tetralight::bench
