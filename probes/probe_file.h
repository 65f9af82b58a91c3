// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/section_members.h>

// The `.probes` file: little-endian, 64-byte aligned sections with an xxh3 checksum each, mapped
// and used in place. docs/file_format.md has the layout byte by byte.
//
//     auto file = open_probe_file("level.probes");
//     if (!file) return file.error();
//     CellLocation location = locate(file->view(), position);

namespace tetralight {

/// An open probe file. Its view is valid as long as it lives; moving it keeps the view valid.
class ProbeFile {
  public:
    [[nodiscard]] const ProbeVolumeView& view() const noexcept { return file_.view; }

    /// One section as the file's table lists it.
    using Section = FileSection;

    [[nodiscard]] const std::vector<Section>& sections() const noexcept { return file_.sections; }

    /// The bytes of a section, aligned to 64 bytes: for sections that are not members of the
    /// volume. None if the file has no section of this name and element size.
    [[nodiscard]] std::optional<std::span<const std::byte>> section_bytes(
        std::string_view name, uint64_t element_size) const noexcept;

    /// Gives back the memory of what was read; queries read it from the file again. May run beside
    /// queries.
    void release_pages() const noexcept { file_.mapping.release_pages(); }

  private:
    friend struct ProbeFileReader;
    ProbeFile() = default;

    detail::MappedSections<ProbeVolumeView> file_;
};

/// Opens a file and verifies all of it: checksums, structure, every index and number. Reads the
/// whole file once. Use it for files that are not trusted.
///
/// Returns corrupt if the bytes are wrong (checksum, layout or meaning; `Error::field` is the
/// section or element), unsupported if a newer version wrote the file, and otherwise the reason why
/// the system cannot read it: not_found, unavailable, out_of_resources. Messages begin with the
/// path.
[[nodiscard]] Result<ProbeFile> open_probe_file(const std::string& path);

/// Opens a file and reads only its header and section table, in the time of two page reads. Queries
/// test every index where they use it, so that a corrupt section gives wrong light or the ambient
/// result but never a read out of range.
[[nodiscard]] Result<ProbeFile> open_probe_file_lazy(const std::string& path);

/// Opens a file that is in memory: of an archive, of another file, received from a network. Copies
/// the bytes, so that they may change or go, and verifies all of them. Messages begin with
/// "memory". Returns the errors of `open_probe_file`, and out_of_resources without memory for the
/// copy.
[[nodiscard]] Result<ProbeFile> open_probe_memory(std::span<const std::byte> bytes);

/// The verification that `open_probe_file` does and `open_probe_file_lazy` does not; for a
/// background thread.
[[nodiscard]] Status verify(const ProbeFile& file);

/// Checks that a volume in memory holds what every query relies on: counts that agree, indices in
/// range, neighbors that are each other's neighbors, finite numbers.
[[nodiscard]] Status verify(const ProbeVolumeView& volume);

/// Writes a volume and verifies what was written; the old file stays whole on failure. Returns
/// corrupt if the volume does not pass `verify`. The same volume gives the same bytes.
[[nodiscard]] Status write_probe_file(const std::string& path, const ProbeVolumeView& volume,
                                      std::span<const ExtraSection> extra = {});

/// The bytes that `write_probe_file` writes.
[[nodiscard]] std::vector<std::byte> probe_file_bytes(const ProbeVolumeView& volume,
                                                      std::span<const ExtraSection> extra = {});

}  // namespace tetralight
