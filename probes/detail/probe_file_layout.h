// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

// Layout of a `.probes` file, version 1:
//
//     0                    FileHeader                          64 bytes
//     64                   SectionEntry × section_count        64 bytes each
//     64-byte aligned      sections, in the order of the table, zero bytes between them
//
// Offsets count from the start of the file. Readers skip section kinds they do not know.

namespace tetralight::detail {

static_assert(std::endian::native == std::endian::little, "the file is used in place");

inline constexpr std::array<char, 8> kMagic{'T', 'E', 'T', 'R', 'A', 'P', 'V', '\n'};
inline constexpr uint32_t kFileVersion = 1;
inline constexpr uint64_t kAlignment = 64;
inline constexpr uint32_t kMaxSectionCount = 1024;

struct FileHeader {
    std::array<char, 8> magic = kMagic;
    uint32_t version = kFileVersion;
    uint32_t section_count = 0;
    uint64_t file_size = 0;
    /// xxh3 of the header with this field 0, followed by the section table.
    uint64_t checksum = 0;
    std::array<uint64_t, 4> reserved{};
};

static_assert(sizeof(FileHeader) == 64 && std::is_trivially_copyable_v<FileHeader>);

struct SectionEntry {
    /// Name of the section, padded with zeros.
    std::array<char, 24> name{};
    uint64_t offset = 0;
    uint64_t element_count = 0;
    uint64_t element_size = 0;
    /// xxh3 of the section's bytes.
    uint64_t checksum = 0;
    uint64_t reserved = 0;

    [[nodiscard]] uint64_t size() const { return element_count * element_size; }
};

static_assert(sizeof(SectionEntry) == 64 && std::is_trivially_copyable_v<SectionEntry>);

/// xxh3, 64 bits, seed 0.
[[nodiscard]] uint64_t checksum(std::span<const std::byte> bytes) noexcept;
[[nodiscard]] uint64_t header_checksum(const FileHeader& header,
                                       std::span<const SectionEntry> table) noexcept;

/// The section's name as text.
[[nodiscard]] std::string section_name(const SectionEntry& entry);

/// Header and table of a file, tested as far as they go: a range of every section inside the file.
[[nodiscard]] Result<std::span<const SectionEntry>> read_section_table(
    std::span<const std::byte> file);

/// Compares every checksum, and the bytes between sections with zero.
[[nodiscard]] Status verify_checksums(std::span<const std::byte> file,
                                      std::span<const SectionEntry> table);

}  // namespace tetralight::detail
