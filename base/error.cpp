// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error.h>

#include <tetralight/base/contract.h>
#include <tetralight/base/error_text.h>

namespace tetralight {

std::string_view error_code_name(ErrorCode code) noexcept {
    switch (code) {
        case ErrorCode::InvalidArgument:
            return "invalid_argument";
        case ErrorCode::Corrupt:
            return "corrupt";
        case ErrorCode::Unsupported:
            return "unsupported";
        case ErrorCode::NotFound:
            return "not_found";
        case ErrorCode::Unavailable:
            return "unavailable";
        case ErrorCode::OutOfResources:
            return "out_of_resources";
        case ErrorCode::DiskFull:
            return "disk_full";
        case ErrorCode::Cancelled:
            return "cancelled";
    }
    return "invalid_argument";
}

bool can_retry(ErrorCode code) noexcept {
    return code == ErrorCode::Unavailable || code == ErrorCode::OutOfResources ||
           code == ErrorCode::DiskFull;
}

const std::string& error_text(const Message& message) noexcept {
    return message.text_;
}

}  // namespace tetralight
