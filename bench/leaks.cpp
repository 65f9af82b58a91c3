// SPDX-License-Identifier: Apache-2.0
// How much light leaks through walls.
#include <tetralight/bench/leaks.h>

namespace tetralight::bench {

void bench_leaks(const Options& options) {
    bench_leak_rooms(options);
    bench_leak_places(options);
}

}  // namespace tetralight::bench
