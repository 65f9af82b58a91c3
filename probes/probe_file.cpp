// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/probe_file.h>

#include <cstring>
#include <string_view>
#include <utility>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/detail/probe_file_layout.h>
#include <tetralight/probes/volume_members.h>

namespace tetralight {
namespace {

using detail::FileHeader;
using detail::SectionEntry;

template <class T>
std::span<const std::byte> bytes_of(const std::span<const T>& elements) {
    return std::as_bytes(elements);
}

std::span<const std::byte> bytes_of(std::string_view characters) {
    return std::as_bytes(std::span(characters));
}

/// A section to be written.
struct Part {
    SectionEntry entry;
    std::span<const std::byte> bytes;
};

Part make_part(std::string_view name, std::span<const std::byte> bytes, size_t element_size) {
    Part part{{}, bytes};
    std::memcpy(part.entry.name.data(), name.data(), name.size());
    part.entry.element_size = element_size;
    part.entry.element_count = bytes.size() / element_size;
    part.entry.checksum = detail::checksum(bytes);
    return part;
}

uint64_t aligned(uint64_t offset) {
    return (offset + detail::kAlignment - 1) / detail::kAlignment * detail::kAlignment;
}

/// Empty sections are left out; "info" is always there.
std::vector<Part> make_parts(const ProbeVolumeView& volume, std::span<const ExtraSection> extra) {
    const std::span info(&volume.info, 1);
    std::vector<Part> parts{make_part("info", std::as_bytes(info), sizeof(VolumeInfo))};
    for_each_volume_member([&](const char* name, MemberUse, auto, auto view) {
        const auto& elements = volume.*view;
        if (elements.empty()) return;
        parts.push_back(make_part(name, bytes_of(elements), sizeof elements[0]));
    });
    for (const ExtraSection& section : extra) {
        if (section.bytes.empty()) continue;
        parts.push_back(make_part(section.name, section.bytes, section.element_size));
    }
    uint64_t offset = sizeof(FileHeader) + parts.size() * sizeof(SectionEntry);
    for (Part& part : parts) {
        part.entry.offset = aligned(offset);
        offset = part.entry.offset + part.bytes.size();
    }
    return parts;
}

Status read_section(const SectionEntry& entry, std::span<const std::byte> bytes,
                    std::string_view& out) {
    if (entry.element_size != 1) return Error{ErrorCode::Corrupt, "wrong element size"};
    out = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    return Ok{};
}

template <class T>
Status read_section(const SectionEntry& entry, std::span<const std::byte> bytes,
                    std::span<const T>& out) {
    if (entry.element_size != sizeof(T)) {
        return Error{ErrorCode::Corrupt, str_cat("elements have ", entry.element_size,
                                                 " bytes instead of ", sizeof(T))};
    }
    if (entry.element_count >= kNoIndex) {
        return Error{
            ErrorCode::Corrupt,
            str_cat(entry.element_count, " elements are more than 32-bit indices can name")};
    }
    out = {reinterpret_cast<const T*>(bytes.data()), entry.element_count};
    return Ok{};
}

Status read_info(const SectionEntry& entry, std::span<const std::byte> bytes, VolumeInfo& info) {
    std::span<const VolumeInfo> one;
    if (auto status = read_section(entry, bytes, one); !status) return status;
    if (one.size() != 1)
        return Error{ErrorCode::Corrupt, str_cat(one.size(), " elements instead of 1")};
    info = one[0];
    return Ok{};
}

/// The volume in the bytes of a probe file.
struct VolumeReader {
    std::span<const std::byte> bytes;
    ProbeVolumeView view;
    std::vector<ProbeFile::Section> sections;
    bool has_info = false;

    Status read(const SectionEntry& entry) {
        const std::string name = detail::section_name(entry);
        const auto section = bytes.subspan(entry.offset, entry.size());
        sections.push_back({name, entry.offset, entry.size(), entry.element_size});
        Status status = Ok{};
        if (name == "info") {
            status = read_info(entry, section, view.info);
            has_info = true;
        }
        for_each_volume_member([&](const char* known, MemberUse, auto, auto member) {
            if (name == known) status = read_section(entry, section, view.*member);
        });
        if (status) return Ok{};
        Error error = status.error().in("section \"" + name + "\"");
        error.field = name;
        return error;
    }
};

Result<VolumeReader> read_volume(std::span<const std::byte> bytes) {
    VolumeReader reader{bytes, {}, {}};
    const auto table = detail::read_section_table(bytes);
    if (!table) return table.error();
    for (const SectionEntry& entry : *table) {
        if (auto status = reader.read(entry); !status) return status.error();
    }
    if (!reader.has_info) {
        return Error{ErrorCode::Corrupt, "info", "", "section \"info\" is missing"};
    }
    return reader;
}

/// Checksums, and the meaning of every number.
Status verify_bytes(std::span<const std::byte> bytes, const ProbeVolumeView& view) {
    const auto table = detail::read_section_table(bytes);
    if (!table) return table.error();
    if (auto status = detail::verify_checksums(bytes, *table); !status) return status;
    return verify(view);
}

Status verify_written(std::span<const std::byte> bytes) {
    const auto reader = read_volume(bytes);
    return reader ? verify_bytes(bytes, reader->view) : reader.error();
}

}  // namespace

/// Builds a ProbeFile.
struct ProbeFileReader {
    static Result<ProbeFile> open(MappedFile mapping) {
        auto reader = read_volume(mapping.bytes());
        if (!reader) return reader.error();
        ProbeFile file;
        file.mapping_ = std::move(mapping);
        file.view_ = reader->view;
        file.sections_ = std::move(reader->sections);
        return file;
    }

    static Status verify(const ProbeFile& file) {
        return verify_bytes(file.mapping_.bytes(), file.view_);
    }
};

Result<ProbeFile> open_probe_file_lazy(const std::string& path) {
    auto mapping = MappedFile::open(path);
    if (!mapping) return mapping.error();
    auto file = ProbeFileReader::open(std::move(*mapping));
    if (!file) return file.error().in(shown_path(path));
    return file;
}

Result<ProbeFile> open_probe_file(const std::string& path) {
    auto file = open_probe_file_lazy(path);
    if (!file) return file;
    if (auto status = verify(*file); !status) return status.error().in(shown_path(path));
    return file;
}

Status verify(const ProbeFile& file) {
    return ProbeFileReader::verify(file);
}

std::optional<std::span<const std::byte>> ProbeFile::section_bytes(
    std::string_view name, uint64_t element_size) const noexcept {
    for (const Section& section : sections_) {
        if (section.name != name || section.element_size != element_size) continue;
        return mapping_.bytes().subspan(section.offset, section.size);
    }
    return std::nullopt;
}

std::vector<std::byte> probe_file_bytes(const ProbeVolumeView& volume,
                                        std::span<const ExtraSection> extra) {
    const std::vector<Part> parts = make_parts(volume, extra);
    std::vector<SectionEntry> table;
    for (const Part& part : parts) table.push_back(part.entry);

    FileHeader header;
    header.section_count = static_cast<uint32_t>(parts.size());
    header.file_size = aligned(table.back().offset + table.back().size());
    header.checksum = detail::header_checksum(header, table);

    std::vector<std::byte> file(header.file_size);
    std::memcpy(file.data(), &header, sizeof header);
    std::memcpy(file.data() + sizeof header, table.data(), table.size() * sizeof(SectionEntry));
    for (const Part& part : parts) {
        std::memcpy(file.data() + part.entry.offset, part.bytes.data(), part.bytes.size());
    }
    return file;
}

Status write_probe_file(const std::string& path, const ProbeVolumeView& volume,
                        std::span<const ExtraSection> extra) {
    const std::vector<std::byte> file = probe_file_bytes(volume, extra);
    const std::span<const std::byte> bytes = file;
    return write_file(path, std::span(&bytes, 1), verify_written);
}

}  // namespace tetralight
