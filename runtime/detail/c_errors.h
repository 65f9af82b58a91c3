// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/error.h>
#include <tetralight/runtime/tetralight.h>

// How calls of the C API end.

namespace tetralight::detail {

/// Why a call of the C API fails; true if it does.
struct CallError {
    tetralight_status status = TETRALIGHT_OK;
    std::string message;

    CallError() = default;
    CallError(tetralight_status failed, std::string text);
    CallError(const Error& error);

    explicit operator bool() const { return status != TETRALIGHT_OK; }
};

/// The status that stands for an error code of the library.
[[nodiscard]] tetralight_status status_of(ErrorCode code) noexcept;

/// The error of opening or verifying a file. An unusable path (too long, or a folder) means that
/// there is no such file.
[[nodiscard]] CallError file_error(const Error& error);

/// Writes the message, empty if the call succeeded, and returns the status.
tetralight_status finish(const CallError& result, tetralight_error* error);

/// The end of every call that succeeds.
inline tetralight_status succeed(tetralight_error* error) {
    return finish({}, error);
}

}  // namespace tetralight::detail
