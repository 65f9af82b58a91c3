// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <tetralight/server/http.h>

namespace tetralight::server {

/// The part of a list that a request asks for: `?limit=` entries that follow `?after=` one.
struct Page {
    size_t limit = 1000;
    /// The key of the last entry before the page; empty: from the start.
    std::string after;
};

/// Throws a `Problem` unless the limit is 1 to 1000.
[[nodiscard]] Page page_of(const Request& request);

}  // namespace tetralight::server
