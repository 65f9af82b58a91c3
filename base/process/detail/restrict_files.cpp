// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/detail/restrict_files.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

namespace tetralight::detail {
namespace {

// The interface of the kernel (include/uapi/linux/landlock.h), of which the headers of older
// systems know a part only. These numbers are the same on all processors that Linux added since
// 2011 or had then, except Alpha.
constexpr long kCreateRuleset = 444;
constexpr long kAddRule = 445;
constexpr long kRestrictSelf = 446;
constexpr uint32_t kVersionFlag = 1;
constexpr int kPathBeneath = 1;

constexpr uint64_t kExecute = 1u << 0;
constexpr uint64_t kWriteFile = 1u << 1;
constexpr uint64_t kReadFile = 1u << 2;
constexpr uint64_t kReadFolder = 1u << 3;
constexpr uint64_t kRemoveFolder = 1u << 4;
constexpr uint64_t kRemoveFile = 1u << 5;
constexpr uint64_t kMakeFolder = 1u << 7;
constexpr uint64_t kMakeRegular = 1u << 8;
constexpr uint64_t kMoveBetweenFolders = 1u << 13;
constexpr uint64_t kTruncate = 1u << 14;
constexpr uint64_t kConnections = 3;  // bind and connect TCP
constexpr uint64_t kScopes = 3;       // abstract sockets and signals

struct Ruleset {
    uint64_t files = 0;
    uint64_t network = 0;
    uint64_t scopes = 0;
};

/// The kernel reads the first 12 bytes: its own structure ends after `parent`.
struct PathRule {
    uint64_t allowed = 0;
    int32_t parent = -1;
};

/// All rights that a version can take from a process.
Ruleset all_of(int version) {
    constexpr int kFiles[] = {0, 13, 14, 15, 15, 16};  // number of rights by version
    Ruleset all{.files = (uint64_t{1} << kFiles[version < 5 ? version : 5]) - 1};
    if (version >= 4) all.network = kConnections;
    if (version >= 6) all.scopes = kScopes;
    return all;
}

uint64_t rights_of(FileAccess::Right right) {
    switch (right) {
        case FileAccess::Right::Read:
            break;
        case FileAccess::Right::Execute:
            return kReadFile | kReadFolder | kExecute;
        case FileAccess::Right::Write:
            return kReadFile | kReadFolder | kWriteFile | kTruncate | kRemoveFolder | kRemoveFile |
                   kMakeFolder | kMakeRegular | kMoveBetweenFolders;
    }
    return kReadFile | kReadFolder;
}

/// -1, with errno, if it cannot be opened.
int open_path(const char* path) {
    int file = -1;
    do {
        file = ::open(path, O_PATH | O_CLOEXEC);
    } while (file < 0 && errno == EINTR);
    return file;
}

/// True if this process has no such file, so that there is nothing to allow.
bool is_missing(int error_number) {
    return error_number == ENOENT || error_number == ENOTDIR || error_number == EACCES ||
           error_number == ELOOP;
}

bool allow(int ruleset, const FileAccess& file, uint64_t handled) {
    const int parent = open_path(file.path.c_str());
    if (parent < 0) return is_missing(errno);
    struct stat facts = {};
    bool is_done = ::fstat(parent, &facts) == 0;
    if (is_done) {
        constexpr uint64_t kOfFiles = kExecute | kWriteFile | kReadFile | kTruncate;
        const uint64_t possible = S_ISDIR(facts.st_mode) ? handled : handled & kOfFiles;
        const PathRule rule{rights_of(file.right) & possible, parent};
        is_done = ::syscall(kAddRule, ruleset, kPathBeneath, &rule, 0) == 0;
    }
    const int saved = errno;
    ::close(parent);
    errno = saved;
    return is_done;
}

}  // namespace

bool restrict_files(std::span<const FileAccess> files, int version) noexcept {
    const Ruleset all = all_of(version);
    const auto ruleset = static_cast<int>(::syscall(kCreateRuleset, &all, sizeof all, 0));
    if (ruleset < 0) return false;
    bool is_done = true;
    for (const FileAccess& file : files) is_done = is_done && allow(ruleset, file, all.files);
    is_done = is_done && ::syscall(kRestrictSelf, ruleset, 0) == 0;
    const int saved = errno;
    ::close(ruleset);
    errno = saved;
    return is_done;
}

}  // namespace tetralight::detail

namespace tetralight {

int landlock_version() noexcept {
    const long version = ::syscall(detail::kCreateRuleset, nullptr, 0, detail::kVersionFlag);
    return version > 0 ? static_cast<int>(version) : 0;
}

}  // namespace tetralight
