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

/// What the server asks whoever answers requests. Called from many threads.
struct Application {
    /// The head of a request is there, its body is not.
    std::function<Plan(Request&)> plan;
    std::function<void(const Exchange&)> answered;
    /// A response for what is no request, or for one that comes too early or too late.
    std::function<Response(const Problem&, const Request&)> refusal;
};

/// Speaks HTTP/1.1 on one address: connections that stay open, limits on heads, bodies, time and
/// connections, and workers for what waits.
class HttpServer {
  public:
    /// Binds the address; serves nothing yet.
    [[nodiscard]] static Result<std::unique_ptr<HttpServer>> bind(const Settings& settings,
                                                                  Application application);

    virtual ~HttpServer() = default;

    /// The port that it is bound to.
    [[nodiscard]] virtual uint16_t port() const = 0;

    /// Open connections.
    [[nodiscard]] virtual uint32_t connection_count() const = 0;

    /// Serves until `stop`, and then until what was begun is answered, or time is up.
    virtual void run() = 0;

    /// Closes connections after their next answer, and after the notice of the settings takes no
    /// more of them; idle ones are closed then. May be called from any thread.
    virtual void stop() = 0;

  protected:
    HttpServer() = default;
};

}  // namespace tetralight::server
