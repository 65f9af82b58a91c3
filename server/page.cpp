// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/page.h>

#include <charconv>

#include <tetralight/server/problem.h>

namespace tetralight::server {

Page page_of(const Request& request) {
    Page page;
    const size_t most = page.limit;
    if (const std::string* asked = request.parameter("limit")) {
        const char* end = asked->data() + asked->size();
        const auto [next, error] = std::from_chars(asked->data(), end, page.limit);
        if (error != std::errc{} || next != end || page.limit == 0 || page.limit > most) {
            throw Problem{400, "invalid_value", "limit: must be 1 to 1000", "limit", *asked};
        }
    }
    if (const std::string* after = request.parameter("after")) page.after = *after;
    return page;
}

}  // namespace tetralight::server
