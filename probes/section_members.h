// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/base/result.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/no_index.h>
#include <tetralight/probes/section_error.h>
#include <tetralight/probes/section_file.h>

// Reads and writes a view (`info`, spans and texts) as the sections of a file. `for_each_member`
// calls visit(name of the section, pointer to the member of the view) for each member but `info`.

namespace tetralight::detail {

/// An open file: its mapped bytes, the view of their members, and all sections of its table.
/// Moving it keeps the view valid.
template <class View>
struct MappedSections {
    MappedFile mapping;
    View view;
    std::vector<FileSection> sections;
};

[[nodiscard]] inline Status read_section(const SectionEntry& entry,
                                         std::span<const std::byte> bytes, std::string_view& out) {
    if (entry.element_size != 1) return Error{ErrorCode::Corrupt, "wrong element size"};
    out = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    return Ok{};
}

template <class T>
[[nodiscard]] Status read_section(const SectionEntry& entry, std::span<const std::byte> bytes,
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
    out = {reinterpret_cast<const T*>(bytes.data()), static_cast<size_t>(entry.element_count)};
    return Ok{};
}

template <class Info>
[[nodiscard]] Status read_info(const SectionEntry& entry, std::span<const std::byte> bytes,
                               Info& info) {
    std::span<const Info> one;
    if (auto status = read_section(entry, bytes, one); !status) return status;
    if (one.size() != 1)
        return Error{ErrorCode::Corrupt, str_cat(one.size(), " elements instead of 1")};
    info = one[0];
    return Ok{};
}

/// Fills view and sections from the mapped bytes. Returns the errors of `read_section_table`, and
/// corrupt if "info" is missing or elements have another size than those of the member.
template <class View, class ForEachMember>
[[nodiscard]] Status read_sections(const SectionFileKind& kind, std::span<const std::byte> bytes,
                                   MappedSections<View>& file, ForEachMember for_each_member) {
    const auto table = read_section_table(kind, bytes);
    if (!table) return table.error();
    bool has_info = false;
    for (const SectionEntry& entry : *table) {
        const std::string name = section_name(entry);
        // Both fit: the table was checked against the size of the file.
        const auto section =
            bytes.subspan(static_cast<size_t>(entry.offset), static_cast<size_t>(entry.size()));
        file.sections.push_back({name, entry.offset, entry.size(), entry.element_size});
        Status status = Ok{};
        if (name == "info") {
            status = read_info(entry, section, file.view.info);
            has_info = true;
        }
        for_each_member([&](const char* known, auto member) {
            if (name == known) status = read_section(entry, section, file.view.*member);
        });
        if (status) continue;
        Error error = status.error().in("section \"" + name + "\"");
        error.field = name;
        return error;
    }
    if (has_info) return Ok{};
    return Error{ErrorCode::Corrupt, "info", "", "section \"info\" is missing"};
}

/// What messages about a file in memory begin with, in place of a path.
inline constexpr const char* kMemoryName = "memory";

/// Reads header and table of an open file only. Messages begin with its name.
template <class View, class ForEachMember>
[[nodiscard]] Result<MappedSections<View>> sections_of(const SectionFileKind& kind,
                                                       Result<MappedFile> mapping,
                                                       const std::string& name,
                                                       ForEachMember for_each_member) {
    if (!mapping) return mapping.error();
    MappedSections<View> file;
    file.mapping = std::move(*mapping);
    const Status status = read_sections(kind, file.mapping.bytes(), file, for_each_member);
    if (!status) return status.error().in(name);
    return file;
}

/// Maps a file and reads its header and table only. Messages begin with the path.
template <class View, class ForEachMember>
[[nodiscard]] Result<MappedSections<View>> map_sections(const SectionFileKind& kind,
                                                        const std::string& path,
                                                        ForEachMember for_each_member) {
    return sections_of<View>(kind, MappedFile::open(path), shown_path(path), for_each_member);
}

/// The same for a copy of a file that is in memory.
template <class View, class ForEachMember>
[[nodiscard]] Result<MappedSections<View>> copy_sections(const SectionFileKind& kind,
                                                         std::span<const std::byte> bytes,
                                                         ForEachMember for_each_member) {
    return sections_of<View>(kind, MappedFile::copy_of(bytes), kMemoryName, for_each_member);
}

/// The checks that `map_sections` leaves out: checksums, then `verify(view)`, the meaning of every
/// number.
template <class View>
[[nodiscard]] Status verify_sections(const SectionFileKind& kind, std::span<const std::byte> bytes,
                                     const View& view) {
    const auto table = read_section_table(kind, bytes);
    if (!table) return table.error();
    if (auto status = verify_checksums(bytes, *table); !status) return status;
    return verify(view);
}

/// The file of a view: "info", then the members that are not empty, then other sections.
template <class View, class ForEachMember>
[[nodiscard]] SectionFileImage image_of_view(const SectionFileKind& kind, const View& view,
                                             std::span<const ExtraSection> extra,
                                             ForEachMember for_each_member) {
    const std::span info(&view.info, 1);
    std::vector<SectionPart> parts{{"info", std::as_bytes(info), sizeof view.info}};
    for_each_member([&](const char* name, auto member) {
        const std::span elements = view.*member;
        if (elements.empty()) return;
        parts.emplace_back(name, std::as_bytes(elements), sizeof elements[0]);
    });
    for (const ExtraSection& section : extra) {
        if (section.bytes.empty()) continue;
        parts.emplace_back(section.name, section.bytes, section.element_size);
    }
    return make_file_image(kind, std::move(parts));
}

}  // namespace tetralight::detail
