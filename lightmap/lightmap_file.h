// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/lightmap/lightmaps.h>
#include <tetralight/probes/section_members.h>

// The `.lightmaps` file: the sections of lightmaps in the same container as `.probes` files
// (probes/section_file.h), mapped and used in place. docs/file_format.md has the layout byte by
// byte.

namespace tetralight {

/// An open lightmap file. Its view is valid as long as it lives; moving it keeps the view valid.
class LightmapFile {
  public:
    [[nodiscard]] const LightmapsView& view() const noexcept { return file_.view; }

    /// All sections as the file's table lists them.
    [[nodiscard]] const std::vector<FileSection>& sections() const noexcept {
        return file_.sections;
    }

    /// The bytes of a section, aligned to 64 bytes: for sections that are not members of
    /// lightmaps. None if the file has no section of this name and element size.
    [[nodiscard]] std::optional<std::span<const std::byte>> section_bytes(
        std::string_view name, uint64_t element_size) const noexcept;

  private:
    friend struct LightmapFileReader;
    LightmapFile() = default;

    detail::MappedSections<LightmapsView> file_;
};

/// True if the bytes of a file begin as those of lightmaps do.
[[nodiscard]] bool is_lightmap_file(std::span<const std::byte> bytes) noexcept;

/// Opens a file and verifies all of it: checksums, structure, every index and number. Reads the
/// whole file once. Use it for files that are not trusted.
///
/// Returns corrupt if the bytes are wrong (checksum, layout or meaning; `Error::field` is the
/// section or element), unsupported if a newer version wrote the file, and otherwise the reason why
/// the system cannot read it: not_found, unavailable, out_of_resources. Messages begin with the
/// path.
[[nodiscard]] Result<LightmapFile> open_lightmap_file(const std::string& path);

/// Opens a file and reads only its header and section table, in the time of two page reads. Samples
/// test every index where they use it, so that a corrupt section gives wrong light or black but
/// never a read out of range.
[[nodiscard]] Result<LightmapFile> open_lightmap_file_lazy(const std::string& path);

/// Opens a file that is in memory: copies the bytes and verifies all of them. Messages begin with
/// "memory". Returns the errors of `open_lightmap_file`, and out_of_resources without memory for
/// the copy.
[[nodiscard]] Result<LightmapFile> open_lightmap_memory(std::span<const std::byte> bytes);

/// The verification that `open_lightmap_file` does and `open_lightmap_file_lazy` does not; for a
/// background thread.
[[nodiscard]] Status verify(const LightmapFile& file);

/// Checks lightmaps in memory: counts that agree, indices in range, rectangles that lie inside
/// their page and do not overlap, UVs in [0, 1], finite light. Returns corrupt; the field is the
/// section, its element or the member of `info`.
[[nodiscard]] Status verify(const LightmapsView& lightmaps);

/// Writes lightmaps and verifies what was written; the old file stays whole on failure. Returns
/// corrupt if the lightmaps do not pass `verify`. The same lightmaps give the same bytes.
[[nodiscard]] Status write_lightmap_file(const std::string& path, const LightmapsView& lightmaps,
                                         std::span<const ExtraSection> extra = {});

/// The bytes that `write_lightmap_file` writes.
[[nodiscard]] std::vector<std::byte> lightmap_file_bytes(const LightmapsView& lightmaps,
                                                         std::span<const ExtraSection> extra = {});

}  // namespace tetralight
