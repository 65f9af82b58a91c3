// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

// Which files a program may use, where the kernel has Landlock (landlock(7), Linux 5.13 or newer).
// Landlock does not limit what changes no bytes: rights, owners and times of files.
//
//     auto files = program_files();
//     files.push_back({"results", FileAccess::Right::Write});
//     run_process({.program = "/proc/self/exe", .files = files});

namespace tetralight {

/// A file, or a folder with all that is in it, and what a program may do with it.
struct FileAccess {
    enum class Right : uint8_t {
        Read,
        Execute,  ///< and read
        Write,    ///< and read, create, rename, delete
    };

    /// Relative paths begin in the program's working folder. One that does not exist gives no
    /// right.
    std::string path;
    Right right = Right::Read;
};

/// The version of the kernel's Landlock; 0 if it has none or does not allow it.
[[nodiscard]] int landlock_version() noexcept;

/// What another process of this program needs to run: the libraries that are loaded and the folders
/// of the system's libraries, and what the kernel tells a process about itself, the processors and
/// the memory.
[[nodiscard]] std::vector<FileAccess> program_files();

}  // namespace tetralight
