// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <tetralight/base/result.h>

namespace tetralight {

/// Collects the error messages of the current context. Must not outlive the context.
class DebugMessages {
  public:
    DebugMessages();

    /// Returns the first error that the driver reported since the last call, with the driver's
    /// text: out_of_resources if memory is short, else unsupported.
    [[nodiscard]] Status check();

  private:
    std::unique_ptr<std::string> first_;  // on the heap: the callback writes there
};

}  // namespace tetralight
