// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/detail/descriptors.h>

#include <sys/resource.h>

#include <algorithm>

#include <tetralight/base/system_error.h>

namespace tetralight::server {

bool has_no_descriptor(const boost::system::error_code& error) {
    return error_code_of_errno(error.value()) == ErrorCode::OutOfResources;
}

bool is_nearly_the_last(int descriptor) {
    constexpr rlim_t kSpare = 32;
    constexpr rlim_t kShare = 4;
    rlimit limit = {};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return false;
    const rlim_t spare = std::min(kSpare, limit.rlim_cur / kShare);
    return static_cast<rlim_t>(descriptor) + spare >= limit.rlim_cur;
}

}  // namespace tetralight::server
