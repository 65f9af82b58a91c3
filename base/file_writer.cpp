// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/file_writer.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>
#include <vector>

#include <tetralight/base/descriptor_io.h>
#include <tetralight/base/file.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>

namespace tetralight {
namespace {

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

std::string folder_of(const std::string& path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

/// Makes names in a folder durable. True also where the file system cannot do that for folders.
bool sync_folder(const std::string& folder) {
    const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!descriptor) return errno == EACCES;  // a folder that may be written to, but not listed
    return ::fsync(descriptor.value()) == 0 || errno == EINVAL || errno == EROFS;
}

}  // namespace

Result<std::string> follow_links(const std::string& path) {
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

Result<FileWriter> FileWriter::open(const std::string& path) {
    FileWriter writer(path);
    if (path == "-") {
        writer.file_ = Descriptor(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0));
    } else if (is_special_file(path)) {
        writer.file_ = Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    } else {
        // A link stays, and what it leads to is replaced.
        auto target = follow_links(path);
        if (!target) return target.error();
        writer.target_ = std::move(*target);
        writer.open_beside();
    }
    if (!writer.file_) return system_error(path, "write");
    return writer;
}

bool FileWriter::open_beside() {
    file_ = Descriptor(::open(folder_of(target_).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    if (file_ && ::access(path_of_descriptor(file_).c_str(), F_OK) == 0) return true;
    std::string name = target_ + ".XXXXXX";
    file_ = Descriptor(::mkostemp(name.data(), O_CLOEXEC));
    if (file_) temporary_ = name;
    return static_cast<bool>(file_);
}

FileWriter::~FileWriter() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Status FileWriter::write(std::span<const std::byte> bytes) {
    if (!write_all(file_, bytes)) return system_error(path_, "write");
    return Ok{};
}

namespace {

Result<FileWriter> write_pieces(const std::string& path, FilePieces pieces) {
    auto writer = FileWriter::open(path);
    if (!writer) return writer;
    for (const auto piece : pieces) {
        if (auto status = writer->write(piece); !status) return status.error();
    }
    return writer;
}

}  // namespace

Status write_file(const std::string& path, FilePieces pieces) {
    auto writer = write_pieces(path, pieces);
    if (!writer) return writer.error();
    return writer->commit();
}

Status write_file(const std::string& path, std::span<const std::byte> bytes) {
    return write_file(path, std::span(&bytes, 1));
}

Status write_compared_file(const std::string& path, FilePieces pieces) {
    auto writer = write_pieces(path, pieces);
    if (!writer) return writer.error();
    return writer->commit(pieces);
}

Status FileWriter::commit() {
    if (target_.empty()) {
        if (!file_.close()) return system_error(path_, "write");
        return Ok{};
    }
    if (!sync_content() || !move_into_place()) return system_error(path_, "write");
    temporary_.clear();
    if (!sync_folder(folder_of(target_))) return system_error(path_, "write");
    return Ok{};
}

Status FileWriter::commit(FilePieces expected) {
    if (!target_.empty()) {
        if (!sync_content()) return system_error(path_, "write");
        if (auto status = compare_with(expected); !status) return status;
    }
    return commit();
}

bool FileWriter::sync_content() {
    return ::fchmod(file_.value(), final_mode(target_)) == 0 && ::fsync(file_.value()) == 0;
}

Status FileWriter::compare_with(FilePieces expected) const {
    constexpr size_t kBlockSize = 1 << 20;  // a mapped file would be in memory twice
    std::vector<std::byte> block(kBlockSize);
    const Error differs{ErrorCode::Corrupt,
                        str_cat(shown_path(path_),
                                ": was not replaced, as other bytes came back than were written")};
    if (::lseek(file_.value(), 0, SEEK_SET) != 0) return system_error(path_, "read");
    for (std::span<const std::byte> rest : expected) {
        while (!rest.empty()) {
            const auto wanted = rest.first(std::min(rest.size(), kBlockSize));
            const auto count = read_up_to(file_, std::span(block).first(wanted.size()));
            if (!count) return system_error(path_, "read");
            if (*count != wanted.size() || std::memcmp(wanted.data(), block.data(), *count) != 0) {
                return differs;
            }
            rest = rest.subspan(wanted.size());
        }
    }
    const auto more = read_up_to(file_, std::span(block).first(1));
    if (!more) return system_error(path_, "read");
    return *more == 0 ? Status(Ok{}) : differs;
}

bool FileWriter::move_into_place() {
    return give_name() && file_.close() && ::rename(temporary_.c_str(), target_.c_str()) == 0;
}

/// A name that no file has: a link, unlike a rename, does not replace one.
bool FileWriter::give_name() {
    if (!temporary_.empty()) return true;
    constexpr int kMostTries = 1000;
    const std::string unnamed = path_of_descriptor(file_);
    for (int i = 0; i < kMostTries; ++i) {
        const std::string name =
            target_ + "." + std::to_string(::getpid()) + "." + std::to_string(i);
        if (::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
            temporary_ = name;
            return true;
        }
        if (errno != EEXIST) return false;
    }
    return false;
}

}  // namespace tetralight
