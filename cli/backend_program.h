// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <tetralight/probes/programs/tetrahedralize_with_program.h>

namespace tetralight::cli {

/// The environment variable that names the program of a backend: TETRALIGHT_CGAL of "cgal".
[[nodiscard]] std::string backend_variable(std::string_view backend);

/// The program of a backend, cgal or tetgen: what its variable names, else `tetralight-cgal` or
/// `tetralight-tetgen` beside the running command, else the one that PATH finds.
[[nodiscard]] TetrahedraProgram find_backend_program(std::string_view backend);

}  // namespace tetralight::cli
