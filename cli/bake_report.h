// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/bake/bake_statistics.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/check_leaks.h>
#include <tetralight/pipeline/partial_bake.h>

namespace tetralight::cli {

/// One run of `tetralight bake`.
struct BakeRun {
    std::string output;
    BakeSettings settings;
    /// Of sampling, in this run.
    double seconds = 0.0;
    /// Rays of the earlier runs that this one continued.
    uint64_t earlier_ray_count = 0;
};

/// Reports a bake of all probes. `leaks`: null if they were not checked.
void report_volume(const CommonOptions& common, const BakeRun& run, const BakedVolume& baked,
                   const LeakReport* leaks = nullptr);

/// Reports a bake of a range; `probe_count` is that of the volume.
void report_range(const CommonOptions& common, const BakeRun& run, const PartialBake& part,
                  size_t probe_count);

/// Samples per probe and standard errors, as fields of a bake's JSON.
[[nodiscard]] Json to_json(const BakeStatistics& statistics);

/// The same as one line for people.
[[nodiscard]] std::string to_text(const BakeStatistics& statistics);

}  // namespace tetralight::cli
