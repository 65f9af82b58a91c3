// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include <tetralight/base/result.h>
#include <tetralight/server/http.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/settings.h>

namespace tetralight::server {

/// The functions that answer requests. Called from many threads.
struct Application {
    /// Called when the head of a request has been read, and its body has not.
    std::function<Plan(Request&)> plan;
    std::function<void(const Exchange&)> answered;
    /// The response to an invalid request, or to one that cannot be handled now.
    std::function<Response(const Problem&, const Request&)> refusal;
    /// Called when so few descriptors were left that this many idle connections were closed.
    std::function<void(size_t)> lacks_descriptors;
};

/// An HTTP/1.1 server on one address: persistent connections, limits on heads, bodies, time and
/// connections, and worker threads for handlers that wait.
class HttpServer {
  public:
    /// Binds the address. It does not accept connections yet.
    [[nodiscard]] static Result<std::unique_ptr<HttpServer>> bind(const Settings& settings,
                                                                  Application application);

    virtual ~HttpServer() = default;

    /// The port that it is bound to.
    [[nodiscard]] virtual uint16_t port() const = 0;

    /// Open connections.
    [[nodiscard]] virtual uint32_t connection_count() const = 0;

    /// Requests that wait for a thread of a place.
    [[nodiscard]] virtual size_t waiting_count(Plan::RunOn place) const = 0;

    /// Serves until `stop`, then until the requests in progress are answered or the time is up.
    virtual void run() = 0;

    /// Closes each connection after its next answer. After the notice of the settings it accepts no
    /// more connections and closes idle ones. May be called from any thread.
    virtual void stop() = 0;

  protected:
    HttpServer() = default;
};

}  // namespace tetralight::server
