// SPDX-License-Identifier: Apache-2.0
// Files of Windows. Paths are UTF-8.
#ifndef NOMINMAX
#define NOMINMAX  // windows.h defines min and max as macros otherwise
#endif
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#include <winioctl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include <tetralight/base/detail/file_system.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr DWORD kDiskQuotaExceeded = 1295;  // headers of MinGW 10 lack its name

ErrorCode error_code_of(DWORD number) noexcept {
    switch (number) {
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
        case ERROR_INVALID_DRIVE:
        case ERROR_BAD_NETPATH:
        case ERROR_BAD_NET_NAME:
            return ErrorCode::NotFound;
        case ERROR_DISK_FULL:
        case ERROR_HANDLE_DISK_FULL:
        case kDiskQuotaExceeded:
            return ErrorCode::DiskFull;
        case ERROR_TOO_MANY_OPEN_FILES:
        case ERROR_NOT_ENOUGH_MEMORY:
        case ERROR_OUTOFMEMORY:
        case ERROR_NO_SYSTEM_RESOURCES:
        case ERROR_COMMITMENT_LIMIT:
            return ErrorCode::OutOfResources;
        case ERROR_INVALID_NAME:
        case ERROR_BAD_PATHNAME:
        case ERROR_FILENAME_EXCED_RANGE:
        case ERROR_DIRECTORY:
        case ERROR_INVALID_PARAMETER:
        case ERROR_FILE_TOO_LARGE:
            return ErrorCode::InvalidArgument;
        default:
            return ErrorCode::Unavailable;
    }
}

std::string utf8_of(std::wstring_view text) {
    const int length = static_cast<int>(text.size());
    const int size =
        ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, nullptr, 0, nullptr, nullptr);
    std::string bytes(static_cast<size_t>(size), '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, bytes.data(), size, nullptr, nullptr);
    return bytes;
}

/// The system's text for an error, without the full stop and the line break at its end.
std::string text_of(DWORD number) {
    std::array<wchar_t, 512> memory{};
    constexpr DWORD kFlags = FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS;
    const DWORD length = ::FormatMessageW(kFlags, nullptr, number, 0, memory.data(),
                                          static_cast<DWORD>(memory.size()), nullptr);
    const std::string text = utf8_of({memory.data(), length});
    const std::string line = text.substr(0, text.find_last_not_of(". \r\n") + 1);
    return line.empty() ? str_cat("error ", number) : line;
}

/// Why a call about `path` failed, from GetLastError().
Error windows_error(const std::string& path, const char* what) {
    const DWORD number = ::GetLastError();
    return {error_code_of(number), "", path,
            str_cat(shown_path(path), ": cannot ", what, " (", text_of(number), ")")};
}

Result<std::wstring> wide(const std::string& path) {
    const int length = static_cast<int>(path.size());
    const int size =
        ::MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path.data(), length, nullptr, 0);
    if (size == 0 && length > 0) {
        return Error{ErrorCode::InvalidArgument, "", path,
                     shown_path(path) + ": the path is not UTF-8"};
    }
    std::wstring text(static_cast<size_t>(size), L'\0');
    ::MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path.data(), length, text.data(), size);
    return text;
}

/// The same path from its drive on. With the prefix for long paths if it needs it: the system then
/// takes more than 260 characters.
std::wstring full_path(const std::wstring& path) {
    const DWORD size = ::GetFullPathNameW(path.c_str(), 0, nullptr, nullptr);
    std::wstring full(size, L'\0');
    full.resize(::GetFullPathNameW(path.c_str(), size, full.data(), nullptr));
    constexpr size_t kLongestPlain = 240;  // the names of temporary files are longer
    if (full.empty() || full.size() < kLongestPlain || full.starts_with(L"\\\\?\\")) return full;
    if (full.starts_with(L"\\\\.\\")) return full;  // a device
    if (full.starts_with(L"\\\\")) return L"\\\\?\\UNC" + full.substr(1);
    return L"\\\\?\\" + full;
}

Result<std::wstring> system_path(const std::string& path) {
    auto text = wide(path);
    if (!text) return text.error();
    auto full = full_path(*text);
    if (full.empty()) return windows_error(path, "open");
    return full;
}

bool is_folder(const std::wstring& path) {
    const DWORD attributes = ::GetFileAttributesW(path.c_str());
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

/// Owns a handle of the system.
class Handle {
  public:
    explicit Handle(HANDLE handle = INVALID_HANDLE_VALUE) noexcept : handle_(handle) {}

    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, INVALID_HANDLE_VALUE)) {}

    Handle& operator=(Handle&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }

    ~Handle() { close(); }

    [[nodiscard]] HANDLE get() const { return handle_; }

    [[nodiscard]] bool is_open() const {
        return handle_ != INVALID_HANDLE_VALUE && handle_ != nullptr;
    }

    bool close() {
        if (!is_open()) return true;
        return ::CloseHandle(std::exchange(handle_, INVALID_HANDLE_VALUE)) != 0;
    }

  private:
    HANDLE handle_;
};

struct InputFile {
    Handle handle;
    size_t size = 0;
};

/// Opens a regular file for reading; a folder or a device is an error, not a surprise later.
Result<InputFile> open_input(const std::string& path) {
    const auto name = system_path(path);
    if (!name) return name.error();
    constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    InputFile file{Handle(::CreateFileW(name->c_str(), GENERIC_READ, kShare, nullptr, OPEN_EXISTING,
                                        FILE_ATTRIBUTE_NORMAL, nullptr))};
    if (!file.handle.is_open()) {
        const Error error = windows_error(path, "open");
        return is_folder(*name) ? not_a_regular_file(path, true) : error;
    }
    if (::GetFileType(file.handle.get()) != FILE_TYPE_DISK) return not_a_regular_file(path, false);
    LARGE_INTEGER bytes;
    if (::GetFileSizeEx(file.handle.get(), &bytes) == 0) return windows_error(path, "read");
    const auto size = size_in_memory(path, static_cast<uint64_t>(bytes.QuadPart));
    if (!size) return size.error();
    file.size = *size;
    return file;
}

/// Bytes of one call, whose sizes have 32 bits.
DWORD call_size(size_t size) {
    return static_cast<DWORD>(std::min(size, size_t{1} << 30));
}

/// Reads until `memory` is full or the file ends.
Result<size_t> read_up_to(const Handle& file, std::span<std::byte> memory,
                          const std::string& path) {
    size_t done = 0;
    while (done < memory.size()) {
        DWORD count = 0;
        if (::ReadFile(file.get(), memory.data() + done, call_size(memory.size() - done), &count,
                       nullptr) == 0) {
            return windows_error(path, "read");
        }
        if (count == 0) break;
        done += count;
    }
    return done;
}

/// Opens a file or a folder to ask about it, not to read it.
Handle open_to_ask(const std::wstring& path, DWORD flags) {
    constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    return Handle(::CreateFileW(path.c_str(), FILE_READ_ATTRIBUTES, kShare, nullptr, OPEN_EXISTING,
                                FILE_FLAG_BACKUP_SEMANTICS | flags, nullptr));
}

/// The path without its links; empty if it leads to nothing.
std::wstring without_links(const std::wstring& path) {
    const Handle file = open_to_ask(path, 0);
    if (!file.is_open()) return {};
    const DWORD size = ::GetFinalPathNameByHandleW(file.get(), nullptr, 0, FILE_NAME_NORMALIZED);
    std::wstring end(size, L'\0');
    end.resize(::GetFinalPathNameByHandleW(file.get(), end.data(), size, FILE_NAME_NORMALIZED));
    return end;
}

bool is_link(const std::wstring& path) {
    const DWORD attributes = ::GetFileAttributesW(path.c_str());
    return attributes != INVALID_FILE_ATTRIBUTES &&
           (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
}

/// How the data of a symbolic link begin (REPARSE_DATA_BUFFER of Windows' driver kit). Names
/// follow; places and sizes are bytes.
struct LinkData {
    DWORD tag;
    WORD size, reserved;
    WORD target_place, target_size;
    WORD shown_place, shown_size;
    DWORD flags;
};

static_assert(sizeof(LinkData) == 20);

/// The path that a symbolic link holds, from its drive on; empty if it is not known.
std::wstring target_of_link(const std::wstring& link) {
    const Handle file = open_to_ask(link, FILE_FLAG_OPEN_REPARSE_POINT);
    std::array<std::byte, MAXIMUM_REPARSE_DATA_BUFFER_SIZE> memory;
    DWORD size = 0;
    if (!file.is_open() ||
        ::DeviceIoControl(file.get(), FSCTL_GET_REPARSE_POINT, nullptr, 0, memory.data(),
                          static_cast<DWORD>(memory.size()), &size, nullptr) == 0 ||
        size < sizeof(LinkData)) {
        return {};
    }
    LinkData data;
    std::memcpy(&data, memory.data(), sizeof data);
    const size_t begin = sizeof data + data.target_place;
    if (data.tag != IO_REPARSE_TAG_SYMLINK || begin + data.target_size > size) return {};
    std::wstring target(data.target_size / sizeof(wchar_t), L'\0');
    std::memcpy(target.data(), memory.data() + begin, target.size() * sizeof(wchar_t));
    constexpr DWORD kIsRelative = 1;
    if ((data.flags & kIsRelative) != 0) {
        // From the link's folder, or from its drive.
        const size_t end = target.starts_with(L'\\') ? link.find(L':') : link.rfind(L'\\');
        return end == std::wstring::npos ? L"" : full_path(link.substr(0, end + 1) + target);
    }
    // The kernel's prefix of a path from its drive on.
    return target.starts_with(L"\\??\\") ? L"\\\\?\\" + target.substr(4) : target;
}

Error link_error(const std::string& path, const char* why) {
    return {ErrorCode::InvalidArgument, "", path,
            str_cat(shown_path(path), ": cannot write (", why, ")")};
}

/// See `follow_links` in file_writer.h. The links may lead to a file that does not exist.
Result<std::wstring> end_of_links(const std::string& path, std::wstring end) {
    constexpr int kMostLinks = 40;  // as many as POSIX systems follow
    for (int i = 0; i < kMostLinks; ++i) {
        if (!is_link(end)) return end;
        std::wstring next = without_links(end);
        if (!next.empty()) return next;
        next = target_of_link(end);
        if (next.empty()) return link_error(path, "its link cannot be followed");
        end = std::move(next);
    }
    return link_error(path, "its symbolic links form a cycle");
}

class WindowsFile final : public NewFile {
  public:
    explicit WindowsFile(const std::string& path) : name_(output_name(path)) {}

    WindowsFile(const WindowsFile&) = delete;
    WindowsFile& operator=(const WindowsFile&) = delete;

    ~WindowsFile() override {
        file_.close();
        if (!temporary_.empty()) ::DeleteFileW(temporary_.c_str());
    }

    Status open_standard_output() {
        HANDLE copy = INVALID_HANDLE_VALUE;
        const HANDLE process = ::GetCurrentProcess();
        const bool has_copy = ::DuplicateHandle(process, ::GetStdHandle(STD_OUTPUT_HANDLE), process,
                                                &copy, 0, FALSE, DUPLICATE_SAME_ACCESS) != 0;
        file_ = Handle(has_copy ? copy : INVALID_HANDLE_VALUE);
        return result_of(file_.is_open());
    }

    Status open_device(const std::wstring& path) {
        file_ =
            Handle(::CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE,
                                 nullptr, OPEN_EXISTING, 0, nullptr));
        return result_of(file_.is_open());
    }

    Status open_beside(std::wstring target) {
        target_ = std::move(target);
        constexpr int kMostTries = 1000;
        const std::wstring begin = target_ + L"." + std::to_wstring(::GetCurrentProcessId()) + L".";
        for (int i = 0; i < kMostTries; ++i) {
            const std::wstring name = begin + std::to_wstring(i);
            file_ =
                Handle(::CreateFileW(name.c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ,
                                     nullptr, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr));
            if (file_.is_open()) {
                temporary_ = name;
                return Ok{};
            }
            if (::GetLastError() != ERROR_FILE_EXISTS) break;
        }
        return result_of(false);
    }

    [[nodiscard]] bool is_replacement() const noexcept override { return !target_.empty(); }

    [[nodiscard]] Status write(std::span<const std::byte> bytes) override {
        while (!bytes.empty()) {
            DWORD count = 0;
            if (::WriteFile(file_.get(), bytes.data(), call_size(bytes.size()), &count, nullptr) ==
                    0 ||
                count == 0) {
                return result_of(false);
            }
            bytes = bytes.subspan(count);
        }
        return Ok{};
    }

    [[nodiscard]] Status rewind() override {
        if (::SetFilePointerEx(file_.get(), LARGE_INTEGER{}, nullptr, FILE_BEGIN) == 0) {
            return windows_error(name_, "read");
        }
        return Ok{};
    }

    [[nodiscard]] Result<size_t> read(std::span<std::byte> memory) override {
        return read_up_to(file_, memory, name_);
    }

    [[nodiscard]] Status sync() override { return result_of(::FlushFileBuffers(file_.get()) != 0); }

    [[nodiscard]] Status commit() override {
        return result_of(file_.close() && (!is_replacement() || move_into_place()));
    }

  private:
    [[nodiscard]] Status result_of(bool has_succeeded) const {
        if (!has_succeeded) return windows_error(name_, "write");
        return Ok{};
    }

    /// A virus scanner may have the new file open for a moment.
    bool move_into_place() {
        constexpr int kMostTries = 10;
        constexpr DWORD kFlags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
        for (int i = 0; i < kMostTries; ++i) {
            if (::MoveFileExW(temporary_.c_str(), target_.c_str(), kFlags) != 0) {
                temporary_.clear();
                return true;
            }
            const DWORD number = ::GetLastError();
            if (number != ERROR_SHARING_VIOLATION && number != ERROR_ACCESS_DENIED) return false;
            ::Sleep(10);
        }
        ::SetLastError(ERROR_ACCESS_DENIED);
        return false;
    }

    std::string name_;        ///< as messages say it
    std::wstring target_;     ///< what is replaced; empty: written to in place
    std::wstring temporary_;  ///< beside the target
    Handle file_;
};

Status open_output(WindowsFile& file, const std::string& path) {
    if (path == "-") return file.open_standard_output();
    auto target = system_path(path);
    if (!target) return target.error();
    if (target->starts_with(L"\\\\.\\")) return file.open_device(*target);
    if (is_folder(*target)) return not_a_regular_file(path, true);
    // A link stays, and what it leads to is replaced.
    target = end_of_links(path, std::move(*target));
    if (!target) return target.error();
    return file.open_beside(std::move(*target));
}

}  // namespace

Result<std::vector<std::byte>> read_whole_file(const std::string& path) {
    const auto file = open_input(path);
    if (!file) return file.error();
    std::vector<std::byte> bytes(file->size);
    const auto count = read_up_to(file->handle, bytes, path);
    if (!count) return count.error();
    bytes.resize(*count);
    return bytes;
}

Result<std::span<const std::byte>> map_file(const std::string& path) {
    const auto file = open_input(path);
    if (!file) return file.error();
    if (file->size == 0) return std::span<const std::byte>();
    const Handle mapping(
        ::CreateFileMappingW(file->handle.get(), nullptr, PAGE_READONLY, 0, 0, nullptr));
    if (!mapping.is_open()) return windows_error(path, "map");
    const void* address = ::MapViewOfFile(mapping.get(), FILE_MAP_READ, 0, 0, file->size);
    if (address == nullptr) return windows_error(path, "map");
    return std::span(static_cast<const std::byte*>(address), file->size);
}

void unmap_file(std::span<const std::byte> bytes) noexcept {
    ::UnmapViewOfFile(bytes.data());
}

void release_mapped_pages(std::span<const std::byte> bytes) noexcept {
    // Of pages that are not locked this call removes those that are in the working set.
    (void)::VirtualUnlock(const_cast<std::byte*>(bytes.data()), bytes.size());
}

Result<std::string> follow_file_links(const std::string& path) {
    const auto name = system_path(path);
    if (!name) return name.error();
    if (!is_link(*name)) return path;
    const auto end = end_of_links(path, *name);
    if (!end) return end.error();
    return utf8_of(*end);
}

Result<std::unique_ptr<NewFile>> open_new_file(const std::string& path) {
    auto file = std::make_unique<WindowsFile>(path);
    if (auto status = open_output(*file, path); !status) return status.error();
    return std::unique_ptr<NewFile>(std::move(file));
}

}  // namespace tetralight::detail
