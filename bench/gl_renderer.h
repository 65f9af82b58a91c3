// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// The picture of OpenGL against that of rays, and frames of the mesh ball.
void bench_gl_renderer(const Options& options);

}  // namespace tetralight::bench
