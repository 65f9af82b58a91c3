// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>
#include <tetralight/server/query.h>

namespace tetralight::server {

void check_positions(const Service& service, std::span<const glm::vec3> positions) {
    if (positions.size() > service.settings.max_positions) {
        throw Problem{413, "too_large",
                      str_cat("a query may have ", service.settings.max_positions, " positions"),
                      "positions", std::to_string(positions.size())};
    }
    for (size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3& p = positions[i];
        if (std::isfinite(p.x + p.y + p.z) ||
            (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))) {
            continue;
        }
        throw Problem{400, "not_finite", str_cat("position ", i, " is not finite"),
                      str_cat("positions[", i, "]"), str_cat(p.x, ", ", p.y, ", ", p.z)};
    }
}

ProbeVolumeView view_for(const ProbeFile& file, const Query& query) {
    const ProbeVolumeView& view = file.view();
    if (!query.is_half_precision) return view.without_compact();
    if (!view.compact.empty()) return view;
    throw Problem{422, "bad_data", "the volume holds no half-precision probes", "precision",
                  "half"};
}

void require(const Result<BatchReport>& report) {
    if (!report) throw Problem{500, "query", detail_of(report.error())};
}

namespace {

constexpr const char* kBinary = "application/octet-stream";

Response query(Service& service, Request& request) {
    const auto volume = service.volumes.open(request.captures[0]);
    Response response = request.has_type(kBinary) ? answer_binary(service, volume->file, request)
                                                  : answer_json(service, volume->file, request);
    volume->require_whole();
    return response;
}

}  // namespace

std::vector<Route> query_routes(Service& service) {
    return {{.method = "POST",
             .pattern = "/v1/volumes/{volume}/query",
             .handle = [&](Request& request) { return query(service, request); },
             .body_limit = service.settings.max_body_bytes}};
}

}  // namespace tetralight::server
