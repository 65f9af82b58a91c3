// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include <tetralight/base/result.h>
#include <tetralight/probes/section_file.h>

namespace tetralight::detail {

/// `.probes` files, version 1.
inline constexpr SectionFileKind kProbeFileKind{
    {'T', 'E', 'T', 'R', 'A', 'P', 'V', '\n'}, 1, "probe file"};

/// The section table of a probe file.
[[nodiscard]] inline Result<std::span<const SectionEntry>> read_section_table(
    std::span<const std::byte> file) {
    return read_section_table(kProbeFileKind, file);
}

}  // namespace tetralight::detail
