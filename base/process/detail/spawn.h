// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/process/process.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

/// The descriptors of a child's stdin, stdout and stderr. None of them is a standard one of this
/// process (see `above_standard`).
struct ChildStreams {
    int input = -1;
    int output = -1;
    int errors = -1;
};

/// The same open file under a number above stderr's, so that redirecting the standard streams of a
/// child never closes it, even in a process that began without them.
[[nodiscard]] Descriptor above_standard(Descriptor descriptor);

/// Starts the program of a command; returns its process id once the program runs. Returns the
/// system's reason if it cannot.
[[nodiscard]] Result<pid_t> spawn(const ProcessCommand& command, const ChildStreams& streams);

}  // namespace tetralight::detail
