// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/detail/c_errors.h>

#include <algorithm>
#include <cstring>

#include <tetralight/base/error_text.h>

namespace tetralight::detail {

CallError::CallError(tetralight_status failed, std::string text)
    : status(failed), message(std::move(text)) {}

CallError::CallError(const Error& error)
    : status(status_of(error.code)), message(error_text(error)) {}

tetralight_status status_of(ErrorCode code) noexcept {
    switch (code) {
        case ErrorCode::InvalidArgument:
            return TETRALIGHT_BAD_VALUE;
        case ErrorCode::Corrupt:
            return TETRALIGHT_CORRUPT;
        case ErrorCode::Unsupported:
            return TETRALIGHT_UNSUPPORTED;
        case ErrorCode::NotFound:
            return TETRALIGHT_BAD_FILE;
        case ErrorCode::Unavailable:
            return TETRALIGHT_UNAVAILABLE;
        case ErrorCode::OutOfResources:
            return TETRALIGHT_OUT_OF_RESOURCES;
        case ErrorCode::DiskFull:
            return TETRALIGHT_DISK_FULL;
        case ErrorCode::Cancelled:
            return TETRALIGHT_CANCELLED;
    }
    return TETRALIGHT_BAD_VALUE;
}

CallError file_error(const Error& error) {
    CallError failed(error);
    if (failed.status == TETRALIGHT_BAD_VALUE) failed.status = TETRALIGHT_BAD_FILE;
    return failed;
}

tetralight_status finish(const CallError& result, tetralight_error* error) {
    if (error) {
        const size_t length = std::min(result.message.size(), sizeof error->message - 1);
        std::memcpy(error->message, result.message.data(), length);
        error->message[length] = '\0';
    }
    return result.status;
}

}  // namespace tetralight::detail
