// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/system_error.h>

#include <cerrno>
#include <cstring>

#include <tetralight/base/shown_path.h>

namespace tetralight {

ErrorCode error_code_of_errno(int number) noexcept {
    switch (number) {
        case ENOENT:
        case ENOTDIR:
            return ErrorCode::NotFound;
        case ENOSPC:
#ifdef EDQUOT  // Windows lacks it
        case EDQUOT:
#endif
            return ErrorCode::DiskFull;
        case EMFILE:
        case ENFILE:
        case ENOMEM:
        case EAGAIN:
        case ENOBUFS:
            return ErrorCode::OutOfResources;
        case EISDIR:
        case ELOOP:
        case ENAMETOOLONG:
        case EBADF:
        case EINVAL:
        case EFBIG:
            return ErrorCode::InvalidArgument;
        default:
            return ErrorCode::Unavailable;
    }
}

Error system_error(const std::string& path, const char* what) {
    Error error = system_error(std::string(what)).in(shown_path(path));
    error.value = path;
    return error;
}

Error system_error(const std::string& action) {
    const int number = errno;
    return {error_code_of_errno(number), "cannot " + action + " (" + std::strerror(number) + ")"};
}

}  // namespace tetralight
