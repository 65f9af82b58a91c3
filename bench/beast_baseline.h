// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tetralight::bench {

/// A plain asynchronous Beast server on all processors, as its examples have it, that answers every
/// request with the same bytes. Calls `is_listening` with its port, and then serves until the
/// process is ended.
void serve_precomputed(const std::string& answer,
                       const std::function<void(uint16_t port)>& is_listening);

}  // namespace tetralight::bench
