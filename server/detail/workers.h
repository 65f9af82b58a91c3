// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>

#include <tetralight/server/detail/session.h>
#include <tetralight/server/http_server.h>
#include <tetralight/server/work_queue.h>

namespace tetralight::server {

/// Status in logs: the client had disconnected.
constexpr unsigned kAbandoned = 499;

/// Threads for requests and for connections.
[[nodiscard]] uint32_t network_thread_count(const Settings& settings);

/// A request in a queue, and its answer once it is there.
struct Waiting;

/// The threads that handle what would take too long on those of the network.
class Workers {
  public:
    /// Keeps references.
    Workers(const Settings& settings, const Application& application);

    /// Requests that wait for a thread of a place.
    [[nodiscard]] size_t waiting_count(Plan::RunOn place) const;

    /// Runs the handler where the plan says. Sets how long the request waited for a thread. If the
    /// client has disconnected, marks the request as abandoned; the answer has no reader then.
    net::awaitable<Response> answer(Session& session, Plan& plan, Request& request,
                                    std::optional<double>& waited);

    /// From now on, answers are not waited for.
    void drop_results() { is_over_ = true; }

  private:
    net::awaitable<std::optional<Response>> wait_for(Session& session, Request& request,
                                                     Waiting& waiting);
    [[nodiscard]] WorkQueue* queue_for(const Plan& plan, const Request& request);
    [[nodiscard]] Response busy(const Request& request) const;

    const Settings& settings_;
    const Application& application_;
    std::atomic<bool> is_over_ = false;
    WorkQueue compute_;
    WorkQueue storage_;
    WorkQueue tools_;
};

}  // namespace tetralight::server
