// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/build/tetgen.h>

namespace tetralight::cli {

/// The environment variable that names the program of `--backend tetgen`.
inline constexpr const char* kTetgenVariable = "TETRALIGHT_TETGEN";

/// The program of `--backend tetgen`: what the environment names, else `tetralight-tetgen` beside
/// the running command, else the one that PATH finds.
[[nodiscard]] TetgenProgram find_tetgen_program();

}  // namespace tetralight::cli
