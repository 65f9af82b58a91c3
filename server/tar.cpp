// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/tar.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include <tetralight/base/descriptor_io.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/system_error.h>

namespace tetralight::server {
namespace {

constexpr size_t kBlock = 512;
using Block = std::array<std::byte, kBlock>;

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

/// False for absolute names, for those with "..", ".", empty parts or control characters.
bool is_below(const std::string& name) {
    if (name.empty() || std::ranges::any_of(name, [](char c) {
            return static_cast<unsigned char>(c) < ' ' || c == '\\';
        })) {
        return false;
    }
    for (size_t begin = 0; begin <= name.size();) {
        const size_t end = std::min(name.find('/', begin), name.size());
        const std::string part = name.substr(begin, end - begin);
        if (part.empty() || part == "." || part == "..") return false;
        begin = end + 1;
    }
    return true;
}

}  // namespace

Result<TarWriter> TarWriter::open(const std::string& path) {
    auto writer = FileWriter::open(path);
    if (!writer) return writer.error();
    return TarWriter(std::move(*writer));
}

Status TarWriter::add(const std::string& name, const std::string& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
    struct stat status = {};
    if (!file || ::fstat(file.value(), &status) != 0) return system_error(path, "open");
    TarHeader header = {};
    if (name.size() > sizeof header.name) {
        return Error{ErrorCode::InvalidArgument, name + ": the name is too long for an archive"};
    }
    std::memcpy(header.name, name.data(), name.size());
    put_number(header.mode, 0644);
    put_number(header.user, 0);
    put_number(header.group, 0);
    auto left = static_cast<uint64_t>(status.st_size);
    const uint64_t padding = padding_after(left);
    put_number(header.size, left);
    put_number(header.time, static_cast<uint64_t>(std::max<int64_t>(status.st_mtim.tv_sec, 0)));
    header.type = '0';
    std::memcpy(header.magic, "ustar\00000", 8);
    put_number(std::span(header.checksum).first(7), checksum_of(header));
    header.checksum[7] = ' ';
    if (auto done = writer_.write(std::as_bytes(std::span(&header, 1))); !done) return done;
    std::vector<std::byte> memory(size_t{1} << 20);
    while (left > 0) {
        const auto piece = std::span(memory).first(std::min<uint64_t>(memory.size(), left));
        const auto count = read_up_to(file, piece);
        if (!count) return system_error(path, "read");
        if (*count < piece.size()) return Error{ErrorCode::Unavailable, path + ": became shorter"};
        if (auto done = writer_.write(piece); !done) return done;
        left -= piece.size();
    }
    return writer_.write(std::span(memory = std::vector<std::byte>(padding)));
}

Status TarWriter::commit() {
    if (auto status = writer_.write(std::array<std::byte, 2 * kBlock>{}); !status) return status;
    return writer_.commit();
}

Result<TarReader> TarReader::open(const std::string& path) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file) return system_error(path, "open");
    return TarReader(path, std::move(file));
}

Error TarReader::corrupt(const std::string& reason) const {
    return {ErrorCode::Corrupt, shown_path(path_) + ": " + reason};
}

Status TarReader::fill(std::span<std::byte> memory) {
    const auto count = read_up_to(file_, memory);
    if (!count) return system_error(path_, "read");
    if (*count < memory.size()) return corrupt("ends too early");
    return Ok{};
}

Result<std::optional<TarEntry>> TarReader::next() {
    std::vector<std::byte> rest(std::min<uint64_t>(left_ + padding_, size_t{1} << 20));
    for (uint64_t skipped = left_ + padding_; skipped > 0;) {
        const auto piece = std::span(rest).first(std::min<uint64_t>(rest.size(), skipped));
        if (auto status = fill(piece); !status) return status.error();
        skipped -= piece.size();
    }
    TarHeader header;
    if (auto status = fill(std::as_writable_bytes(std::span(&header, 1))); !status) {
        return status.error();
    }
    const auto bytes = std::as_bytes(std::span(&header, 1));
    if (std::ranges::all_of(bytes, [](std::byte byte) { return byte == std::byte{0}; })) {
        left_ = padding_ = 0;
        return std::optional<TarEntry>();
    }
    const auto size = number_in(header.size), time = number_in(header.time);
    const auto sum = number_in(header.checksum);
    if (!size || !time || !sum || *sum != checksum_of(header)) return corrupt("is no archive");
    const std::string prefix = text_in(header.prefix);
    TarEntry entry{(prefix.empty() ? "" : prefix + "/") + text_in(header.name), *size,
                   static_cast<int64_t>(*time)};
    const std::string shown = shown_path(entry.name);
    if (header.type != '0' && header.type != '\0') {
        return corrupt(shown + " is a link, a folder or a device, which this program never stores");
    }
    if (!is_below(entry.name)) return corrupt(shown + " leads out of the folder");
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
