// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/server/http.h>

namespace tetralight::server {

enum class Access : uint8_t {
    Open,   ///< needs no token
    Reads,  ///< changes nothing
    Writes,
};

struct Route {
    std::string method;
    /// "/v1/volumes/{volume}/query": each {} captures one part of the path.
    std::string pattern;
    Access access = Access::Reads;
    /// May throw a `Problem`.
    std::function<Response(Request&)> handle;
    /// What may follow `?`, each once.
    std::vector<std::string> parameters = {};
    uint64_t body_limit = 0;
    Plan::BodyTo body_to = Plan::BodyTo::Memory;
    Plan::RunOn run_on = Plan::RunOn::Network;
    /// Called before a body goes to a file: opens it. May throw a `Problem`.
    std::function<void(Request&)> prepare = {};
};

/// Throws a `Problem` for parameters that a route does not know, and for those given twice.
void check_parameters(const Route& route, const Request& request);

/// Finds the route of a request by its path and method.
class Router {
  public:
    explicit Router(std::vector<Route> routes);

    /// The route, and what its pattern captured in `request.captures`. Throws a `Problem`: no path
    /// is such (404), or the path has no such method (405). GET answers HEAD too.
    [[nodiscard]] const Route& find(Request& request) const;

    [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

  private:
    std::vector<Route> routes_;
    std::vector<std::vector<std::string>> parts_;  ///< of the patterns
};

}  // namespace tetralight::server
