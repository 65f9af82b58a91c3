// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/section_file.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/section_error.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tetralight::detail {
namespace {

/// A damaged file may hold any bytes as a name; messages stay one line of text.
std::string shown_name(const SectionEntry& entry) {
    return shown_path(section_name(entry));
}

Error wrong_kind(const SectionFileKind& kind, const char* why) {
    return {ErrorCode::Corrupt, str_cat("not a ", kind.name, " (", why, ")")};
}

Status check_entry(const SectionEntry& entry, uint64_t end_of_previous, uint64_t file_size) {
    const std::string name = shown_name(entry);
    if (entry.offset % kAlignment != 0 || entry.offset < end_of_previous) {
        return section_error(name, str_cat("offset ", entry.offset, " is out of place"));
    }
    const uint64_t room = file_size - std::min(entry.offset, file_size);
    if (entry.element_size == 0 || entry.element_count > room / entry.element_size) {
        return section_error(
            name, str_cat(entry.element_count, " elements of ", entry.element_size, " bytes at ",
                          entry.offset, " do not fit in the file of ", file_size, " bytes"));
    }
    return Ok{};
}

size_t aligned(size_t offset) {
    return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

/// What lies between two sections.
std::span<const std::byte> zeros(size_t count) {
    static constexpr std::array<std::byte, kAlignment> kZeros{};
    return std::span(kZeros).first(count);
}

/// Bytes of a file whose table was checked: both numbers fit in memory.
std::span<const std::byte> part_of(std::span<const std::byte> file, uint64_t offset,
                                   uint64_t size) {
    return file.subspan(static_cast<size_t>(offset), static_cast<size_t>(size));
}

bool are_zero(std::span<const std::byte> bytes) {
    return std::ranges::all_of(bytes, [](std::byte byte) { return byte == std::byte{0}; });
}

}  // namespace

uint64_t checksum(std::span<const std::byte> bytes) noexcept {
    return XXH3_64bits(bytes.data(), bytes.size());
}

uint64_t header_checksum(const FileHeader& header, std::span<const SectionEntry> table) noexcept {
    FileHeader unsigned_header = header;
    unsigned_header.checksum = 0;
    const uint64_t seed = checksum(std::as_bytes(std::span(&unsigned_header, 1)));
    const auto bytes = std::as_bytes(table);
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

std::string section_name(const SectionEntry& entry) {
    const auto end = std::ranges::find(entry.name, '\0');
    return {entry.name.begin(), end};
}

Result<std::span<const SectionEntry>> read_section_table(const SectionFileKind& kind,
                                                         std::span<const std::byte> file) {
    FileHeader header;
    if (file.size() < sizeof header) return wrong_kind(kind, "shorter than a header");
    std::memcpy(&header, file.data(), sizeof header);
    if (header.magic != kind.magic) return wrong_kind(kind, "wrong first bytes");
    if (header.version != kind.version) {
        return Error{ErrorCode::Unsupported, "version", str_cat(header.version),
                     str_cat("file version ", header.version,
                             " is not supported (this program reads ", kind.version, ")")};
    }
    if (header.file_size != file.size()) {
        return Error{ErrorCode::Corrupt, str_cat("the file has ", file.size(),
                                                 " bytes, but its header says ", header.file_size)};
    }
    const uint64_t table_size = uint64_t{header.section_count} * sizeof(SectionEntry);
    if (header.section_count > kMaxSectionCount || table_size > file.size() - sizeof header) {
        return Error{ErrorCode::Corrupt,
                     str_cat("section count ", header.section_count, " is out of range")};
    }
    const auto* entries = reinterpret_cast<const SectionEntry*>(file.data() + sizeof header);
    const std::span table(entries, header.section_count);
    if (header.checksum != header_checksum(header, table)) {
        return Error{ErrorCode::Corrupt,
                     "the header or the section table is corrupt (wrong checksum)"};
    }
    uint64_t end = sizeof header + table_size;
    std::set<std::string> names;
    for (const SectionEntry& entry : table) {
        if (!names.insert(section_name(entry)).second) {
            const std::string name = shown_name(entry);
            return Error{ErrorCode::Corrupt, name, "",
                         str_cat("section \"", name, "\" occurs twice")};
        }
        if (auto status = check_entry(entry, end, file.size()); !status) return status.error();
        end = entry.offset + entry.size();
    }
    return table;
}

Status verify_checksums(std::span<const std::byte> file, std::span<const SectionEntry> table) {
    uint64_t end = sizeof(FileHeader) + table.size_bytes();
    for (const SectionEntry& entry : table) {
        if (!are_zero(part_of(file, end, entry.offset - end))) {
            return Error{ErrorCode::Corrupt,
                         str_cat("bytes before section \"", shown_name(entry), "\" are not zero")};
        }
        if (checksum(part_of(file, entry.offset, entry.size())) != entry.checksum) {
            const std::string name = shown_name(entry);
            return Error{ErrorCode::Corrupt, name, "",
                         str_cat("section \"", name, "\" is corrupt (wrong checksum)")};
        }
        end = entry.offset + entry.size();
    }
    if (!are_zero(part_of(file, end, file.size() - end)))
        return Error{ErrorCode::Corrupt, "bytes after the last section are not zero"};
    return Ok{};
}

std::optional<std::span<const std::byte>> find_section_bytes(std::span<const std::byte> file,
                                                             std::span<const FileSection> sections,
                                                             std::string_view name,
                                                             uint64_t element_size) noexcept {
    for (const FileSection& section : sections) {
        if (section.name != name || section.element_size != element_size) continue;
        return part_of(file, section.offset, section.size);
    }
    return std::nullopt;
}

SectionPart::SectionPart(std::string_view name, std::span<const std::byte> elements,
                         size_t element_size)
    : bytes(elements) {
    std::memcpy(entry.name.data(), name.data(), std::min(name.size(), entry.name.size()));
    entry.element_size = element_size;
    entry.element_count = bytes.size() / element_size;
    entry.checksum = detail::checksum(bytes);
}

SectionFileImage make_file_image(const SectionFileKind& kind, std::vector<SectionPart> parts) {
    const size_t head_size = sizeof(FileHeader) + parts.size() * sizeof(SectionEntry);
    SectionFileImage image{std::vector<std::byte>(head_size), {{}}};
    std::vector<SectionEntry> table;
    size_t offset = head_size;
    for (SectionPart& part : parts) {
        const size_t begin = aligned(offset);
        part.entry.offset = begin;
        image.pieces.push_back(zeros(begin - offset));
        image.pieces.push_back(part.bytes);
        offset = begin + part.bytes.size();
        table.push_back(part.entry);
    }
    image.pieces.push_back(zeros(aligned(offset) - offset));

    FileHeader header{
        kind.magic, kind.version, static_cast<uint32_t>(parts.size()), aligned(offset), 0, {}};
    header.checksum = header_checksum(header, table);
    std::memcpy(image.head.data(), &header, sizeof header);
    std::memcpy(image.head.data() + sizeof header, table.data(), head_size - sizeof header);
    image.pieces[0] = image.head;
    return image;
}

std::vector<std::byte> joined(const SectionFileImage& image) {
    size_t size = 0;
    for (const auto& piece : image.pieces) size += piece.size();
    std::vector<std::byte> file;
    file.reserve(size);
    for (const auto& piece : image.pieces) file.insert(file.end(), piece.begin(), piece.end());
    return file;
}

}  // namespace tetralight::detail
