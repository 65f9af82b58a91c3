// SPDX-License-Identifier: Apache-2.0
// The only file that includes Boost.
#include "server/http_server.h"

#include <fcntl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <chrono>
#include <limits>
#include <list>
#include <mutex>
#include <optional>
#include <random>
#include <thread>

#include "base/text.h"

namespace tetralight::server {
namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using boost::system::error_code;
using net::ip::tcp;
using Clock = std::chrono::steady_clock;
using Parser = http::request_parser<http::buffer_body>;

constexpr size_t kReadSize = size_t{64} << 10;

Clock::duration to_duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

bool is_request_id(std::string_view id) {
    constexpr size_t kLongest = 64;
    const auto is_plain = [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '-' || c == '_' || c == '.';
    };
    return !id.empty() && id.size() <= kLongest && std::ranges::all_of(id, is_plain);
}

/// Ids that no other run of the server gives.
std::string make_request_id() {
    static const uint64_t kRun = std::random_device()();
    static std::atomic<uint64_t> count = 0;
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%08llx-%llx",
                  static_cast<unsigned long long>(kRun), static_cast<unsigned long long>(++count));
    return digits.data();
}

void append_header(std::string& head, std::string_view name, std::string_view value) {
    head.append(name).append(": ");
    for (const char c : value) head += c == '\r' || c == '\n' ? ' ' : c;
    head += "\r\n";
}

struct Session;

/// What all sessions share.
class Server final : public HttpServer {
  public:
    Server(const Settings& settings, Application application)
        : settings_(settings),
          application_(std::move(application)),
          acceptor_(io_),
          drain_timer_(io_),
          workers_(settings.worker_count) {}

    ~Server() override { workers_.join(); }

    error_code open() {
        error_code error;
        const auto address = net::ip::make_address(settings_.address, error);
        if (error) return error;
        const tcp::endpoint endpoint(address, settings_.port);
        acceptor_.open(endpoint.protocol(), error);
        if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
        if (!error) acceptor_.bind(endpoint, error);
        if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
        if (!error) ::fcntl(acceptor_.native_handle(), F_SETFD, FD_CLOEXEC);
        return error;
    }

    [[nodiscard]] uint16_t port() const override { return acceptor_.local_endpoint().port(); }

    [[nodiscard]] uint32_t connection_count() const override { return connection_count_; }

    void run() override {
        net::co_spawn(io_, accept(), net::detached);
        const uint32_t all = std::max(1u, std::thread::hardware_concurrency());
        const uint32_t count = settings_.thread_count == 0 ? all : settings_.thread_count;
        std::vector<std::thread> threads;
        for (uint32_t i = 1; i < count; ++i) threads.emplace_back([this] { io_.run(); });
        io_.run();
        for (std::thread& thread : threads) thread.join();
    }

    void stop() override;

    net::awaitable<void> accept();
    net::awaitable<void> serve(std::shared_ptr<Session> session);
    net::awaitable<bool> read_body(Session& session, Parser& parser, const Plan& plan,
                                   Request& request, std::optional<Response>& refused);
    net::awaitable<Response> answer(Plan& plan, Request& request);
    net::awaitable<bool> send(Session& session, const Request& request, const Response& response,
                              bool keeps_open);
    net::awaitable<bool> send_events(Session& session, const Response& response);
    net::awaitable<void> linger(Session& session);

    [[nodiscard]] bool is_ending() const { return is_ending_; }

    const Settings settings_;
    const Application application_;
    net::io_context io_;
    tcp::acceptor acceptor_;
    net::steady_timer drain_timer_;
    net::thread_pool workers_;
    std::atomic<uint32_t> waiting_count_ = 0;
    std::atomic<uint32_t> connection_count_ = 0;
    std::atomic<bool> is_ending_ = false;
    std::mutex sessions_mutex_;  ///< of the sessions and the timer
    std::list<std::weak_ptr<Session>> sessions_;
};

/// One connection.
struct Session {
    Session(Server& owner, tcp::socket socket) : server(owner), stream(std::move(socket)) {
        buffer.reserve(kReadSize);  // else the first reads are of 512 bytes
        ++server.connection_count_;
    }

    ~Session() { --server.connection_count_; }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    Server& server;
    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    std::string remote;
    std::atomic<bool> is_idle = true;
    std::list<std::weak_ptr<Session>>::iterator place;
};

/// Why a head could not be read; nothing: there is nobody to tell.
std::optional<Response> refusal_of_head(const Application& application, const error_code& error) {
    if (error == http::error::header_limit) {
        return application.refusal(431, "header_too_large", "the request's headers are too large");
    }
    if (error == http::error::end_of_stream || error == beast::error::timeout ||
        error == http::error::partial_message ||
        error.category() == net::error::get_system_category()) {
        return std::nullopt;
    }
    if (error.category() == http::make_error_code(http::error::bad_method).category()) {
        return application.refusal(400, "malformed_request", "is no HTTP/1.1: " + error.message());
    }
    return std::nullopt;
}

/// The head as a plain value. False: its target is no path.
bool read_head(const Parser& parser, Session& session, Request& request) {
    const auto& message = parser.get();
    request.method = std::string(message.method_string());
    request.remote = session.remote;
    for (const auto& field : message) {
        request.headers.emplace_back(
            lower({field.name_string().data(), field.name_string().size()}),
            std::string(field.value()));
    }
    const std::string_view id = request.header("x-request-id");
    request.id = is_request_id(id) ? std::string(id) : make_request_id();
    const auto target = message.target();
    return parse_target({target.data(), target.size()}, request);
}

void Server::stop() {
    net::post(io_, [this] {
        if (is_ending_.exchange(true)) return;
        error_code ignored;
        acceptor_.close(ignored);
        const std::lock_guard lock(sessions_mutex_);
        for (const auto& weak : sessions_) {
            const auto session = weak.lock();
            if (!session) continue;
            net::post(session->stream.get_executor(), [session] {
                if (session->is_idle) session->stream.cancel();
            });
        }
        if (sessions_.empty()) return;
        drain_timer_.expires_after(to_duration(settings_.drain_seconds));
        drain_timer_.async_wait([this](const error_code& error) {
            if (!error) io_.stop();
        });
    });
}

net::awaitable<void> Server::accept() {
    while (acceptor_.is_open()) {
        error_code error;
        tcp::socket socket(net::make_strand(io_));
        co_await acceptor_.async_accept(socket, net::redirect_error(net::use_awaitable, error));
        if (error == net::error::operation_aborted || !acceptor_.is_open()) break;
        if (error) {  // no descriptor is left, for example
            net::steady_timer pause(io_, std::chrono::milliseconds(50));
            co_await pause.async_wait(net::redirect_error(net::use_awaitable, error));
            continue;
        }
        ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
        if (connection_count_ >= settings_.max_connections) {
            constexpr std::string_view kFull =
                "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 2\r\nConnection: close\r\n"
                "Content-Length: 0\r\n\r\n";
            ::send(socket.native_handle(), kFull.data(), kFull.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
            continue;
        }
        socket.set_option(tcp::no_delay(true), error);
        const auto executor = socket.get_executor();
        auto session = std::make_shared<Session>(*this, std::move(socket));
        {
            const std::lock_guard lock(sessions_mutex_);
            session->place = sessions_.insert(sessions_.end(), session);
        }
        net::co_spawn(executor, serve(std::move(session)), net::detached);
    }
}

net::awaitable<void> Server::serve(std::shared_ptr<Session> session) {
    beast::tcp_stream& stream = session->stream;
    error_code error;
    const auto endpoint = stream.socket().remote_endpoint(error);
    if (!error) session->remote = endpoint.address().to_string();
    bool keeps_open = true;
    while (keeps_open && !is_ending_) {
        error = {};
        if (session->buffer.size() == 0) {
            stream.expires_after(to_duration(settings_.idle_seconds));
            const size_t count = co_await stream.async_read_some(
                session->buffer.prepare(kReadSize), net::redirect_error(net::use_awaitable, error));
            if (error) break;
            session->buffer.commit(count);
        }
        session->is_idle = false;
        const auto start = Clock::now();
        Parser parser;
        parser.header_limit(settings_.max_header_bytes);
        parser.body_limit(std::numeric_limits<uint64_t>::max());  // each route has its own
        stream.expires_after(to_duration(settings_.header_seconds));
        co_await http::async_read_header(stream, session->buffer, parser,
                                         net::redirect_error(net::use_awaitable, error));
        Request request;
        std::optional<Response> refused;
        Plan plan;
        if (error) {
            refused = refusal_of_head(application_, error);
            if (!refused) break;
        } else if (!read_head(parser, *session, request)) {
            refused = application_.refusal(400, "malformed_request", "the target is no path");
        } else {
            plan = application_.plan(request);
            const bool is_whole = co_await read_body(*session, parser, plan, request, refused);
            if (!is_whole && !refused) break;
        }
        // What is left of a body that was not read cannot be told from the next request.
        keeps_open = !refused && !is_ending_ && parser.get().keep_alive() && parser.is_done();
        // No co_await within larger expressions: GCC 12 destroys their temporaries twice.
        Response response;
        if (refused) {
            response = std::move(*refused);
        } else {
            response = co_await answer(plan, request);
        }
        const bool is_sent = co_await send(*session, request, response, keeps_open);
        keeps_open = keeps_open && is_sent;
        const std::chrono::duration<double> seconds = Clock::now() - start;
        application_.answered(
            {request, plan.route, response.status, response.body.bytes.size(), seconds.count()});
        session->is_idle = true;
    }
    co_await linger(*session);
    const std::lock_guard lock(sessions_mutex_);
    sessions_.erase(session->place);
    if (is_ending_ && sessions_.empty()) drain_timer_.cancel();
}

/// False with a refusal, or without one when the client is gone.
net::awaitable<bool> Server::read_body(Session& session, Parser& parser, const Plan& plan,
                                       Request& request, std::optional<Response>& refused) {
    if (plan.ignores_body) co_return true;
    const auto too_large = [&] {
        refused = application_.refusal(413, "too_large",
                                       text("the body is larger than ", plan.body_limit, " bytes"));
        return false;
    };
    const auto length = parser.content_length();
    if (length && *length > plan.body_limit) co_return too_large();
    beast::tcp_stream& stream = session.stream;
    error_code error;
    if (request.header("expect") == "100-continue") {
        constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
        co_await net::async_write(stream, net::buffer(kContinue.data(), kContinue.size()),
                                  net::redirect_error(net::use_awaitable, error));
    }
    std::vector<char> piece(plan.body_to == Plan::BodyTo::File ? size_t{1} << 20 : 0);
    while (!error && !parser.is_done()) {
        std::string& body = request.body;
        const size_t begin = body.size();
        // One byte beyond the limit tells that it is too large.
        const uint64_t left = plan.body_limit - request.body_size + 1;
        auto& target = parser.get().body();
        if (piece.empty()) {
            // Memory for what came, not for what was announced.
            uint64_t room = std::min<uint64_t>(std::max(kReadSize, begin), left);
            if (length) room = std::min(room, *length - begin);
            body.resize(begin + room);
            target.data = body.data() + begin;
            target.size = room;
        } else {
            target.data = piece.data();
            target.size = std::min<uint64_t>(piece.size(), left);
        }
        const size_t asked = target.size;
        const double slices = 1.0 + static_cast<double>(asked) / static_cast<double>(kReadSize);
        stream.expires_after(to_duration(settings_.transfer_seconds * slices));
        co_await http::async_read(stream, session.buffer, parser,
                                  net::redirect_error(net::use_awaitable, error));
        if (error == http::error::need_buffer) error = {};
        const size_t count = asked - parser.get().body().size;
        request.body_size += count;
        if (request.body_size > plan.body_limit) co_return too_large();
        if (piece.empty()) {
            body.resize(begin + count);
        } else if (::write(request.body_file.value(), piece.data(), count) !=
                   static_cast<ssize_t>(count)) {
            refused = application_.refusal(507, "disk_full", "the body could not be stored");
            co_return false;
        }
    }
    if (error && error != beast::error::timeout && error != http::error::partial_message &&
        error.category() == http::make_error_code(http::error::bad_method).category()) {
        refused = application_.refusal(400, "malformed_request", "the body: " + error.message());
    }
    co_return !error;
}

/// Runs the handler where the plan says.
net::awaitable<Response> Server::answer(Plan& plan, Request& request) {
    // Long enough to keep others on this thread waiting.
    constexpr size_t kLongBody = size_t{1} << 20;
    if (plan.run_on == Plan::RunOn::Network && request.body.size() < kLongBody) {
        co_return plan.handle(request);
    }
    if (waiting_count_ >= settings_.max_waiting) {
        co_return application_.refusal(503, "busy", "too many requests wait already");
    }
    ++waiting_count_;
    const auto executor = co_await net::this_coro::executor;
    net::steady_timer done(executor, Clock::time_point::max());
    std::optional<Response> response;
    net::post(workers_, [&] {
        Response made = plan.handle(request);
        net::post(executor, [&response, &done, made = std::move(made)]() mutable {
            response = std::move(made);
            done.cancel();
        });
    });
    error_code ignored;
    co_await done.async_wait(net::redirect_error(net::use_awaitable, ignored));
    --waiting_count_;
    co_return std::move(*response);
}

net::awaitable<bool> Server::send(Session& session, const Request& request,
                                  const Response& response, bool keeps_open) {
    const size_t size = response.body.bytes.size();
    std::string head =
        text("HTTP/1.1 ", response.status, " ", reason_phrase(response.status), "\r\n");
    if (!response.content_type.empty()) append_header(head, "Content-Type", response.content_type);
    if (!request.id.empty()) append_header(head, "X-Request-Id", request.id);
    for (const auto& [name, value] : response.headers) append_header(head, name, value);
    if (response.events) {
        head += "Transfer-Encoding: chunked\r\n";
    } else if (response.status != 204 && response.status != 304) {
        append_header(head, "Content-Length", std::to_string(size));
    }
    append_header(head, "Connection", keeps_open ? "keep-alive" : "close");
    head += "\r\n";
    const bool has_body = request.method != "HEAD" && !response.events;
    const std::array<net::const_buffer, 2> parts{
        net::buffer(head), net::buffer(response.body.bytes.data(), has_body ? size : 0)};
    const double slices = 1.0 + static_cast<double>(size) / static_cast<double>(kReadSize);
    session.stream.expires_after(to_duration(settings_.transfer_seconds * slices));
    error_code error;
    co_await net::async_write(session.stream, parts,
                              net::redirect_error(net::use_awaitable, error));
    if (error || !response.events || request.method == "HEAD") co_return !error;
    co_return co_await send_events(session, response);
}

net::awaitable<bool> Server::send_events(Session& session, const Response& response) {
    constexpr auto kPause = std::chrono::milliseconds(100);
    constexpr auto kLongestSilence = std::chrono::seconds(15);
    const auto executor = co_await net::this_coro::executor;
    net::steady_timer timer(executor);
    auto last = Clock::now();
    error_code error;
    bool goes_on = true;
    while (goes_on && !error && !is_ending_) {
        std::string said;
        goes_on = response.events(said);
        if (said.empty() && Clock::now() - last > kLongestSilence) said = ":\n\n";
        if (!said.empty()) {
            std::array<char, 20> length{};
            std::snprintf(length.data(), length.size(), "%zx\r\n", said.size());
            said = length.data() + said + "\r\n";
            session.stream.expires_after(to_duration(settings_.transfer_seconds));
            co_await net::async_write(session.stream, net::buffer(said),
                                      net::redirect_error(net::use_awaitable, error));
            last = Clock::now();
        }
        if (!goes_on || error) break;
        timer.expires_after(kPause);
        error_code ignored;
        co_await timer.async_wait(net::redirect_error(net::use_awaitable, ignored));
    }
    constexpr std::string_view kEnd = "0\r\n\r\n";
    if (!error) {
        co_await net::async_write(session.stream, net::buffer(kEnd.data(), kEnd.size()),
                                  net::redirect_error(net::use_awaitable, error));
    }
    co_return !error;
}

/// Closes a connection so that what was sent arrives, even while the client still sends.
net::awaitable<void> Server::linger(Session& session) {
    constexpr size_t kMost = size_t{8} << 20;
    constexpr auto kLongest = std::chrono::seconds(2);
    error_code error;
    session.stream.socket().shutdown(tcp::socket::shutdown_send, error);
    const auto end = Clock::now() + kLongest;
    session.buffer.consume(session.buffer.size());
    for (size_t total = 0; !error && total < kMost && Clock::now() < end;) {
        session.stream.expires_at(end);
        const auto target = session.buffer.prepare(kReadSize);
        const size_t count = co_await session.stream.async_read_some(
            target, net::redirect_error(net::use_awaitable, error));
        total += count;
    }
    session.stream.close();
}

}  // namespace

Result<std::unique_ptr<HttpServer>> HttpServer::bind(const Settings& settings,
                                                     Application application) {
    auto server = std::make_unique<Server>(settings, std::move(application));
    if (const error_code error = server->open()) {
        return Error{text("cannot listen on ", settings.address, ":", settings.port, " (",
                          error.message(), ")")};
    }
    return std::unique_ptr<HttpServer>(std::move(server));
}

}  // namespace tetralight::server
