// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

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
    [[nodiscard]] const ProbeVolumeView& view() const noexcept { return view_; }

    /// One section as the file's table lists it.
    struct Section {
        std::string name;
        uint64_t offset = 0;
        uint64_t size = 0;
        uint64_t element_size = 1;
    };

    [[nodiscard]] const std::vector<Section>& sections() const noexcept { return sections_; }

    /// The bytes of a section, aligned to 64 bytes: for sections that are not members of the
    /// volume. None if the file has no section of this name and element size.
    [[nodiscard]] std::optional<std::span<const std::byte>> section_bytes(
        std::string_view name, uint64_t element_size) const noexcept;

  private:
    friend struct ProbeFileReader;
    ProbeFile() = default;

    MappedFile mapping_;
    ProbeVolumeView view_;
    std::vector<Section> sections_;
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

/// The verification that `open_probe_file` does and `open_probe_file_lazy` does not; for a
/// background thread.
[[nodiscard]] Status verify(const ProbeFile& file);

/// Checks that a volume in memory holds what every query relies on: counts that agree, indices in
/// range, neighbors that are each other's neighbors, finite numbers.
[[nodiscard]] Status verify(const ProbeVolumeView& volume);

/// A section that is not a member of the volume: data of a tool. Readers skip it.
struct ExtraSection {
    std::string_view name;  ///< at most 24 bytes; not the name of a member of the volume
    std::span<const std::byte> bytes;
    uint64_t element_size = 1;
};

/// Writes a volume and verifies what was written; the old file stays whole on failure. Returns
/// corrupt if the volume does not pass `verify`. The same volume gives the same bytes.
[[nodiscard]] Status write_probe_file(const std::string& path, const ProbeVolumeView& volume,
                                      std::span<const ExtraSection> extra = {});

/// The bytes that `write_probe_file` writes.
[[nodiscard]] std::vector<std::byte> probe_file_bytes(const ProbeVolumeView& volume,
                                                      std::span<const ExtraSection> extra = {});

}  // namespace tetralight
