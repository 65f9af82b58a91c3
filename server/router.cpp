// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/router.h>

#include <algorithm>
#include <optional>

#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

std::vector<std::string> split(std::string_view path) {
    std::vector<std::string> parts;
    path.remove_prefix(1);
    while (true) {
        const size_t slash = path.find('/');
        parts.emplace_back(path.substr(0, slash));
        if (slash == std::string_view::npos) return parts;
        path.remove_prefix(slash + 1);
    }
}

/// The parts of a path that a pattern captures; nothing if they do not match. The words of a
/// pattern match only as they are written: an escape in one would evade the rules of a proxy.
std::optional<std::vector<std::string>> match(const std::vector<std::string>& pattern,
                                              const std::vector<PathSegment>& path) {
    if (pattern.size() != path.size()) return std::nullopt;
    std::vector<std::string> captures;
    for (size_t i = 0; i < path.size(); ++i) {
        if (pattern[i].starts_with('{')) {
            if (path[i].decoded.empty()) return std::nullopt;
            captures.push_back(path[i].decoded);
        } else if (pattern[i] != path[i].sent) {
            return std::nullopt;
        }
    }
    return captures;
}

}  // namespace

void check_parameters(const Route& route, const Request& request) {
    for (const auto& [name, value] : request.parameters) {
        if (std::ranges::find(route.parameters, name) == route.parameters.end()) {
            throw Problem{400, "unknown_parameter",
                          "\"" + name + "\" is not a parameter of this path", name, value};
        }
        if (request.parameter(name) != &value) {
            throw Problem{400, "repeated_parameter", "\"" + name + "\" is given twice", name,
                          value};
        }
    }
}

Router::Router(std::vector<Route> routes) : routes_(std::move(routes)) {
    for (const Route& route : routes_) parts_.push_back(split(route.pattern));
}

const Route& Router::find(Request& request) const {
    std::string methods;
    for (size_t i = 0; i < routes_.size(); ++i) {
        auto captures = match(parts_[i], request.segments);
        if (!captures) continue;
        const std::string& method = routes_[i].method;
        if (method == request.method || (method == "GET" && request.method == "HEAD")) {
            request.captures = std::move(*captures);
            return routes_[i];
        }
        methods += (methods.empty() ? "" : ", ") + method + (method == "GET" ? ", HEAD" : "");
    }
    if (methods.empty()) {
        throw Problem{404, "no_such_path", "there is nothing at this path", "path", request.path};
    }
    throw Problem{405,      "wrong_method", "this path takes " + methods,
                  "method", request.method, {{"Allow", methods}}};
}

}  // namespace tetralight::server
