// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/tar.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include <tetralight/base/contract.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/file_ids.h>

namespace tetralight::server {
namespace {

constexpr size_t kBlock = 512;
constexpr std::array<std::byte, kBlock> kZeros{};

/// The first block of an entry.
struct TarHeader {
    char name[100];
    char mode[8];
    char user[8];
    char group[8];
    char size[12];
    char time[12];
    char checksum[8];
    char type;
    char link[100];
    char magic[8];
    char names_of_owners[64];
    char device[16];
    char prefix[155];
    char rest[12];
};

static_assert(sizeof(TarHeader) == kBlock);

/// Octal digits and a zero byte; sizes from 8 GiB on in bytes, as GNU tar writes them.
void put_number(std::span<char> field, uint64_t number) {
    const size_t digits = field.size() - 1;
    if (digits * 3 >= 64 || number < uint64_t{1} << (digits * 3)) {
        for (size_t i = digits; i-- > 0; number /= 8)
            field[i] = static_cast<char>('0' + number % 8);
        return;
    }
    for (size_t i = field.size(); i-- > 1; number /= 256)
        field[i] = static_cast<char>(number % 256);
    field[0] = '\x80';
}

std::optional<uint64_t> number_in(std::span<const char> field) {
    uint64_t number = 0;
    if (field[0] == '\x80') {
        for (const char c : field.subspan(1)) {
            if (number >> 55 != 0) return std::nullopt;
            number = number * 256 + static_cast<unsigned char>(c);
        }
        return number;
    }
    for (const char c : field) {
        if (c == '\0' || c == ' ') break;
        if (c < '0' || c > '7' || number >> 60 != 0) return std::nullopt;
        number = number * 8 + static_cast<uint64_t>(c - '0');
    }
    return number;
}

uint64_t checksum_of(TarHeader header) {
    std::memset(header.checksum, ' ', sizeof header.checksum);
    uint64_t sum = 0;
    for (const std::byte byte : std::as_bytes(std::span(&header, 1))) sum += uint64_t(byte);
    return sum;
}

uint64_t padding_after(uint64_t size) {
    return (kBlock - size % kBlock) % kBlock;
}

std::string text_in(std::span<const char> field) {
    return {field.data(), static_cast<size_t>(std::ranges::find(field, '\0') - field.begin())};
}

/// Why a name of an archive is refused; null if it stays below a folder and is written plainly.
const char* fault_of(const std::string& name) {
    if (name.empty()) return "a file in it has no name";
    const bool is_text = std::ranges::none_of(
        name, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\\'; });
    if (!is_text) return "has control characters or backslashes in its name";
    if (name.starts_with('/')) return "is an absolute name, which this program never stores";
    const char* fault = nullptr;
    for (size_t begin = 0; begin <= name.size();) {
        const size_t end = std::min(name.find('/', begin), name.size());
        const std::string part = name.substr(begin, end - begin);
        if (part == "..") return "leads out of the folder";
        if (part.empty() || part == ".") {
            fault = "is a name with \".\" or \"//\", which this program never stores";
        }
        begin = end + 1;
    }
    return fault;
}

/// Where a long name is split into its two fields; 0 if all of it fits into one, nothing if it does
/// not fit at all.
std::optional<size_t> split_of(const std::string& name) {
    if (name.size() <= sizeof TarHeader::name) return 0;
    const size_t slash = name.find('/', name.size() - sizeof TarHeader::name - 1);
    if (slash == std::string::npos || slash > sizeof TarHeader::prefix) return std::nullopt;
    return slash;
}

TarHeader header_of(const TarEntry& entry) {
    TarHeader header = {};
    const size_t split = split_of(entry.name).value_or(0);
    const std::string last = split == 0 ? entry.name : entry.name.substr(split + 1);
    std::memcpy(header.name, last.data(), last.size());
    std::memcpy(header.prefix, entry.name.data(), split);
    put_number(header.mode, 0644);
    put_number(header.user, 0);
    put_number(header.group, 0);
    put_number(header.size, entry.size);
    put_number(header.time, static_cast<uint64_t>(std::max<int64_t>(entry.time, 0)));
    header.type = '0';
    std::memcpy(header.magic, "ustar\00000", 8);
    put_number(std::span(header.checksum).first(7), checksum_of(header));
    header.checksum[7] = ' ';
    return header;
}

bool is_zero(std::span<const std::byte> bytes) {
    return std::ranges::all_of(bytes, [](std::byte byte) { return byte == std::byte{0}; });
}

}  // namespace

Result<TarWriter> TarWriter::open(const std::string& path) {
    auto writer = FileWriter::open(path);
    if (!writer) return writer.error();
    return TarWriter(std::move(*writer));
}

bool TarWriter::can_hold(const std::string& name) {
    return split_of(name).has_value();
}

Status TarWriter::begin(const TarEntry& entry) {
    TETRALIGHT_ASSERT(left_ == 0 && can_hold(entry.name), "the file before is whole");
    const TarHeader header = header_of(entry);
    left_ = entry.size;
    padding_ = padding_after(entry.size);
    return writer_.write(std::as_bytes(std::span(&header, 1)));
}

Status TarWriter::write(std::span<const std::byte> bytes) {
    TETRALIGHT_ASSERT(bytes.size() <= left_, "the file is not larger than its entry says");
    left_ -= bytes.size();
    if (auto status = writer_.write(bytes); !status || left_ > 0) return status;
    return writer_.write(std::span(kZeros).first(std::exchange(padding_, 0)));
}

Status TarWriter::commit() {
    if (auto status = writer_.write(std::array<std::byte, 2 * kBlock>{}); !status) return status;
    return writer_.commit();
}

Result<TarReader> TarReader::open(const std::string& path) {
    if (path == "-") {
        Descriptor input(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0));
        if (!input) return system_error("stdin", "read");
        return TarReader("stdin", std::move(input));
    }
    auto file = open_regular(path);
    if (!file && file.error().code == ErrorCode::InvalidArgument) {
        return Error{ErrorCode::InvalidArgument, "archive", path,
                     shown_path(path) + ": is not a regular file (- reads from stdin)"};
    }
    if (!file) return file.error();
    return TarReader(path, std::move(*file));
}

Error TarReader::corrupt(const std::string& reason) const {
    return {ErrorCode::Corrupt, shown_path(path_) + ": " + reason};
}

/// Returns when there are bytes or none will come. Looks at `is_stopped_` once a second, as a
/// signal may arrive just before the wait.
Status TarReader::wait() const {
    pollfd input{file_.value(), POLLIN, 0};
    while (!is_stopped_()) {
        if (::poll(&input, 1, 1000) > 0) return Ok{};
    }
    return Error{ErrorCode::Cancelled, shown_path(path_) + ": interrupted"};
}

/// At least one byte, but at the end.
Result<size_t> TarReader::read_some(std::span<std::byte> memory) {
    if (auto status = wait(); !status) return status.error();
    ssize_t count = 0;
    do {
        count = ::read(file_.value(), memory.data(), memory.size());
    } while (count < 0 && errno == EINTR);
    if (count < 0) return system_error(path_, "read");
    offset_ += static_cast<uint64_t>(count);
    return static_cast<size_t>(count);
}

Status TarReader::fill(std::span<std::byte> memory) {
    while (!memory.empty()) {
        const auto count = read_some(memory);
        if (!count) return count.error();
        if (*count == 0) return corrupt(str_cat("is cut off at byte ", offset_));
        memory = memory.subspan(*count);
    }
    return Ok{};
}

/// Of the file before, with what of it was not read.
Status TarReader::skip_padding() {
    std::vector<std::byte> rest(std::min<uint64_t>(left_ + padding_, size_t{1} << 20));
    for (uint64_t skipped = left_ + padding_; skipped > 0;) {
        const auto piece = std::span(rest).first(std::min<uint64_t>(rest.size(), skipped));
        if (auto status = fill(piece); !status) return status;
        skipped -= piece.size();
    }
    left_ = padding_ = 0;
    return Ok{};
}

/// An archive ends with blocks of zeros. Whatever follows was appended or is another archive.
Status TarReader::check_end() {
    std::vector<std::byte> memory(size_t{1} << 16);
    for (bool is_first = true;; is_first = false) {
        const uint64_t begin = offset_;
        const auto count = read_some(memory);
        if (!count) return count.error();
        if (*count == 0 && is_first) return corrupt(str_cat("is cut off at byte ", offset_));
        if (*count == 0) return Ok{};
        if (is_zero(std::span(memory).first(*count))) continue;
        return corrupt(str_cat("goes on after the end of the archive, after byte ", begin));
    }
}

Result<std::optional<TarEntry>> TarReader::next() {
    if (auto status = skip_padding(); !status) return status.error();
    const uint64_t begin = offset_;
    TarHeader header;
    if (auto status = fill(std::as_writable_bytes(std::span(&header, 1))); !status) {
        return status.error();
    }
    if (is_zero(std::as_bytes(std::span(&header, 1)))) {
        if (auto status = check_end(); !status) return status.error();
        return std::optional<TarEntry>();
    }
    const auto size = number_in(header.size), time = number_in(header.time);
    const auto sum = number_in(header.checksum);
    if (!size || !time || !sum || *sum != checksum_of(header)) {
        return corrupt(begin == 0 ? "is not a tar archive"
                                  : str_cat("is damaged: byte ", begin, " begins no file"));
    }
    const std::string prefix = text_in(header.prefix);
    TarEntry entry{(prefix.empty() ? "" : prefix + "/") + text_in(header.name), *size,
                   static_cast<int64_t>(*time)};
    const std::string shown = shown_path(entry.name);
    if (header.type != '0' && header.type != '\0') {
        return corrupt(shown + " is a link, a folder or a device, which this program never stores");
    }
    if (const char* fault = fault_of(entry.name)) {
        return corrupt(entry.name.empty() ? fault : shown + " " + fault);
    }
    left_ = entry.size;
    padding_ = padding_after(entry.size);
    return std::optional(entry);
}

Result<std::span<const std::byte>> TarReader::read(std::span<std::byte> memory) {
    memory = memory.first(std::min<uint64_t>(memory.size(), left_));
    if (auto status = fill(memory); !status) return status.error();
    left_ -= memory.size();
    return std::span<const std::byte>(memory);
}

}  // namespace tetralight::server
