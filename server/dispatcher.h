// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <tetralight/server/problem.h>
#include <tetralight/server/router.h>
#include <tetralight/server/service.h>
#include <tetralight/server/viewer_files.h>

namespace tetralight::server {

/// Finds the handler of a request and turns problems into responses.
class Dispatcher {
  public:
    /// Keeps a reference.
    explicit Dispatcher(Service& service);

    /// How to answer a request whose head has been read. A request that is refused has a plan, too.
    [[nodiscard]] Plan plan(Request& request) const;

    [[nodiscard]] Response refuse(const Problem& problem, const Request& request) const;

  private:
    void plan_route(Request& request, Plan& plan) const;
    [[nodiscard]] const Route& find(Request& request) const;
    [[nodiscard]] bool is_known(Request& request) const;
    [[nodiscard]] Response handle(const Route& route, Request& request) const;
    [[nodiscard]] Response guarded(Request& request, const std::function<Response()>& handle) const;
    [[nodiscard]] Response finish(const Request& request, Response response) const;

    Service& service_;
    const Router router_;
    const ViewerFiles viewer_;
};

}  // namespace tetralight::server
