// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tetralight::bench {

/// A plain asynchronous Beast server on all processors, as in Beast's examples, that answers each
/// request with the same bytes. Calls `is_listening` with its port and serves until the process
/// ends.
void serve_precomputed(const std::string& answer,
                       const std::function<void(uint16_t port)>& is_listening);

}  // namespace tetralight::bench
