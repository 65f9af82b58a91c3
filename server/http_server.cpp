// SPDX-License-Identifier: Apache-2.0
// The only file that includes Boost.
#include "server/http_server.h"

#include <fcntl.h>
#include <poll.h>

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
/// So much of a body has to come, or go, in the time of the settings.
constexpr size_t kSliceSize = size_t{64} << 10;
/// In logs: there was nobody to answer.
constexpr unsigned kAbandoned = 499;

Clock::duration to_duration(double seconds) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), to_lower);
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
          acceptor_(net::make_strand(io_)),
          drain_timer_(acceptor_.get_executor()),
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
        net::co_spawn(acceptor_.get_executor(), accept(), net::detached);
        const uint32_t all = std::max(1u, std::thread::hardware_concurrency());
        const uint32_t count = settings_.thread_count == 0 ? all : settings_.thread_count;
        std::vector<std::thread> threads;
        for (uint32_t i = 1; i < count; ++i) threads.emplace_back([this] { io_.run(); });
        io_.run();
        for (std::thread& thread : threads) thread.join();
    }

    void stop() override;

    /// What became of an answer.
    struct Sent {
        uint64_t bytes = 0;  ///< of its body
        bool is_whole = false;
    };

    net::awaitable<void> accept();
    net::awaitable<void> refuse(std::shared_ptr<Session> session);
    net::awaitable<void> serve(std::shared_ptr<Session> session);
    net::awaitable<bool> serve_one(Session& session);
    net::awaitable<bool> read_body(Session& session, Parser& parser, const Plan& plan,
                                   Request& request, std::optional<Problem>& refused);
    net::awaitable<Response> answer(Session& session, Plan& plan, Request& request);
    net::awaitable<Sent> send(Session& session, const Request& request, const Response& response,
                              bool keeps_open);
    net::awaitable<bool> send_events(Session& session, const Response& response);
    net::awaitable<void> linger(Session& session);
    void end_idle_sessions();

    [[nodiscard]] bool is_ending() const { return is_ending_; }

    const Settings settings_;
    const Application application_;
    net::io_context io_;
    tcp::acceptor acceptor_;
    net::steady_timer drain_timer_;
    net::thread_pool workers_;
    std::atomic<uint32_t> waiting_count_ = 0;
    std::atomic<uint32_t> connection_count_ = 0;
    std::atomic<uint32_t> refused_count_ = 0;  ///< connections beyond those, being told so
    std::atomic<bool> is_draining_ = false;    ///< each connection has one more answer
    std::atomic<bool> is_ending_ = false;      ///< and now none
    std::atomic<bool> is_over_ = false;        ///< nobody waits for workers
    std::mutex sessions_mutex_;                ///< of the sessions and the timer
    std::list<std::weak_ptr<Session>> sessions_;
};

/// One connection.
struct Session : std::enable_shared_from_this<Session> {
    Session(std::atomic<uint32_t>& all, tcp::socket socket)
        : count(all), stream(std::move(socket)), timer(stream.get_executor()) {
        buffer.reserve(kReadSize);  // else the first reads are of 512 bytes
        ++count;
        error_code error;
        const auto endpoint = stream.socket().remote_endpoint(error);
        if (!error) remote = endpoint.address().to_string();
    }

    ~Session() { --count; }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Cancels what the stream waits for when time is up, until `disarm`. The stream's own expiry
    /// closes it, so that nobody can be told.
    void arm(double seconds) {
        is_late = false;
        stream.expires_never();
        due = Clock::now() + to_duration(seconds);
        if (!is_watched || timer.expiry() > due) watch();
    }

    void disarm() { due = Clock::time_point::max(); }

    /// One wait outlasts many requests: it is only moved when it ends before its time.
    void watch() {
        is_watched = true;
        timer.expires_at(due);
        timer.async_wait([weak = weak_from_this()](const error_code& error) {
            const auto self = weak.lock();
            if (error || !self) return;  // another wait took its place, or the session is over
            self->is_watched = false;
            if (self->due == Clock::time_point::max()) return;
            if (Clock::now() < self->due) return self->watch();
            self->is_late = true;
            self->stream.cancel();
        });
    }

    /// Whether the client has closed its end.
    [[nodiscard]] bool is_abandoned() {
        pollfd end{stream.socket().native_handle(), POLLRDHUP, 0};
        return ::poll(&end, 1, 0) != 0;
    }

    std::atomic<uint32_t>& count;
    beast::tcp_stream stream;
    net::steady_timer timer;
    Clock::time_point due = Clock::time_point::max();
    bool is_watched = false;
    bool is_late = false;
    beast::flat_buffer buffer;
    std::string remote;
    std::atomic<bool> is_idle = true;
    std::list<std::weak_ptr<Session>>::iterator place;
};

bool is_http_error(const error_code& error) {
    return error.category() == http::make_error_code(http::error::bad_method).category();
}

/// What the client sent, as far as it can be shown.
std::string beginning(const beast::flat_buffer& buffer) {
    constexpr size_t kMost = 40;
    const auto bytes = buffer.data();
    const std::string_view all(static_cast<const char*>(bytes.data()), bytes.size());
    return std::string(all.substr(0, std::min(all.find('\r'), kMost)));
}

/// Why a head could not be read; nothing: there is nobody to tell.
std::optional<Problem> problem_of_head(const Settings& settings, const Session& session,
                                       const error_code& error) {
    if (error == http::error::header_limit) {
        return Problem{431, "header_too_large", "the request's head is too large", "head",
                       text("more than ", settings.max_header_bytes, " bytes")};
    }
    if (session.is_late) {
        return Problem{408, "too_slow",
                       text("the request's head did not come in ", settings.header_seconds, " s"),
                       "head", beginning(session.buffer)};
    }
    if (error == http::error::end_of_stream || error == http::error::partial_message ||
        !is_http_error(error)) {
        return std::nullopt;
    }
    return Problem{400, "malformed_request", "is no HTTP/1.1: " + error.message(), "head",
                   beginning(session.buffer)};
}

/// The head as a plain value, and what is wrong with it.
std::optional<Problem> read_head(const Parser& parser, Request& request) {
    constexpr size_t kLongest = 200;
    constexpr unsigned kHttp11 = 11;
    const auto& message = parser.get();
    request.method = std::string(message.method_string());
    for (const auto& field : message) {
        request.headers.emplace_back(
            lower({field.name_string().data(), field.name_string().size()}),
            std::string(field.value()));
    }
    const std::string_view id = request.header("x-request-id");
    if (is_request_id(id)) request.id = id;
    const auto host_count = message.count(http::field::host);
    if (host_count > 1 || (host_count == 0 && message.version() >= kHttp11)) {
        return Problem{400, "malformed_request", "HTTP/1.1 needs one Host header", "host",
                       std::string(request.header("host").substr(0, kLongest))};
    }
    const auto target = message.target();
    if (parse_target({target.data(), target.size()}, request)) return std::nullopt;
    return Problem{400, "malformed_request", "the target is no path", "target",
                   std::string(target.substr(0, kLongest))};
}

void Server::stop() {
    net::post(acceptor_.get_executor(), [this] {
        if (is_draining_.exchange(true)) return;
        const std::lock_guard lock(sessions_mutex_);
        drain_timer_.expires_after(to_duration(settings_.drain_notice_seconds));
        drain_timer_.async_wait([this](const error_code&) { end_idle_sessions(); });
    });
}

void Server::end_idle_sessions() {
    error_code ignored;
    acceptor_.close(ignored);
    const std::lock_guard lock(sessions_mutex_);
    is_ending_ = true;
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
        if (error) return;
        is_over_ = true;
        io_.stop();
    });
}

net::awaitable<void> Server::accept() {
    constexpr uint32_t kMostRefused = 256;
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
        socket.set_option(tcp::no_delay(true), error);
        const auto executor = socket.get_executor();
        if (connection_count_ >= settings_.max_connections) {
            if (refused_count_ >= kMostRefused) continue;
            auto session = std::make_shared<Session>(refused_count_, std::move(socket));
            net::co_spawn(executor, refuse(std::move(session)), net::detached);
            continue;
        }
        auto session = std::make_shared<Session>(connection_count_, std::move(socket));
        {
            const std::lock_guard lock(sessions_mutex_);
            session->place = sessions_.insert(sessions_.end(), session);
        }
        net::co_spawn(executor, serve(std::move(session)), net::detached);
    }
}

/// Tells a client that there are too many.
net::awaitable<void> Server::refuse(std::shared_ptr<Session> session) {
    Request request;
    request.id = make_request_id();
    request.remote = session->remote;
    const Response response =
        application_.refusal({503, "too_many_connections",
                              text("there are ", settings_.max_connections, " connections already"),
                              "connections", std::to_string(settings_.max_connections)},
                             request);
    const auto sent = co_await send(*session, request, response, false);
    application_.answered({request, "", response.status, sent.bytes, 0.0, !sent.is_whole});
    co_await linger(*session);
}

net::awaitable<void> Server::serve(std::shared_ptr<Session> session) {
    bool keeps_open = true;
    while (keeps_open && !is_ending_) {
        if (session->buffer.size() == 0) {
            error_code error;
            session->stream.expires_after(to_duration(settings_.idle_seconds));
            const size_t count = co_await session->stream.async_read_some(
                session->buffer.prepare(kReadSize), net::redirect_error(net::use_awaitable, error));
            if (error) break;
            session->buffer.commit(count);
        }
        session->is_idle = false;
        keeps_open = co_await serve_one(*session);
        session->is_idle = true;
    }
    co_await linger(*session);
    const std::lock_guard lock(sessions_mutex_);
    sessions_.erase(session->place);
    if (is_ending_ && sessions_.empty()) drain_timer_.cancel();
}

/// From the first bytes of a request to the last of its answer. False: nothing can follow.
net::awaitable<bool> Server::serve_one(Session& session) {
    const auto start = Clock::now();
    error_code error;
    Parser parser;
    parser.header_limit(settings_.max_header_bytes);
    parser.body_limit(std::numeric_limits<uint64_t>::max());  // each route has its own
    session.arm(settings_.header_seconds);
    co_await http::async_read_header(session.stream, session.buffer, parser,
                                     net::redirect_error(net::use_awaitable, error));
    session.disarm();
    Request request;
    request.id = make_request_id();
    request.remote = session.remote;
    std::optional<Problem> refused =
        error ? problem_of_head(settings_, session, error) : read_head(parser, request);
    if (error && !refused) co_return false;
    Plan plan;
    const auto finish = [&](unsigned status, const Sent& sent) {
        const std::chrono::duration<double> seconds = Clock::now() - start;
        application_.answered(
            {request, plan.route, status, sent.bytes, seconds.count(), !sent.is_whole});
    };
    if (!refused) {
        plan = application_.plan(request);
        const bool is_whole = co_await read_body(session, parser, plan, request, refused);
        if (!is_whole && !refused) {
            finish(kAbandoned, {});
            co_return false;
        }
    }
    // No co_await within larger expressions: GCC 12 destroys their temporaries twice.
    Response response;
    if (refused) {
        response = application_.refusal(*refused, request);
    } else {
        response = co_await answer(session, plan, request);
    }
    // What is left of a body that was not read cannot be told from the next request.
    const bool keeps_open =
        !refused && !is_draining_ && parser.get().keep_alive() && parser.is_done();
    const Sent sent = co_await send(session, request, response, keeps_open);
    finish(response.status, sent);
    co_return keeps_open&& sent.is_whole;
}

/// False with a refusal, or without one when the client is gone.
net::awaitable<bool> Server::read_body(Session& session, Parser& parser, const Plan& plan,
                                       Request& request, std::optional<Problem>& refused) {
    if (plan.ignores_body) co_return true;
    const auto too_large = [&](const std::string& size) {
        refused =
            Problem{413, "too_large", text("the body is larger than ", plan.body_limit, " bytes"),
                    "body", size};
        return false;
    };
    const auto length = parser.content_length();
    if (length && *length > plan.body_limit) co_return too_large(text(*length, " bytes"));
    parser.body_limit(plan.body_limit);  // for chunks
    beast::tcp_stream& stream = session.stream;
    error_code error;
    if (lower(request.header("expect")) == "100-continue") {
        constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
        co_await net::async_write(stream, net::buffer(kContinue.data(), kContinue.size()),
                                  net::redirect_error(net::use_awaitable, error));
    }
    const bool is_to_file = plan.body_to == Plan::BodyTo::File;
    std::string& body = request.body;
    while (!error && !parser.is_done()) {
        // Memory for what came, not for what was announced.
        const size_t begin = is_to_file ? 0 : body.size();
        const size_t room =
            length ? std::min<uint64_t>(kSliceSize, *length - request.body_size) : kSliceSize;
        body.resize(begin + room);
        auto& target = parser.get().body();
        target.data = body.data() + begin;
        target.size = room;
        session.arm(settings_.transfer_seconds);
        co_await http::async_read(stream, session.buffer, parser,
                                  net::redirect_error(net::use_awaitable, error));
        session.disarm();
        if (error == http::error::need_buffer) error = {};
        const size_t count = room - parser.get().body().size;
        request.body_size += count;
        body.resize(begin + count);
        if (is_to_file &&
            ::write(request.body_file.value(), body.data(), count) != static_cast<ssize_t>(count)) {
            refused = Problem{507, "disk_full", "the body could not be stored", "body",
                              text(request.body_size, " bytes")};
            co_return false;
        }
    }
    if (is_to_file) body.clear();
    const std::string came = text(request.body_size, " bytes");
    if (error == http::error::body_limit) co_return too_large("more than " + came);
    if (session.is_late) {
        refused = Problem{408, "too_slow",
                          text("no 64 KiB of the body came in ", settings_.transfer_seconds, " s"),
                          "body", came};
    } else if (is_http_error(error) && error != http::error::partial_message &&
               error != http::error::end_of_stream) {
        refused = Problem{400, "malformed_request", "the body: " + error.message(), "body", came};
    }
    co_return !error;
}

/// Runs the handler where the plan says.
net::awaitable<Response> Server::answer(Session& session, Plan& plan, Request& request) {
    // Long enough to keep others on this thread waiting.
    constexpr size_t kLongBody = size_t{1} << 20;
    constexpr auto kLook = std::chrono::milliseconds(200);
    if (plan.run_on == Plan::RunOn::Network && request.body.size() < kLongBody) {
        co_return plan.handle(request);
    }
    if (waiting_count_ >= settings_.max_waiting) {
        co_return application_.refusal(
            {503, "busy", text(settings_.max_waiting, " requests wait already"), "requests",
             std::to_string(settings_.max_waiting)},
            request);
    }
    ++waiting_count_;
    const auto executor = co_await net::this_coro::executor;
    net::steady_timer done(executor);
    std::optional<Response> response;
    net::post(workers_, [&] {
        if (is_over_) return;
        Response made =
            request.is_abandoned
                ? application_.refusal({kAbandoned, "abandoned", "nobody waits"}, request)
                : plan.handle(request);
        net::post(executor, [&response, &done, made = std::move(made)]() mutable {
            response = std::move(made);
            done.cancel();
        });
    });
    while (!response) {
        done.expires_after(kLook);
        error_code ignored;
        co_await done.async_wait(net::redirect_error(net::use_awaitable, ignored));
        if (session.is_abandoned()) request.is_abandoned = true;
    }
    --waiting_count_;
    co_return std::move(*response);
}

/// The text before the body.
std::string head_of(const Request& request, const Response& response, bool keeps_open) {
    std::string head =
        text("HTTP/1.1 ", response.status, " ", reason_phrase(response.status), "\r\n");
    if (!response.content_type.empty()) append_header(head, "Content-Type", response.content_type);
    append_header(head, "X-Request-Id", request.id);
    for (const auto& [name, value] : response.headers) append_header(head, name, value);
    if (response.events) {
        head += "Transfer-Encoding: chunked\r\n";
    } else if (response.status != 204 && response.status != 304) {
        append_header(head, "Content-Length", std::to_string(response.body.bytes.size()));
    }
    append_header(head, "Connection", keeps_open ? "keep-alive" : "close");
    return head + "\r\n";
}

net::awaitable<Server::Sent> Server::send(Session& session, const Request& request,
                                          const Response& response, bool keeps_open) {
    const std::string head = head_of(request, response, keeps_open);
    const bool has_body = request.method != "HEAD" && !response.events;
    auto rest = has_body ? response.body.bytes : std::span<const std::byte>();
    size_t head_size = head.size();
    Sent sent;
    error_code error;
    do {
        const auto slice = rest.first(std::min(rest.size(), kSliceSize));
        const std::array<net::const_buffer, 2> parts{net::buffer(head.data(), head_size),
                                                     net::buffer(slice.data(), slice.size())};
        session.stream.expires_after(to_duration(settings_.transfer_seconds));
        const size_t count = co_await net::async_write(
            session.stream, parts, net::redirect_error(net::use_awaitable, error));
        sent.bytes += count - std::min(count, head_size);
        rest = rest.subspan(slice.size());
        head_size = 0;
    } while (!error && !rest.empty());
    sent.is_whole = !error;
    if (sent.is_whole && response.events && request.method != "HEAD") {
        sent.is_whole = co_await send_events(session, response);
    }
    co_return sent;
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
