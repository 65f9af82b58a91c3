// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight {

/// Listens to what the current context says of its errors. Not beyond the context.
class DebugMessages {
  public:
    DebugMessages();

    /// Error: OpenGL complained since the last call; its own words, the first of them.
    [[nodiscard]] Status check();

  private:
    std::unique_ptr<std::string> first_;  // on the heap: the callback writes there
};

}  // namespace tetralight
