// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight {

/// The program `tetralight-tetgen`. TetGen (AGPL-3.0-or-later) can abort its process, and only that
/// program links it.
struct TetgenProgram {
    /// A path; a name without a slash is looked up in PATH.
    std::string path = "tetralight-tetgen";
    /// After this time the program is killed. TetGen takes some seconds a million probes.
    std::chrono::milliseconds time_limit = std::chrono::minutes(10);
};

/// The same as `tetrahedralize`, with TetGen in a child process instead of CGAL: equal cells
/// wherever no five positions lie on an empty sphere, other ones of the same quality elsewhere.
/// Positions in a plane, on a line or in one point never reach TetGen; `tetrahedralize` takes them.
/// Thread-safe. A failure of the program does not affect the library.
///
/// Messages of errors begin with the program. Returns not_found or unavailable if it cannot be
/// started, unsupported if it crashes or fails, out_of_resources if it exceeds the time limit, and
/// corrupt if exact arithmetic finds that its output is not a Delaunay tetrahedralization of all
/// positions.
[[nodiscard]] Result<Tetrahedralization> tetrahedralize_with_tetgen(
    std::span<const glm::dvec3> positions, double flatness = 0.0,
    const TetgenProgram& program = {});

}  // namespace tetralight
