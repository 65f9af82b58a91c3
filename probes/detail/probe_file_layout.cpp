// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/probe_file_layout.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/detail/section_error.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tetralight::detail {
namespace {

Error not_a_probe_file(const char* why) {
    return {ErrorCode::Corrupt, std::string("not a probe file (") + why + ")"};
}

Status check_entry(const SectionEntry& entry, uint64_t end_of_previous, uint64_t file_size) {
    const std::string name = section_name(entry);
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

Result<std::span<const SectionEntry>> read_section_table(std::span<const std::byte> file) {
    FileHeader header;
    if (file.size() < sizeof header) return not_a_probe_file("shorter than a header");
    std::memcpy(&header, file.data(), sizeof header);
    if (header.magic != kMagic) return not_a_probe_file("wrong first bytes");
    if (header.version != kFileVersion) {
        return Error{ErrorCode::Unsupported, "version", str_cat(header.version),
                     str_cat("file version ", header.version,
                             " is not supported (this program reads ", kFileVersion, ")")};
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
            return Error{ErrorCode::Corrupt, section_name(entry), "",
                         str_cat("section \"", section_name(entry), "\" occurs twice")};
        }
        if (auto status = check_entry(entry, end, file.size()); !status) return status.error();
        end = entry.offset + entry.size();
    }
    return table;
}

Status verify_checksums(std::span<const std::byte> file, std::span<const SectionEntry> table) {
    uint64_t end = sizeof(FileHeader) + table.size_bytes();
    for (const SectionEntry& entry : table) {
        if (!are_zero(file.subspan(end, entry.offset - end))) {
            return Error{ErrorCode::Corrupt, str_cat("bytes before section \"", section_name(entry),
                                                     "\" are not zero")};
        }
        if (checksum(file.subspan(entry.offset, entry.size())) != entry.checksum) {
            const std::string name = section_name(entry);
            return Error{ErrorCode::Corrupt, name, "",
                         str_cat("section \"", name, "\" is corrupt (wrong checksum)")};
        }
        end = entry.offset + entry.size();
    }
    if (!are_zero(file.subspan(end)))
        return Error{ErrorCode::Corrupt, "bytes after the last section are not zero"};
    return Ok{};
}

}  // namespace tetralight::detail
