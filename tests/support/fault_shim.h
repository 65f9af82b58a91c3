// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

// A library to preload (LD_PRELOAD) into the server under test and the programs that it runs. It
// counts system calls on files below a folder, lets one of them fail, and can record those that
// change files. tests/server/faults.py has the other side.
//
//     TETRALIGHT_FAULT_ROOT   the folder
//     TETRALIGHT_FAULT_STATE  a file of sizeof(FaultState) bytes, shared by all processes
//     TETRALIGHT_FAULT_LOG    the record (optional)

namespace tetralight::faults {

/// Calls by what they do: `openat` and `open64` are Open.
enum class Call : uint32_t {
    Open,
    Read,
    Write,
    Sync,
    Rename,
    Unlink,
    Truncate,
    Map,
    Accept,
    Fork,
    Link,
    MakeFolder,
    Count
};

/// Instead of an error number: the call does half of its work.
constexpr uint32_t kShort = 0xffff;

/// Written by the test and by all processes under test.
struct FaultState {
    std::atomic<uint32_t> is_counting;
    /// The call that fails, 1 = Open; 0 = none.
    std::atomic<uint32_t> call;
    /// Which one of these calls since counting began, from 1.
    std::atomic<uint32_t> number;
    /// The error number, or kShort.
    std::atomic<uint32_t> error;
    /// How many calls failed so far.
    std::atomic<uint32_t> fired;
    /// Held while a change is made and recorded.
    std::atomic<uint32_t> lock;
    std::atomic<uint32_t> counts[static_cast<uint32_t>(Call::Count)];
    /// While it is not 0, no call on a file below the folder returns, like those on a disk of the
    /// network that does not answer. `stat`, `access` and `statvfs` wait, too.
    std::atomic<uint32_t> is_hanging;
};

}  // namespace tetralight::faults
