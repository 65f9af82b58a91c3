// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/probe_file.h>

#include <utility>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/probes/detail/probe_file_layout.h>
#include <tetralight/probes/volume_members.h>

namespace tetralight {
namespace {

using detail::kProbeFileKind;

constexpr auto kMembers = [](auto visit) {
    for_each_volume_member(
        [&](const char* name, MemberUse, auto, auto member) { visit(name, member); });
};

detail::SectionFileImage image_of(const ProbeVolumeView& volume,
                                  std::span<const ExtraSection> extra) {
    return detail::image_of_view(kProbeFileKind, volume, extra, kMembers);
}

}  // namespace

/// Builds a ProbeFile.
struct ProbeFileReader {
    static ProbeFile open(detail::MappedSections<ProbeVolumeView> sections) {
        ProbeFile file;
        file.file_ = std::move(sections);
        return file;
    }

    static Status verify(const ProbeFile& file) {
        return detail::verify_sections(kProbeFileKind, file.file_.mapping.bytes(), file.view());
    }
};

Result<ProbeFile> open_probe_file_lazy(const std::string& path) {
    auto sections = detail::map_sections<ProbeVolumeView>(kProbeFileKind, path, kMembers);
    if (!sections) return sections.error();
    return ProbeFileReader::open(std::move(*sections));
}

Result<ProbeFile> open_probe_file(const std::string& path) {
    auto file = open_probe_file_lazy(path);
    if (!file) return file;
    if (auto status = verify(*file); !status) return status.error().in(shown_path(path));
    return file;
}

Result<ProbeFile> open_probe_memory(std::span<const std::byte> bytes) {
    auto sections = detail::copy_sections<ProbeVolumeView>(kProbeFileKind, bytes, kMembers);
    if (!sections) return sections.error();
    ProbeFile file = ProbeFileReader::open(std::move(*sections));
    if (auto status = verify(file); !status) return status.error().in(detail::kMemoryName);
    return file;
}

Status verify(const ProbeFile& file) {
    return ProbeFileReader::verify(file);
}

std::optional<std::span<const std::byte>> ProbeFile::section_bytes(
    std::string_view name, uint64_t element_size) const noexcept {
    return detail::find_section_bytes(file_.mapping.bytes(), file_.sections, name, element_size);
}

std::vector<std::byte> probe_file_bytes(const ProbeVolumeView& volume,
                                        std::span<const ExtraSection> extra) {
    return detail::joined(image_of(volume, extra));
}

Status write_probe_file(const std::string& path, const ProbeVolumeView& volume,
                        std::span<const ExtraSection> extra) {
    if (auto status = verify(volume); !status) return status.error().in(shown_path(path));
    return write_compared_file(path, image_of(volume, extra).pieces);
}

}  // namespace tetralight
