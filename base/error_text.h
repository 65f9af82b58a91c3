// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/error.h>

// For what shows errors to people: the command, the service, the C API, tests. A test checks that
// nothing else includes this header.

namespace tetralight {

/// The text of a message.
[[nodiscard]] const std::string& error_text(const Message& message) noexcept;

[[nodiscard]] inline const std::string& error_text(const Error& error) noexcept {
    return error_text(error.message);
}

}  // namespace tetralight
