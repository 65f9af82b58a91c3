// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/lightmap_file.h>

#include <algorithm>
#include <span>
#include <utility>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/lightmap/lightmap_members.h>

namespace tetralight {
namespace {

/// `.lightmaps` files, version 1.
constexpr detail::SectionFileKind kLightmapFileKind{
    {'T', 'E', 'T', 'R', 'A', 'L', 'M', '\n'}, 1, "lightmap file"};

constexpr auto kLightmapMembers = [](auto visit) {
    for_each_lightmap_member([&](const char* name, auto, auto member) { visit(name, member); });
};

detail::SectionFileImage image_of(const LightmapsView& lightmaps,
                                  std::span<const ExtraSection> extra) {
    return detail::image_of_view(kLightmapFileKind, lightmaps, extra, kLightmapMembers);
}

}  // namespace

/// Builds a LightmapFile.
struct LightmapFileReader {
    static LightmapFile open(detail::MappedSections<LightmapsView> sections) {
        LightmapFile file;
        file.file_ = std::move(sections);
        return file;
    }

    static Status verify(const LightmapFile& file) {
        return detail::verify_sections(kLightmapFileKind, file.file_.mapping.bytes(), file.view());
    }
};

bool is_lightmap_file(std::span<const std::byte> bytes) noexcept {
    const auto magic = std::as_bytes(std::span(kLightmapFileKind.magic));
    return bytes.size() >= magic.size() && std::ranges::equal(bytes.first(magic.size()), magic);
}

Result<LightmapFile> open_lightmap_file_lazy(const std::string& path) {
    auto sections = detail::map_sections<LightmapsView>(kLightmapFileKind, path, kLightmapMembers);
    if (!sections) return sections.error();
    return LightmapFileReader::open(std::move(*sections));
}

Result<LightmapFile> open_lightmap_file(const std::string& path) {
    auto file = open_lightmap_file_lazy(path);
    if (!file) return file;
    if (auto status = verify(*file); !status) return status.error().in(shown_path(path));
    return file;
}

Result<LightmapFile> open_lightmap_memory(std::span<const std::byte> bytes) {
    auto sections =
        detail::copy_sections<LightmapsView>(kLightmapFileKind, bytes, kLightmapMembers);
    if (!sections) return sections.error();
    LightmapFile file = LightmapFileReader::open(std::move(*sections));
    if (auto status = verify(file); !status) return status.error().in(detail::kMemoryName);
    return file;
}

Status verify(const LightmapFile& file) {
    return LightmapFileReader::verify(file);
}

std::optional<std::span<const std::byte>> LightmapFile::section_bytes(
    std::string_view name, uint64_t element_size) const noexcept {
    return detail::find_section_bytes(file_.mapping.bytes(), file_.sections, name, element_size);
}

std::vector<std::byte> lightmap_file_bytes(const LightmapsView& lightmaps,
                                           std::span<const ExtraSection> extra) {
    return detail::joined(image_of(lightmaps, extra));
}

Status write_lightmap_file(const std::string& path, const LightmapsView& lightmaps,
                           std::span<const ExtraSection> extra) {
    if (auto status = verify(lightmaps); !status) return status.error().in(shown_path(path));
    return write_compared_file(path, image_of(lightmaps, extra).pieces);
}

}  // namespace tetralight
