// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/http_server.h>

#include <fcntl.h>

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
#include <tetralight/server/detail/read_request.h>
#include <tetralight/server/detail/send_response.h>
#include <tetralight/server/detail/session.h>
#include <tetralight/server/work_queue.h>

namespace tetralight::server {
namespace {

/// Status in logs: the client had disconnected.
constexpr unsigned kAbandoned = 499;

/// Ids that differ from those of other runs of the server.
std::string make_request_id() {
    static const uint64_t kRun = std::random_device()();
    static std::atomic<uint64_t> count = 0;
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%08llx-%llx",
                  static_cast<unsigned long long>(kRun), static_cast<unsigned long long>(++count));
    return digits.data();
}

/// Work that takes longer than about a millisecond would delay other requests of a thread.
bool is_long(const Request& request) {
    constexpr size_t kLongText = size_t{8} << 10;
    constexpr size_t kLongBinary = size_t{128} << 10;
    return request.body.size() >
           (request.has_type("application/octet-stream") ? kLongBinary : kLongText);
}

/// What a request costs beside others of its queue.
uint64_t cost_of(const Plan& plan, const Request& request) {
    constexpr uint64_t kBytes = 4096;
    return plan.run_on == Plan::RunOn::Tools ? 1 : 1 + request.body_size / kBytes;
}

uint32_t network_thread_count(const Settings& settings) {
    const uint32_t all = std::max(1u, std::thread::hardware_concurrency());
    return settings.thread_count == 0 ? all : settings.thread_count;
}

/// Bodies in memory wait for computing: their sum is limited, too.
WorkQueue::Limits compute_limits(const Settings& settings) {
    constexpr int kNiceness = 3;  // network threads come first
    constexpr uint64_t kBodies = 4;
    constexpr uint64_t kBytes = 4096;
    return {.threads = network_thread_count(settings),
            .max_waiting = settings.max_waiting,
            .max_cost = kBodies * (1 + settings.max_body_bytes / kBytes),
            .niceness = kNiceness};
}

/// A request in a queue, and its answer once it is there.
struct Waiting {
    WorkQueue& queue;
    WorkQueue::Handle item;
    net::steady_timer& done;
    const std::optional<Response>& response;
};

/// The state that all sessions share.
class Server final : public HttpServer {
  public:
    Server(const Settings& settings, Application application)
        : settings_(settings),
          application_(std::move(application)),
          acceptor_(net::make_strand(io_)),
          drain_timer_(acceptor_.get_executor()),
          compute_(std::in_place, compute_limits(settings)),
          storage_(std::in_place,
                   WorkQueue::Limits{settings.storage_worker_count, settings.max_waiting}),
          tools_(std::in_place, WorkQueue::Limits{settings.worker_count, settings.max_waiting}) {}

    /// Work that runs uses the sessions, which end with `io_`.
    ~Server() override {
        compute_.reset();
        storage_.reset();
        tools_.reset();
    }

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

    [[nodiscard]] size_t waiting_count(Plan::RunOn place) const override {
        const auto* queue = place == Plan::RunOn::Compute   ? &compute_
                            : place == Plan::RunOn::Storage ? &storage_
                                                            : &tools_;
        return place == Plan::RunOn::Network ? 0 : (*queue)->waiting_count();
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
    net::awaitable<Response> answer(Session& session, Plan& plan, Request& request,
                                    std::optional<double>& waited);
    net::awaitable<std::optional<Response>> wait_for(Session& session, Request& request,
                                                     Waiting& waiting);
    [[nodiscard]] WorkQueue* queue_for(const Plan& plan, const Request& request);
    [[nodiscard]] Response busy(const Request& request) const;
    void end_idle_sessions();

    [[nodiscard]] SendRule send_rule(bool keeps_open) const {
        return {settings_.transfer_seconds, keeps_open, is_ending_};
    }

    const Settings settings_;
    const Application application_;
    net::io_context io_;
    tcp::acceptor acceptor_;
    net::steady_timer drain_timer_;
    std::optional<WorkQueue> compute_;
    std::optional<WorkQueue> storage_;
    std::optional<WorkQueue> tools_;
    std::atomic<uint32_t> connection_count_ = 0;
    std::atomic<uint32_t> refused_count_ = 0;  ///< connections beyond the limit, which get 503
    std::atomic<bool> is_draining_ = false;    ///< each connection gets one more answer
    std::atomic<bool> is_ending_ = false;      ///< no connection gets another answer
    std::atomic<bool> is_over_ = false;        ///< the results of workers are dropped
    std::mutex sessions_mutex_;                ///< guards the sessions and the timer
    std::list<std::weak_ptr<Session>> sessions_;
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
        if (error) {  // for example, no descriptor is left
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
        response = co_await answer(session, plan, request, waited);
    }
    // The unread part of a body would be taken for the next request.
    const bool keeps_open =
        !reading.refused && !is_draining_ && parser.get().keep_alive() && parser.is_done();
    const Sent sent = co_await send_response(session, request, response, send_rule(keeps_open));
    finish(response.status, sent);
    co_return keeps_open&& sent.is_whole;
}

/// Null if the request is handled on the thread of its connection.
WorkQueue* Server::queue_for(const Plan& plan, const Request& request) {
    switch (plan.run_on) {
        case Plan::RunOn::Network:
            return is_long(request) ? &*compute_ : nullptr;
        case Plan::RunOn::Compute:
            return &*compute_;
        case Plan::RunOn::Storage:
            return &*storage_;
        case Plan::RunOn::Tools:
            break;
    }
    return &*tools_;
}

Response Server::busy(const Request& request) const {
    return application_.refusal({503, "busy", "too many requests are waiting already", "requests",
                                 std::to_string(settings_.max_waiting)},
                                request);
}

/// Waits until the work is done. Gives another response if it was dropped: to make room for other
/// clients, after its longest time, or because the client has disconnected.
net::awaitable<std::optional<Response>> Server::wait_for(Session& session, Request& request,
                                                         Waiting& waiting) {
    constexpr auto kLook = std::chrono::milliseconds(200);
    const auto end = Clock::now() + to_duration(settings_.queue_seconds);
    while (!waiting.response) {
        waiting.done.expires_after(kLook);
        error_code ignored;
        co_await waiting.done.async_wait(net::redirect_error(net::use_awaitable, ignored));
        if (waiting.response) break;
        if (session.is_abandoned()) request.is_abandoned = true;
        const bool is_late = Clock::now() > end;
        const bool is_dropped = request.is_abandoned || is_late
                                    ? waiting.queue.drop(waiting.item)
                                    : waiting.queue.is_dropped(waiting.item);
        if (!is_dropped) continue;
        if (request.is_abandoned) {
            co_return application_.refusal({kAbandoned, "abandoned", "the client has disconnected"},
                                           request);
        }
        co_return busy(request);
    }
    co_return std::nullopt;
}

/// Runs the handler where the plan says. Sets how long the request waited for a thread.
net::awaitable<Response> Server::answer(Session& session, Plan& plan, Request& request,
                                        std::optional<double>& waited) {
    WorkQueue* queue = queue_for(plan, request);
    if (queue == nullptr) co_return plan.handle(request);
    const auto executor = co_await net::this_coro::executor;
    net::steady_timer done(executor);
    std::optional<Response> response;
    const auto begin = Clock::now();
    const auto item = queue->post(request.remote, cost_of(plan, request), [&] {
        if (is_over_) return;
        waited = std::chrono::duration<double>(Clock::now() - begin).count();
        Response made = plan.handle(request);
        net::post(executor, [&response, &done, made = std::move(made)]() mutable {
            response = std::move(made);
            done.cancel();
        });
    });
    if (!item) co_return busy(request);
    Waiting waiting{*queue, item, done, response};
    auto instead = co_await wait_for(session, request, waiting);
    if (instead) co_return std::move(*instead);
    co_return std::move(*response);
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
