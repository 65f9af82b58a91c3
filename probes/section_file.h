// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tetralight/base/result.h>

// The container of `.probes` and `.lightmaps` files:
//
//     0                    FileHeader                          64 bytes
//     64                   SectionEntry × section_count        64 bytes each
//     64-byte aligned      sections, in the order of the table, zero bytes between them
//
// Little-endian; offsets count from the start of the file. Readers skip sections they do not know.
// probes/section_members.h reads and writes the members of a view as sections. Programs use
// probes/probe_file.h and lightmap/lightmap_file.h.

namespace tetralight {

/// One section as the table of a file lists it.
struct FileSection {
    std::string name;
    uint64_t offset = 0;
    uint64_t size = 0;
    uint64_t element_size = 1;
};

/// A section that is not a member of what the file holds: data of a tool. Readers skip it.
struct ExtraSection {
    std::string_view name;  ///< at most 24 bytes; not the name of a member
    std::span<const std::byte> bytes;
    uint64_t element_size = 1;
};

namespace detail {

static_assert(std::endian::native == std::endian::little, "the file is used in place");

inline constexpr size_t kAlignment = 64;
inline constexpr uint32_t kMaxSectionCount = 1024;

/// How files of one kind begin, and what messages call them.
struct SectionFileKind {
    std::array<char, 8> magic{};
    uint32_t version = 1;
    const char* name = "";  ///< "probe file"
};

struct FileHeader {
    std::array<char, 8> magic{};
    uint32_t version = 0;
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
/// Returns corrupt if the file is not of this kind, and unsupported if its version is another one.
[[nodiscard]] Result<std::span<const SectionEntry>> read_section_table(
    const SectionFileKind& kind, std::span<const std::byte> file);

/// Compares every checksum, and the bytes between sections with zero.
[[nodiscard]] Status verify_checksums(std::span<const std::byte> file,
                                      std::span<const SectionEntry> table);

/// The bytes of the section of this name and element size; none if there is no such section.
[[nodiscard]] std::optional<std::span<const std::byte>> find_section_bytes(
    std::span<const std::byte> file, std::span<const FileSection> sections, std::string_view name,
    uint64_t element_size) noexcept;

/// A section to be written. Precondition: the name has at most 24 bytes.
struct SectionPart {
    SectionEntry entry;  ///< all but its offset
    std::span<const std::byte> bytes;

    SectionPart(std::string_view name, std::span<const std::byte> elements, size_t element_size);
};

/// A file to be written: the pieces one after the other. The first piece is `head`.
struct SectionFileImage {
    std::vector<std::byte> head;  ///< header and table
    std::vector<std::span<const std::byte>> pieces;
};

/// Places the sections. The pieces refer to the bytes of the parts. Precondition: there is a part.
[[nodiscard]] SectionFileImage make_file_image(const SectionFileKind& kind,
                                               std::vector<SectionPart> parts);

/// All pieces as one.
[[nodiscard]] std::vector<std::byte> joined(const SectionFileImage& image);

}  // namespace detail
}  // namespace tetralight
