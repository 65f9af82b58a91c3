// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/receiver.h>
#include <tetralight/server/http.h>
#include <tetralight/server/service.h>

// Queries of positions, in JSON and in binary form (query_binary.h). Both are answered by batches.

namespace tetralight::server {

/// The positions and settings of a query.
struct Query {
    std::span<const glm::vec3> positions;
    /// Unit; one for each position, or none.
    std::span<const glm::vec3> normals = {};
    OutsideHull outside = {};
    bool is_half_precision = false;
    /// What is at every position.
    Receiver receiver = {};
    float normal_offset = kNormalOffset;
};

/// Throws a `Problem` if there are too many positions, or one is not finite.
void check_positions(const Service& service, std::span<const glm::vec3> positions);

/// The probes that a query reads. Throws a `Problem` if the volume lacks them.
[[nodiscard]] ProbeVolumeView view_for(const ProbeFile& file, const Query& query);

/// Throws a `Problem` if a batch was refused.
void require(const Result<BatchReport>& report);

[[nodiscard]] Response answer_json(Service& service, const ProbeFile& file, const Request& request);

[[nodiscard]] Response answer_binary(Service& service, const ProbeFile& file,
                                     const Request& request);

}  // namespace tetralight::server
