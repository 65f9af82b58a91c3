// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight {

/// Where the program `tetralight-tetgen` is. TetGen (AGPL-3.0-or-later) can end its process, and
/// is linked by that program alone.
struct TetgenProgram {
    /// A path; a name without a slash is looked up in PATH.
    std::string path = "tetralight-tetgen";
    /// After this time the program is killed. TetGen takes some seconds a million probes.
    std::chrono::milliseconds time_limit = std::chrono::minutes(10);
};

/// The same as `tetrahedralize`, with TetGen in a child process instead of CGAL: equal cells
/// wherever no five positions lie on an empty sphere, other ones of the same quality elsewhere.
/// Positions in a plane, on a line or in one point never reach TetGen; `tetrahedralize` takes them.
/// Thread-safe; the library stays usable whatever the program does.
///
/// Errors, all naming the program: it cannot be started, crashes, fails, runs too long or writes
/// something else than a Delaunay tetrahedralization of all positions, which exact arithmetic
/// checks.
[[nodiscard]] Result<Tetrahedralization> tetrahedralize_with_tetgen(
    std::span<const glm::dvec3> positions, double flatness = 0.0,
    const TetgenProgram& program = {});

}  // namespace tetralight
