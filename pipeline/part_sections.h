// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tetralight/bake/bake_settings.h>
#include <tetralight/bake/probe_accumulator.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/dering_probes.h>
#include <tetralight/pipeline/place_range.h>
#include <tetralight/pipeline/prepare_probes.h>
#include <tetralight/probes/section_file.h>

// The sections that parts of probe volumes and parts of lightmaps share (docs/file_format.md).

namespace tetralight {

/// Section "part".
struct PartInfo {
    uint64_t key = 0;
    uint32_t begin = 0;
    uint32_t end = 0;
    double target_error = 0.0;
    double time_budget_seconds = 0.0;
    uint64_t max_sample_count = 0;
    uint32_t sample_count = 0;
    uint32_t step = 1;  ///< 0: an unfinished part of an earlier version
    // Of probes only.
    InvalidProbes invalid_probes = InvalidProbes::LeaveOut;
    DeringWindow dering_window = DeringWindow::Mildest;
    uint8_t dering_for_all_groups = 0;
    uint8_t is_unfiltered = 0;  ///< of lightmaps only
    float target_layer_error = 0.0f;

    PartInfo() = default;

    /// Those of probes have their defaults.
    PartInfo(uint64_t key, const PlaceRange& range, const BakeSettings& settings);

    [[nodiscard]] PlaceRange range() const { return {begin, end, step}; }

    /// The settings that it keeps.
    [[nodiscard]] BakeSettings bake_settings() const;
};

static_assert(sizeof(PartInfo) == 56 && std::is_trivially_copyable_v<PartInfo>);

/// The sums of a part, to be checked.
struct PartSums {
    PlaceRange range;
    std::span<const ProbeAccumulator> accumulators;
    std::span<const double> rows;
    size_t row_size = 0;
};

/// The sections of an open part: of a `ProbeFile` or a `LightmapFile`, which outlives this object.
class PartSections {
  public:
    template <class File>
    explicit PartSections(const File& file)
        : table_(file.sections()), find_([&file](std::string_view name, uint64_t element_size) {
              return file.section_bytes(name, element_size);
          }) {}

    /// The elements of a section; empty if the file does not have it.
    template <class T>
    [[nodiscard]] std::vector<T> read(std::string_view name) const {
        const auto bytes = find_(name, sizeof(T));
        if (!bytes || bytes->empty()) return {};
        std::vector<T> elements(bytes->size() / sizeof(T));
        std::memcpy(elements.data(), bytes->data(), bytes->size());
        return elements;
    }

    /// True if the file has a section "part".
    [[nodiscard]] bool is_part() const;

    /// Returns `not_a_part(writer)` without a section "part", invalid_argument if the part is not
    /// finished, unsupported if another version of the program wrote its accumulators, and the
    /// errors of `RoundPlan::check`.
    [[nodiscard]] Result<PartInfo> info(std::string_view writer) const;

  private:
    std::span<const FileSection> table_;
    std::function<std::optional<std::span<const std::byte>>(std::string_view, uint64_t)> find_;
};

/// A section to be written. The values outlive it.
template <class T>
[[nodiscard]] ExtraSection section_of(std::string_view name, const std::vector<T>& values) {
    return {name, std::as_bytes(std::span(values)), sizeof(T)};
}

/// The error of a file that is not a part; the message says that `writer` makes them.
[[nodiscard]] Error not_a_part(std::string_view writer);

/// Returns corrupt unless the range is within all places, there is an accumulator and a row for
/// each place of it, and rounds of the settings can give them. `is_reused`: one a place of the
/// bake, true where the accumulator is empty; or empty.
[[nodiscard]] Status check_sums(const PartSums& sums, const AllPlaces& all,
                                const BakeSettings& settings,
                                const std::vector<bool>& is_reused = {});

/// Returns corrupt unless the range is within all places.
[[nodiscard]] Status check_part_range(const PlaceRange& range, const AllPlaces& all);

}  // namespace tetralight
