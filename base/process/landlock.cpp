// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/landlock.h>

#include <link.h>

namespace tetralight {
namespace {

using Right = FileAccess::Right;

/// The dynamic loader is executed like a program, libraries are read.
constexpr const char* kLibraryFolders[] = {"/lib",       "/lib32",     "/lib64",        "/usr/lib",
                                           "/usr/lib32", "/usr/lib64", "/usr/local/lib"};

// Of /proc only its own folder: the others tell of other processes.
constexpr const char* kSystemFiles[] = {"/etc/ld.so.cache",
                                        "/etc/ld.so.preload",
                                        "/etc/ssl/openssl.cnf",
                                        "/proc/self",
                                        "/proc/cpuinfo",
                                        "/proc/meminfo",
                                        "/proc/stat",
                                        "/proc/sys/vm",
                                        "/sys/devices/system/cpu",
                                        "/sys/devices/system/node",
                                        "/sys/kernel/mm/transparent_hugepage",
                                        "/dev/urandom"};

int add_library(dl_phdr_info* info, size_t, void* files) {
    if (info->dlpi_name != nullptr && *info->dlpi_name == '/') {
        static_cast<std::vector<FileAccess>*>(files)->push_back({info->dlpi_name, Right::Execute});
    }
    return 0;
}

}  // namespace

std::vector<FileAccess> program_files() {
    std::vector<FileAccess> files;
    for (const char* folder : kLibraryFolders) files.push_back({folder, Right::Execute});
    for (const char* file : kSystemFiles) files.push_back({file, Right::Read});
    files.push_back({"/dev/null", Right::Write});
    ::dl_iterate_phdr(add_library, &files);
    return files;
}

}  // namespace tetralight
