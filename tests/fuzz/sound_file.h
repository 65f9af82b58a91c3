// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/probes/detail/probe_file_layout.h>

namespace tetralight::fuzz {

/// Tetrahedra with layers and lights, triangles, segments, one probe.
constexpr size_t kVolumeKinds = 4;

/// A `.probes` file whose sections can be changed behind its checksums.
class SoundFile {
  public:
    explicit SoundFile(size_t kind);

    [[nodiscard]] size_t section_count() const { return table_.size(); }

    [[nodiscard]] std::span<std::byte> section(size_t index);
    /// Empty if there is none of this name.
    [[nodiscard]] std::span<std::byte> section(std::string_view name);

    /// The file with right checksums.
    [[nodiscard]] std::vector<std::byte> finish();

  private:
    std::vector<std::byte> bytes_;
    detail::FileHeader header_;
    std::vector<detail::SectionEntry> table_;
};

/// A sound file with the changes that a text names, a line each:
///
///     volume KIND             begins; 0 to 3
///     section NAME            of the lines below
///     f64 OFFSET NUMBER...    writes numbers (also f32, u32, u8) from that byte on
///     negate                  all floats of the section
///     # a comment
///
/// Fails the test if a line is wrong.
[[nodiscard]] std::vector<std::byte> file_of_changes(const std::string& path);

}  // namespace tetralight::fuzz
