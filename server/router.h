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
    /// Of routes that write: false if they only run a program, whose results are the answer.
    bool stores = true;
    /// May throw a `Problem`.
    std::function<Response(Request&)> handle;
    /// Names of parameters in the query string, each at most once.
    std::vector<std::string> parameters = {};
    uint64_t body_limit = 0;
    Plan::BodyTo body_to = Plan::BodyTo::Memory;
    Plan::RunOn run_on = Plan::RunOn::Network;
    /// Opens the file for a body of `BodyTo::File`. May throw a `Problem`.
    std::function<void(Request&)> prepare = {};
};

/// Throws a `Problem` for unknown and repeated parameters.
void check_parameters(const Route& route, const Request& request);

/// Finds the route of a request by its path and method.
class Router {
  public:
    explicit Router(std::vector<Route> routes);

    /// The route; its captures go to `request.captures`. Throws a `Problem`: 404 if there is no
    /// such path, 405 if the path has no such method. GET routes also answer HEAD.
    [[nodiscard]] const Route& find(Request& request) const;

    [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

  private:
    std::vector<Route> routes_;
    std::vector<std::vector<std::string>> parts_;  ///< of the patterns
};

}  // namespace tetralight::server
