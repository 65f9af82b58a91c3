// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/result.h>

// Ranges of a bake, for parts that several machines bake.

namespace tetralight {

/// Every `step`-th place of [begin, end) of a bake, in its order: probes of a volume, or the texels
/// of lightmaps that are baked.
struct PlaceRange {
    uint32_t begin = 0;
    uint32_t end = 0;
    uint32_t step = 1;  ///< at least 1

    [[nodiscard]] uint32_t count() const { return begin == end ? 0 : (end - begin - 1) / step + 1; }

    /// Its place `i` among all places.
    [[nodiscard]] uint32_t operator[](size_t i) const {
        return begin + static_cast<uint32_t>(i) * step;
    }

    [[nodiscard]] bool contains(uint32_t place) const {
        return place >= begin && place < end && (place - begin) % step == 0;
    }

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

/// "12..20", or "12..20x4" for every fourth.
[[nodiscard]] std::string name_of(const PlaceRange& range);

/// Returns invalid_argument unless the range is within all places. The field is "probes" or
/// "texels".
[[nodiscard]] Status check_range(const PlaceRange& range, const AllPlaces& all);

/// Returns invalid_argument unless each place is in exactly one of the files. The message names the
/// first places in no file or in two. Precondition: there is a file, and the ranges are within all
/// places.
[[nodiscard]] Status check_cover(std::span<const FileRange> files, const AllPlaces& all);

/// At most `count` ranges of every `count`-th place, which together are all places; one empty range
/// without places. Neighbors cost about the same, so ranges do, too: of Sponza and the courtyard
/// the most expensive of 64 takes 1.2 to 1.3 times the mean, and 3 to 5 times if each has
/// neighbors.
[[nodiscard]] std::vector<PlaceRange> spread_ranges(size_t place_count, size_t count);

/// The `each` values of each place of a range.
template <class T>
[[nodiscard]] std::vector<T> take(std::span<const T> all, const PlaceRange& range,
                                  size_t each = 1) {
    std::vector<T> taken;
    taken.reserve(range.count() * each);
    for (uint32_t i = 0; i < range.count(); ++i) {
        const auto values = all.subspan(range[i] * each, each);
        taken.insert(taken.end(), values.begin(), values.end());
    }
    return taken;
}

/// Puts what `take` gives where it belongs.
template <class T>
void put(std::span<const T> values, const PlaceRange& range, std::span<T> all, size_t each = 1) {
    for (uint32_t i = 0; i < range.count(); ++i)
        std::ranges::copy(values.subspan(i * each, each), all.subspan(range[i] * each).begin());
}

}  // namespace tetralight
