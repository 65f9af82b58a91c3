// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bench/harness.h>

namespace tetralight::bench {

/// The OpenGL picture against the ray-traced one, and frame times of the mesh ball.
void bench_gl_renderer(const Options& options);

}  // namespace tetralight::bench
