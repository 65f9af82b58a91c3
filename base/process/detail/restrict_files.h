// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <tetralight/base/process/landlock.h>

namespace tetralight::detail {

/// Takes all files but these from this process and from programs that it executes or starts, for
/// ever. Also takes connections over TCP, abstract sockets and signals to other processes, where
/// the version of Landlock has such limits. Makes system calls only, so that it may run between
/// fork and exec. Returns false, with errno, if the system refuses.
///
/// Preconditions: `version` is `landlock_version()` and > 0; the process has `no_new_privs`.
[[nodiscard]] bool restrict_files(std::span<const FileAccess> files, int version) noexcept;

}  // namespace tetralight::detail
