// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/workers.h>

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <string>
#include <thread>

namespace tetralight::server {
namespace {

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

}  // namespace

/// A request in a queue, and its answer once it is there.
struct Waiting {
    WorkQueue& queue;
    WorkQueue::Handle item;
    net::steady_timer& done;
    const std::optional<Response>& response;
};

uint32_t network_thread_count(const Settings& settings) {
    const uint32_t all = std::max(1u, std::thread::hardware_concurrency());
    return settings.thread_count == 0 ? all : settings.thread_count;
}

Workers::Workers(const Settings& settings, const Application& application)
    : settings_(settings),
      application_(application),
      compute_(compute_limits(settings)),
      storage_({settings.storage_worker_count, settings.max_waiting}),
      tools_({settings.worker_count, settings.max_waiting}) {}

size_t Workers::waiting_count(Plan::RunOn place) const {
    switch (place) {
        case Plan::RunOn::Network:
            return 0;
        case Plan::RunOn::Compute:
            return compute_.waiting_count();
        case Plan::RunOn::Storage:
            return storage_.waiting_count();
        case Plan::RunOn::Tools:
            break;
    }
    return tools_.waiting_count();
}

/// Null if the request is handled on the thread of its connection.
WorkQueue* Workers::queue_for(const Plan& plan, const Request& request) {
    switch (plan.run_on) {
        case Plan::RunOn::Network:
            return is_long(request) ? &compute_ : nullptr;
        case Plan::RunOn::Compute:
            return &compute_;
        case Plan::RunOn::Storage:
            return &storage_;
        case Plan::RunOn::Tools:
            break;
    }
    return &tools_;
}

Response Workers::busy(const Request& request) const {
    return application_.refusal({503, "busy", "too many requests are waiting already", "requests",
                                 std::to_string(settings_.max_waiting)},
                                request);
}

/// Waits until the work is done. Gives another response if it was dropped: to make room for other
/// clients, after its longest time, or because the client has disconnected.
net::awaitable<std::optional<Response>> Workers::wait_for(Session& session, Request& request,
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
net::awaitable<Response> Workers::answer(Session& session, Plan& plan, Request& request,
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

}  // namespace tetralight::server
