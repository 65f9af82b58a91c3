// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/http_server.h>

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <cstdio>
#include <list>
#include <mutex>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/detail/descriptors.h>
#include <tetralight/server/detail/read_request.h>
#include <tetralight/server/detail/send_response.h>
#include <tetralight/server/detail/session.h>
#include <tetralight/server/detail/workers.h>

namespace tetralight::server {
namespace {

/// Ids that differ from those of other runs of the server.
std::string make_request_id() {
    static const uint64_t kRun = std::random_device()();
    static std::atomic<uint64_t> count = 0;
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%08llx-%llx",
                  static_cast<unsigned long long>(kRun), static_cast<unsigned long long>(++count));
    return digits.data();
}

/// The state that all sessions share.
class Server final : public HttpServer {
  public:
    Server(const Settings& settings, Application application)
        : settings_(settings),
          application_(std::move(application)),
          acceptor_(net::make_strand(io_)),
          drain_timer_(acceptor_.get_executor()),
          workers_(settings_, application_) {}

    error_code open() {
        error_code error;
        const auto address = net::ip::make_address(settings_.address, error);
        if (error) return error;
        const tcp::endpoint endpoint(address, settings_.port);
        acceptor_.open(endpoint.protocol(), error);
        if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
        // Asio would wait for the next connection before it looks at those that wait already.
        const net::socket_base::enable_connection_aborted reports(true);
        if (!error) acceptor_.set_option(reports, error);
        if (!error) acceptor_.bind(endpoint, error);
        if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
        if (!error) ::fcntl(acceptor_.native_handle(), F_SETFD, FD_CLOEXEC);
        return error;
    }

    [[nodiscard]] uint16_t port() const override { return acceptor_.local_endpoint().port(); }

    [[nodiscard]] uint32_t connection_count() const override { return connection_count_; }

    [[nodiscard]] size_t waiting_count(Plan::RunOn place) const override {
        return workers_.waiting_count(place);
    }

    void run() override {
        net::co_spawn(acceptor_.get_executor(), accept(), net::detached);
        const uint32_t count = network_thread_count(settings_);
        std::vector<std::thread> threads;
        for (uint32_t i = 1; i < count; ++i) threads.emplace_back([this] { io_.run(); });
        io_.run();
        for (std::thread& thread : threads) thread.join();
    }

    void stop() override;

    net::awaitable<void> accept();
    net::awaitable<void> refuse(std::shared_ptr<Session> session);
    net::awaitable<void> serve(std::shared_ptr<Session> session);
    net::awaitable<bool> serve_one(Session& session);
    void end_idle_sessions();
    void close_idle_sessions();

    [[nodiscard]] SendRule send_rule(bool keeps_open) const {
        return {settings_.transfer_seconds, keeps_open, is_ending_};
    }

    const Settings settings_;
    const Application application_;
    net::io_context io_;
    tcp::acceptor acceptor_;
    net::steady_timer drain_timer_;
    std::atomic<uint32_t> connection_count_ = 0;
    std::atomic<uint32_t> refused_count_ = 0;  ///< connections beyond the limit, which get 503
    std::atomic<bool> is_draining_ = false;    ///< each connection gets one more answer
    std::atomic<bool> is_ending_ = false;      ///< no connection gets another answer
    std::mutex sessions_mutex_;                ///< guards the sessions and the timer
    std::list<std::weak_ptr<Session>> sessions_;
    Workers workers_;  ///< ends first: its work uses the sessions, which end with `io_`
};

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
        workers_.drop_results();
        io_.stop();
    });
}

/// Makes room for descriptors: closes the quarter of the idle connections that has waited longest,
/// each for a second at least.
void Server::close_idle_sessions() {
    constexpr size_t kShare = 4;
    constexpr auto kShortest = std::chrono::seconds(1);
    using Idle = std::pair<Clock::time_point, std::shared_ptr<Session>>;
    std::vector<Idle> idle;
    const auto latest = Clock::now() - kShortest;
    {
        const std::lock_guard lock(sessions_mutex_);
        for (const auto& weak : sessions_) {
            auto session = weak.lock();
            if (!session || !session->is_idle || session->idle_since.load() > latest) continue;
            idle.emplace_back(session->idle_since, std::move(session));
        }
    }
    std::ranges::sort(idle, {}, &Idle::first);
    idle.resize((idle.size() + kShare - 1) / kShare);
    for (const auto& [since, session] : idle) session->close_if_idle();
    application_.lacks_descriptors(idle.size());
}

net::awaitable<void> Server::accept() {
    constexpr uint32_t kMostRefused = 256;
    while (acceptor_.is_open()) {
        error_code error;
        tcp::socket socket(net::make_strand(io_));
        co_await acceptor_.async_accept(socket, net::redirect_error(net::use_awaitable, error));
        if (error == net::error::operation_aborted || !acceptor_.is_open()) break;
        if (error) {  // for example, no descriptor is left
            if (has_no_descriptor(error)) close_idle_sessions();
            net::steady_timer pause(io_, std::chrono::milliseconds(50));
            co_await pause.async_wait(net::redirect_error(net::use_awaitable, error));
            continue;
        }
        ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
        if (is_nearly_the_last(socket.native_handle())) close_idle_sessions();
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

/// Answers a connection beyond the limit with 503.
net::awaitable<void> Server::refuse(std::shared_ptr<Session> session) {
    Request request;
    request.id = make_request_id();
    request.remote = session->remote;
    const Response response = application_.refusal(
        {503, "too_many_connections",
         str_cat("there are ", settings_.max_connections, " connections already"), "connections",
         std::to_string(settings_.max_connections)},
        request);
    const auto sent = co_await send_response(*session, request, response, send_rule(false));
    application_.answered({request, "", response.status, sent.bytes, 0.0, {}, !sent.is_whole});
    co_await session->linger();
}

net::awaitable<void> Server::serve(std::shared_ptr<Session> session) {
    bool keeps_open = true;
    while (keeps_open && !is_ending_) {
        const bool has_begun = co_await session->wait_for_request(settings_.idle_seconds);
        if (!has_begun) break;
        session->is_idle = false;
        keeps_open = co_await serve_one(*session);
        session->idle_since = Clock::now();
        session->is_idle = true;
    }
    co_await session->linger();
    const std::lock_guard lock(sessions_mutex_);
    sessions_.erase(session->place);
    if (is_ending_ && sessions_.empty()) drain_timer_.cancel();
}

/// Reads one request and answers it. Returns false if the connection must be closed.
net::awaitable<bool> Server::serve_one(Session& session) {
    const auto start = Clock::now();
    Request request;
    request.id = make_request_id();
    request.remote = session.remote;
    Parser parser;
    Reading reading = co_await read_head(session, parser, settings_, request);
    if (!reading.is_whole && !reading.refused) co_return false;
    Plan plan;
    std::optional<double> waited;
    const auto finish = [&](unsigned status, const Sent& sent) {
        const std::chrono::duration<double> seconds = Clock::now() - start;
        application_.answered(
            {request, plan.route, status, sent.bytes, seconds.count(), waited, !sent.is_whole});
    };
    if (reading.is_whole) {
        plan = application_.plan(request);
        reading = co_await read_body(session, parser, settings_, plan, request);
        if (!reading.is_whole && !reading.refused) {
            finish(kAbandoned, {});
            co_return false;
        }
    }
    // No co_await within larger expressions: GCC 12 destroys their temporaries twice.
    Response response;
    if (reading.refused) {
        response = application_.refusal(*reading.refused, request);
    } else {
        response = co_await workers_.answer(session, plan, request, waited);
    }
    if (request.is_abandoned) {
        finish(kAbandoned, {});
        co_return false;
    }
    // The unread part of a body would be taken for the next request.
    const bool keeps_open =
        !reading.refused && !is_draining_ && parser.get().keep_alive() && parser.is_done();
    const Sent sent = co_await send_response(session, request, response, send_rule(keeps_open));
    finish(response.status, sent);
    co_return keeps_open&& sent.is_whole;
}

}  // namespace

Result<std::unique_ptr<HttpServer>> HttpServer::bind(const Settings& settings,
                                                     Application application) {
    auto server = std::make_unique<Server>(settings, std::move(application));
    if (const error_code error = server->open()) {
        const std::string listen = str_cat(settings.address, ":", settings.port);
        return Error{error_code_of_errno(error.value()), "listen", listen,
                     str_cat("cannot listen on ", listen, " (", error.message(), ")")};
    }
    return std::unique_ptr<HttpServer>(std::move(server));
}

}  // namespace tetralight::server
