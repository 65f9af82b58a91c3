// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <tetralight/base/result.h>

// Ranges of a bake, for parts that several machines bake.

namespace tetralight {

/// Places [begin, end) of a bake, in its order: probes of a volume, or the texels of lightmaps that
/// are baked.
struct PlaceRange {
    uint32_t begin = 0;
    uint32_t end = 0;

    [[nodiscard]] uint32_t count() const { return end - begin; }

    bool operator==(const PlaceRange&) const = default;
};

/// All places of a bake, for messages.
struct AllPlaces {
    std::string name;  ///< "probe" or "texel"
    size_t count = 0;
};

/// A range that a file has.
struct FileRange {
    std::string path;
    PlaceRange range;
};

/// "12..20".
[[nodiscard]] std::string name_of(const PlaceRange& range);

/// Returns invalid_argument unless the range is within all places. The field is "probes" or
/// "texels".
[[nodiscard]] Status check_range(const PlaceRange& range, const AllPlaces& all);

/// Returns invalid_argument unless each place is in exactly one of the files. The message names the
/// first places in no file or in two, and the files beside them. Precondition: the files are sorted
/// by the begin of their range, and there is one.
[[nodiscard]] Status check_cover(std::span<const FileRange> files, const AllPlaces& all);

}  // namespace tetralight
