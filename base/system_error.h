// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/error.h>

namespace tetralight {

/// The code of a system call's error number (errno): Unavailable for what is out of reach (EIO,
/// ESTALE, EACCES...), OutOfResources for EMFILE, ENOMEM..., DiskFull for ENOSPC and EDQUOT.
[[nodiscard]] ErrorCode error_code_of_errno(int number) noexcept;

/// Why a system call about `path` failed, from `errno`: "a.probes: cannot open (No such file...)".
[[nodiscard]] Error system_error(const std::string& path, const char* what);

/// Why a system call about no file failed: "cannot make a pipe (Too many open files)".
[[nodiscard]] Error system_error(const std::string& action);

}  // namespace tetralight
