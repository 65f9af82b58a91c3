// SPDX-License-Identifier: Apache-2.0
#include "tests/support/fault_shim.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

// Between fork and exec only system calls are allowed, so that nothing here allocates.

namespace tetralight::faults {
namespace {

struct Shim {
    FaultState* state = nullptr;
    int log = -1;
    char root[PATH_MAX] = {};
    size_t root_length = 0;
};

Shim shim;

/// Opens a file of the test. Programs that this one executes inherit it, because they may be unable
/// to open it themselves; `variable` tells them its number.
int open_shared(const char* variable, const char* path, int flags) {
    if (const char* inherited = std::getenv(variable)) return std::atoi(inherited);
    const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, 0644));
    // One that the limit of the server does not count as one of its own next ones.
    const int high = ::fcntl(file, F_DUPFD, 900);
    ::syscall(SYS_close, file);
    char number[16];
    std::snprintf(number, sizeof number, "%d", high);
    ::setenv(variable, number, 1);
    return high;
}

__attribute__((constructor)) void begin() {
    const char* root = std::getenv("TETRALIGHT_FAULT_ROOT");
    const char* state = std::getenv("TETRALIGHT_FAULT_STATE");
    const char* log = std::getenv("TETRALIGHT_FAULT_LOG");
    if (root == nullptr || state == nullptr) return;
    shim.root_length = std::strlen(root);
    std::memcpy(shim.root, root, shim.root_length + 1);
    const int file = open_shared("TETRALIGHT_FAULT_STATE_FILE", state, O_RDWR);
    void* memory = reinterpret_cast<void*>(::syscall(SYS_mmap, nullptr, sizeof(FaultState),
                                                     PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    if (memory != MAP_FAILED) shim.state = static_cast<FaultState*>(memory);
    if (log == nullptr) return;
    shim.log = open_shared("TETRALIGHT_FAULT_LOG_FILE", log, O_WRONLY | O_APPEND | O_CREAT);
}

bool is_below_root(const char* path) {
    return std::strncmp(path, shim.root, shim.root_length) == 0 &&
           (path[shim.root_length] == '/' || path[shim.root_length] == '\0');
}

/// The path of a descriptor, or of a name relative to it.
bool find_path(int folder, const char* name, char* path) {
    if (name != nullptr && *name == '/') return std::snprintf(path, PATH_MAX, "%s", name) > 0;
    char link[64];
    if (folder == AT_FDCWD) {
        std::snprintf(link, sizeof link, "/proc/self/cwd");
    } else {
        std::snprintf(link, sizeof link, "/proc/self/fd/%d", folder);
    }
    const ssize_t length = ::readlink(link, path, PATH_MAX - 256);
    if (length <= 0) return false;
    path[length] = '\0';
    if (name != nullptr) std::snprintf(path + length, 256, "/%s", name);
    return true;
}

bool is_watched(int folder, const char* name, char* path) {
    if (shim.state == nullptr || !find_path(folder, name, path) || !is_below_root(path))
        return false;
    constexpr timespec kPause{0, 10'000'000};
    while (shim.state->is_hanging != 0) ::nanosleep(&kPause, nullptr);
    return true;
}

/// How often progress is written and read depends on the time.
bool is_counted(const char* path) {
    return std::strstr(path, "progress.json") == nullptr;
}

/// Counts a call. Returns true, with errno, if it has to fail.
bool fails(Call call) {
    FaultState* state = shim.state;
    if (state == nullptr || state->is_counting == 0) return false;
    const auto index = static_cast<uint32_t>(call);
    const uint32_t number = ++state->counts[index];
    if (state->call != index + 1 || state->number != number) return false;
    ++state->fired;
    errno = static_cast<int>(state->error.load());
    return true;
}

/// The same for calls on a descriptor.
bool fails_on(Call call, int file) {
    char path[PATH_MAX];
    return is_watched(file, nullptr, path) && is_counted(path) && fails(call);
}

/// Makes changes and their records one, in one order for all processes.
class Recording {
  public:
    Recording() {
        if (shim.log < 0) return;
        for (int tries = 0; shim.state->lock.exchange(1) != 0 && tries < 1'000'000; ++tries) {
            ::sched_yield();  // a process that was killed may have held it
        }
    }

    ~Recording() {
        if (shim.log >= 0) shim.state->lock = 0;
    }

    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    /// One record: a line of text, and bytes.
    void add(const char* name, uint64_t inode, const char* a, const char* b, uint64_t offset,
             const void* bytes = nullptr, size_t size = 0) const {
        if (shim.log < 0) return;
        const int saved = errno;
        char line[3 * PATH_MAX];
        const int length = std::snprintf(line, sizeof line, "%s\t%lu\t%s\t%s\t%lu\t%zu\n", name,
                                         inode, a, b, offset, size);
        const iovec parts[] = {{line, static_cast<size_t>(length)},
                               {const_cast<void*>(bytes), size}};
        ::syscall(SYS_writev, shim.log, parts, size > 0 ? 2 : 1);
        errno = saved;
    }
};

uint64_t inode_of(int file) {
    struct stat status = {};
    return ::fstat(file, &status) == 0 ? status.st_ino : 0;
}

uint64_t inode_at(const char* path) {
    struct stat status = {};
    return ::lstat(path, &status) == 0 ? status.st_ino : 0;
}

int open_watched(int folder, const char* name, int flags, mode_t mode) {
    const auto open_now = [&] {
        return static_cast<int>(::syscall(SYS_openat, folder, name, flags, mode));
    };
    char path[PATH_MAX];
    if (!is_watched(folder, name, path)) return open_now();
    if (is_counted(path) && fails(Call::Open)) return -1;
    const bool is_unnamed = (flags & O_TMPFILE) == O_TMPFILE;
    if ((flags & (O_CREAT | O_TRUNC)) == 0 && !is_unnamed) return open_now();
    const Recording recording;
    const bool is_new = !is_unnamed && inode_at(path) == 0;
    const int file = open_now();
    if (file < 0) return file;
    if (is_unnamed) recording.add("unnamed", inode_of(file), path, "", 0);
    if (is_new) recording.add("create", inode_of(file), path, "", 0);
    if (!is_unnamed && !is_new && (flags & O_TRUNC) != 0) {
        recording.add("truncate", inode_of(file), path, "", 0);
    }
    return file;
}

ssize_t write_watched(int file, const void* bytes, size_t size, off_t offset) {
    const auto write_now = [&](size_t count) {
        return offset < 0 ? ::syscall(SYS_write, file, bytes, count)
                          : ::syscall(SYS_pwrite64, file, bytes, count, offset);
    };
    char path[PATH_MAX];
    if (!is_watched(file, nullptr, path)) return write_now(size);
    if (is_counted(path) && fails(Call::Write)) {
        if (errno != static_cast<int>(kShort)) return -1;
        size = (size + 1) / 2;
    }
    const Recording recording;
    const off_t begin = offset >= 0 || shim.log < 0 ? offset : ::lseek(file, 0, SEEK_CUR);
    const ssize_t written = write_now(size);
    if (written > 0) {
        recording.add("write", inode_of(file), path, "", static_cast<uint64_t>(begin), bytes,
                      static_cast<size_t>(written));
    }
    return written;
}

int sync_watched(int file, long number) {
    if (fails_on(Call::Sync, file)) return -1;
    char path[PATH_MAX];
    if (!is_watched(file, nullptr, path)) return static_cast<int>(::syscall(number, file));
    const Recording recording;
    const int done = static_cast<int>(::syscall(number, file));
    if (done == 0) recording.add("sync", inode_of(file), path, "", 0);
    return done;
}

int rename_watched(int from_folder, const char* from, int to_folder, const char* to) {
    char from_path[PATH_MAX], to_path[PATH_MAX];
    const bool is_known =
        is_watched(from_folder, from, from_path) && is_watched(to_folder, to, to_path);
    if (is_known && is_counted(to_path) && fails(Call::Rename)) return -1;
    const Recording recording;
    const int done = static_cast<int>(::syscall(SYS_renameat, from_folder, from, to_folder, to));
    if (done == 0 && is_known) recording.add("rename", inode_at(to_path), from_path, to_path, 0);
    return done;
}

int link_watched(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    char path[PATH_MAX];
    const bool is_known = is_watched(to_folder, to, path);
    if (is_known && is_counted(path) && fails(Call::Link)) return -1;
    const Recording recording;
    const int done =
        static_cast<int>(::syscall(SYS_linkat, from_folder, from, to_folder, to, flags));
    if (done == 0 && is_known) recording.add("link", inode_at(path), path, "", 0);
    return done;
}

int unlink_watched(int folder, const char* name, int flags) {
    char path[PATH_MAX];
    const bool is_known = is_watched(folder, name, path);
    if (is_known && is_counted(path) && fails(Call::Unlink)) return -1;
    const Recording recording;
    const int done = static_cast<int>(::syscall(SYS_unlinkat, folder, name, flags));
    if (done == 0 && is_known) recording.add("unlink", 0, path, "", 0);
    return done;
}

int truncate_watched(int file, off_t size) {
    if (fails_on(Call::Truncate, file)) return -1;
    char path[PATH_MAX];
    const bool is_known = is_watched(file, nullptr, path);
    const Recording recording;
    const int done = static_cast<int>(::syscall(SYS_ftruncate, file, size));
    if (done == 0 && is_known) {
        recording.add("truncate", inode_of(file), path, "", static_cast<uint64_t>(size));
    }
    return done;
}

int make_folder_watched(int folder, const char* name, mode_t mode) {
    char path[PATH_MAX];
    const bool is_known = is_watched(folder, name, path);
    if (is_known && fails(Call::MakeFolder)) return -1;
    const Recording recording;
    const int done = static_cast<int>(::syscall(SYS_mkdirat, folder, name, mode));
    if (done == 0 && is_known) recording.add("mkdir", inode_at(path), path, "", 0);
    return done;
}

mode_t mode_of(int flags, va_list arguments) {
    const bool has_mode = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return has_mode ? va_arg(arguments, mode_t) : 0;
}

/// Files that C++ streams write. Other modes are not watched.
FILE* fopen_watched(const char* path, const char* mode) {
    char full[PATH_MAX];
    if (*mode == 'w' && is_watched(AT_FDCWD, path, full)) {
        const int file = open_watched(AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        return file < 0 ? nullptr : ::fdopen(file, mode);
    }
    static const auto next =
        reinterpret_cast<FILE* (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "fopen"));
    return next(path, mode);
}

}  // namespace
}  // namespace tetralight::faults

using namespace tetralight::faults;

// The names of the C library, which the program under test calls.
// NOLINTBEGIN(cert-dcl50-cpp)
extern "C" {

#define TETRALIGHT_OPEN(name)                             \
    int name(const char* path, int flags, ...) {          \
        va_list arguments;                                \
        va_start(arguments, flags);                       \
        const mode_t mode = mode_of(flags, arguments);    \
        va_end(arguments);                                \
        return open_watched(AT_FDCWD, path, flags, mode); \
    }
#define TETRALIGHT_OPENAT(name)                              \
    int name(int folder, const char* path, int flags, ...) { \
        va_list arguments;                                   \
        va_start(arguments, flags);                          \
        const mode_t mode = mode_of(flags, arguments);       \
        va_end(arguments);                                   \
        return open_watched(folder, path, flags, mode);      \
    }
TETRALIGHT_OPEN(open)
TETRALIGHT_OPEN(open64)
TETRALIGHT_OPENAT(openat)
TETRALIGHT_OPENAT(openat64)

FILE* fopen(const char* path, const char* mode) {
    return fopen_watched(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
    return fopen_watched(path, mode);
}

ssize_t writev(int file, const iovec* parts, int count) {
    char path[PATH_MAX];
    if (!is_watched(file, nullptr, path)) return ::syscall(SYS_writev, file, parts, count);
    ssize_t sum = 0;
    for (int i = 0; i < count; ++i) {
        const ssize_t written = write_watched(file, parts[i].iov_base, parts[i].iov_len, -1);
        if (written < 0) return sum > 0 ? sum : written;
        sum += written;
        if (static_cast<size_t>(written) < parts[i].iov_len) break;
    }
    return sum;
}

ssize_t read(int file, void* bytes, size_t size) {
    if (fails_on(Call::Read, file)) return -1;
    return ::syscall(SYS_read, file, bytes, size);
}

ssize_t pread(int file, void* bytes, size_t size, off_t offset) {
    if (fails_on(Call::Read, file)) return -1;
    return ::syscall(SYS_pread64, file, bytes, size, offset);
}

ssize_t pread64(int file, void* bytes, size_t size, off_t offset) {
    return pread(file, bytes, size, offset);
}

ssize_t write(int file, const void* bytes, size_t size) {
    return write_watched(file, bytes, size, -1);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
    return write_watched(file, bytes, size, offset);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off_t offset) {
    return write_watched(file, bytes, size, offset);
}

int fsync(int file) {
    return sync_watched(file, SYS_fsync);
}

int fdatasync(int file) {
    return sync_watched(file, SYS_fdatasync);
}

int rename(const char* from, const char* to) {
    return rename_watched(AT_FDCWD, from, AT_FDCWD, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
    return rename_watched(from_folder, from, to_folder, to);
}

int link(const char* from, const char* to) {
    return link_watched(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
    return link_watched(from_folder, from, to_folder, to, flags);
}

int unlink(const char* path) {
    return unlink_watched(AT_FDCWD, path, 0);
}

int rmdir(const char* path) {
    return unlink_watched(AT_FDCWD, path, AT_REMOVEDIR);
}

int unlinkat(int folder, const char* path, int flags) {
    return unlink_watched(folder, path, flags);
}

int remove(const char* path) {
    const int done = unlink_watched(AT_FDCWD, path, 0);
    return done != 0 && errno == EISDIR ? unlink_watched(AT_FDCWD, path, AT_REMOVEDIR) : done;
}

int stat(const char* path, struct stat* facts) {
    char full[PATH_MAX];
    (void)is_watched(AT_FDCWD, path, full);
    return static_cast<int>(::syscall(SYS_newfstatat, AT_FDCWD, path, facts, 0));
}

int access(const char* path, int mode) {
    char full[PATH_MAX];
    (void)is_watched(AT_FDCWD, path, full);
    return static_cast<int>(::syscall(SYS_faccessat, AT_FDCWD, path, mode));
}

int statvfs(const char* path, struct statvfs* disk) {
    char full[PATH_MAX];
    (void)is_watched(AT_FDCWD, path, full);
    static const auto next =
        reinterpret_cast<int (*)(const char*, struct statvfs*)>(::dlsym(RTLD_NEXT, "statvfs"));
    return next(path, disk);
}

int ftruncate(int file, off_t size) {
    return truncate_watched(file, size);
}

int ftruncate64(int file, off_t size) {
    return truncate_watched(file, size);
}

int mkdir(const char* path, mode_t mode) {
    return make_folder_watched(AT_FDCWD, path, mode);
}

void* mmap(void* address, size_t size, int protection, int flags, int file, off_t offset) {
    if (file >= 0 && fails_on(Call::Map, file)) return MAP_FAILED;
    return reinterpret_cast<void*>(
        ::syscall(SYS_mmap, address, size, protection, flags, file, offset));
}

void* mmap64(void* address, size_t size, int protection, int flags, int file, off_t offset) {
    return mmap(address, size, protection, flags, file, offset);
}

int accept(int listener, sockaddr* address, socklen_t* length) {
    if (fails(Call::Accept)) return -1;
    return static_cast<int>(::syscall(SYS_accept, listener, address, length));
}

int accept4(int listener, sockaddr* address, socklen_t* length, int flags) {
    if (fails(Call::Accept)) return -1;
    return static_cast<int>(::syscall(SYS_accept4, listener, address, length, flags));
}

pid_t fork() {
    if (fails(Call::Fork)) return -1;
    static const auto next = reinterpret_cast<pid_t (*)()>(::dlsym(RTLD_NEXT, "fork"));
    return next();
}

}  // extern "C"
// NOLINTEND(cert-dcl50-cpp)
