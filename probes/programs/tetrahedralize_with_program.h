// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/tetrahedralize.h>

namespace tetralight {

/// A program that tetrahedralizes with another library: `tetralight-cgal` (CGAL, GPL-3.0-or-later)
/// or `tetralight-tetgen` (TetGen, AGPL-3.0-or-later; it can abort its process). Only these
/// programs link those libraries.
struct TetrahedraProgram {
    /// A path; a name without a slash is looked up in PATH.
    std::string path;
    /// After this time the program is killed. Both take some seconds a million probes.
    std::chrono::milliseconds time_limit = std::chrono::minutes(10);
};

/// The same as `tetrahedralize`, by a program, as a second opinion. `tetralight-cgal` gives equal
/// cells. `tetralight-tetgen` gives equal cells wherever no five positions lie on an empty sphere,
/// and other ones of the same quality elsewhere. Positions in a plane, on a line or in one point
/// never reach a program; `tetrahedralize` takes them. Thread-safe. A failure of the program does
/// not affect the library.
///
/// Messages of errors begin with the program. Returns not_found or unavailable if it cannot be
/// started, unsupported if it crashes or fails, out_of_resources if it exceeds the time limit, and
/// corrupt if exact arithmetic finds that its output is not a Delaunay tetrahedralization of all
/// positions.
[[nodiscard]] Result<Tetrahedralization> tetrahedralize_with_program(
    std::span<const glm::dvec3> positions, double flatness, const TetrahedraProgram& program);

}  // namespace tetralight
