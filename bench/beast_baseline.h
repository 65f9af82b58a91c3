// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace tetralight::bench {

/// The body of a response. Its bytes are not set to zero before they are written.
struct PlainAnswer {
    std::shared_ptr<const char[]> bytes;
    size_t size = 0;
};

/// Answers the body of a request. Called on the thread of its connection.
using PlainHandler = std::function<PlainAnswer(const std::string& body)>;

/// A plain asynchronous Beast server on all processors, as in Beast's examples. Calls
/// `is_listening` with its port and serves until the process ends.
void serve_plainly(const PlainHandler& handler,
                   const std::function<void(uint16_t port)>& is_listening);

/// The same bytes for each request.
[[nodiscard]] PlainHandler same_answer(const std::string& text);

}  // namespace tetralight::bench
