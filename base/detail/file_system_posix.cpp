// SPDX-License-Identifier: Apache-2.0
// Files of Linux, macOS and other systems with POSIX.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include <tetralight/base/detail/file_system.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/system_error.h>

namespace tetralight::detail {
namespace {

/// Owns an open file.
class OpenFile {
  public:
    explicit OpenFile(int descriptor = -1) noexcept : descriptor_(descriptor) {}

    OpenFile(const OpenFile&) = delete;

    OpenFile& operator=(OpenFile&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }

    ~OpenFile() { close(); }

    [[nodiscard]] int descriptor() const { return descriptor_; }

    [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }

    bool close() {
        const int descriptor = std::exchange(descriptor_, -1);
        return descriptor < 0 || ::close(descriptor) == 0;
    }

  private:
    int descriptor_;
};

/// Opens a regular file for reading; a folder or a device is an error, not a surprise later.
Result<size_t> regular_file_size(const OpenFile& file, const std::string& path) {
    if (!file.is_open()) return system_error(path, "open");
    struct stat status = {};
    if (::fstat(file.descriptor(), &status) != 0) return system_error(path, "read");
    if (!S_ISREG(status.st_mode)) return not_a_regular_file(path, S_ISDIR(status.st_mode));
    return size_in_memory(path, static_cast<uint64_t>(status.st_size));
}

/// Reads until `memory` is full or the file ends, across interrupted calls.
Result<size_t> read_up_to(const OpenFile& file, std::span<std::byte> memory,
                          const std::string& path) {
    size_t done = 0;
    while (done < memory.size()) {
        const ssize_t count = ::read(file.descriptor(), memory.data() + done, memory.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return system_error(path, "read");
        if (count == 0) break;
        done += static_cast<size_t>(count);
    }
    return done;
}

std::string folder_of(const std::string& path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

bool is_special_file(const std::string& path) {
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
           !S_ISDIR(status.st_mode);
}

/// The permissions that a plain open() would have given a new file, or those of the old one.
mode_t final_mode(const std::string& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0) return status.st_mode & 07777;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

/// Makes names in a folder durable. True also where the file system cannot do that for folders.
bool sync_folder(const std::string& folder) {
    const OpenFile file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!file.is_open()) return errno == EACCES;  // a folder that may be written to, but not listed
    return ::fsync(file.descriptor()) == 0 || errno == EINVAL || errno == EROFS;
}

class PosixFile final : public NewFile {
  public:
    explicit PosixFile(const std::string& path) : name_(output_name(path)) {}

    PosixFile(const PosixFile&) = delete;
    PosixFile& operator=(const PosixFile&) = delete;

    ~PosixFile() override {
        if (!temporary_.empty()) ::unlink(temporary_.c_str());
    }

    Status open_in_place(int descriptor) {
        file_ = OpenFile(descriptor);
        return result_of(file_.is_open());
    }

    Status open_beside(std::string target) {
        target_ = std::move(target);
        return result_of(open_unnamed() || open_named());
    }

    [[nodiscard]] bool is_replacement() const noexcept override { return !target_.empty(); }

    [[nodiscard]] Status write(std::span<const std::byte> bytes) override {
        while (!bytes.empty()) {
            const ssize_t written = ::write(file_.descriptor(), bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) return system_error(name_, "write");
            bytes = bytes.subspan(static_cast<size_t>(written));
        }
        return Ok{};
    }

    [[nodiscard]] Status rewind() override {
        if (::lseek(file_.descriptor(), 0, SEEK_SET) != 0) return system_error(name_, "read");
        return Ok{};
    }

    [[nodiscard]] Result<size_t> read(std::span<std::byte> memory) override {
        return read_up_to(file_, memory, name_);
    }

    [[nodiscard]] Status sync() override {
        return result_of(::fchmod(file_.descriptor(), final_mode(target_)) == 0 &&
                         ::fsync(file_.descriptor()) == 0);
    }

    [[nodiscard]] Status commit() override {
        return result_of(is_replacement() ? move_into_place() : file_.close());
    }

  private:
    [[nodiscard]] Status result_of(bool has_succeeded) const {
        if (!has_succeeded) return system_error(name_, "write");
        return Ok{};
    }

    /// A file without a name, where the system has these: nothing remains of a killed process.
    bool open_unnamed() {
#ifdef O_TMPFILE
        file_ = OpenFile(::open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
        return file_.is_open() && ::access(path_of_descriptor().c_str(), F_OK) == 0;
#else
        return false;
#endif
    }

    bool open_named() {
        std::string name = target_ + ".XXXXXX";
        file_ = OpenFile(::mkostemp(name.data(), O_CLOEXEC));
        if (file_.is_open()) temporary_ = name;
        return file_.is_open();
    }

    [[nodiscard]] std::string path_of_descriptor() const {
        return "/proc/self/fd/" + std::to_string(file_.descriptor());
    }

    bool move_into_place() {
        if (!give_name() || !file_.close()) return false;
        if (::rename(temporary_.c_str(), target_.c_str()) != 0) return false;
        temporary_.clear();
        return sync_folder(folder_of(target_));
    }

    /// A name that no file has: a link, unlike a rename, does not replace one.
    bool give_name() {
        if (!temporary_.empty()) return true;
        constexpr int kMostTries = 1000;
        const std::string unnamed = path_of_descriptor();
        for (int i = 0; i < kMostTries; ++i) {
            const std::string name =
                target_ + "." + std::to_string(::getpid()) + "." + std::to_string(i);
            if (::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) ==
                0) {
                temporary_ = name;
                return true;
            }
            if (errno != EEXIST) return false;
        }
        return false;
    }

    std::string name_;       ///< as messages say it
    std::string target_;     ///< what is replaced; empty: written to in place
    std::string temporary_;  ///< beside the target; empty: the file has no name yet
    OpenFile file_;
};

Status open_output(PosixFile& file, const std::string& path) {
    if (path == "-") return file.open_in_place(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
    if (is_special_file(path)) {
        return file.open_in_place(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    }
    // A link stays, and what it leads to is replaced.
    auto target = follow_file_links(path);
    if (!target) return target.error();
    return file.open_beside(std::move(*target));
}

}  // namespace

Result<std::vector<std::byte>> read_whole_file(const std::string& path) {
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto size = regular_file_size(file, path);
    if (!size) return size.error();
    std::vector<std::byte> bytes(*size);
    const auto count = read_up_to(file, bytes, path);
    if (!count) return count.error();
    bytes.resize(*count);
    return bytes;
}

Result<std::span<const std::byte>> map_file(const std::string& path) {
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    const auto size = regular_file_size(file, path);
    if (!size) return size.error();
    if (*size == 0) return std::span<const std::byte>();
    void* address = ::mmap(nullptr, *size, PROT_READ, MAP_PRIVATE, file.descriptor(), 0);
    if (address == MAP_FAILED) return system_error(path, "map");
    return std::span(static_cast<const std::byte*>(address), *size);
}

void unmap_file(std::span<const std::byte> bytes) noexcept {
    ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

void release_mapped_pages(std::span<const std::byte> bytes) noexcept {
    // Pages of a private mapping that were never written are read from the file again.
    (void)::madvise(const_cast<std::byte*>(bytes.data()), bytes.size(), MADV_DONTNEED);
}

Result<std::string> follow_file_links(const std::string& path) {
    constexpr int kMostLinks = 40;  // as many as the system follows
    std::string end = path;
    for (int i = 0; i < kMostLinks; ++i) {
        char memory[PATH_MAX];
        const ssize_t length = ::readlink(end.c_str(), memory, sizeof memory);
        if (length < 0) return end;
        const std::string link(memory, static_cast<size_t>(length));
        end = link.starts_with('/') ? link : end.substr(0, end.rfind('/') + 1) + link;
    }
    return Error{ErrorCode::InvalidArgument,
                 shown_path(path) + ": cannot write (its symbolic links form a cycle)"};
}

Result<std::unique_ptr<NewFile>> open_new_file(const std::string& path) {
    auto file = std::make_unique<PosixFile>(path);
    if (auto status = open_output(*file, path); !status) return status.error();
    return std::unique_ptr<NewFile>(std::move(file));
}

}  // namespace tetralight::detail
