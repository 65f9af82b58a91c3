// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/contract.h>

#include <cstdio>
#include <cstdlib>

namespace tetralight::detail {

void assertion_failed(const char* condition, const char* why, const char* file, int line) noexcept {
    std::fprintf(stderr, "%s:%d: assertion failed: %s (%s)\n", file, line, condition, why);
    std::abort();
}

}  // namespace tetralight::detail
