// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/probes/programs/stream.h>

namespace tetralight::programs {

/// Tetrahedralizes `count` positions, 3 coordinates each. Throws std::exception.
using Tetrahedralize = std::vector<StreamTetrahedron> (*)(std::vector<double> coordinates);

/// `main` of a program that tetrahedralizes what comes on stdin, as stream.h says. `name`: with
/// which its messages begin. `most`: the most positions that it takes. Returns the exit code.
int run_program(const char* name, uint64_t most, Tetrahedralize tetrahedralize);

}  // namespace tetralight::programs
