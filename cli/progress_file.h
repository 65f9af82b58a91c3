// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

/// What a bake counts: in text, and as members of JSON.
struct ProgressUnit {
    const char* plural = "probes";
    const char* done_member = "probes_done";
    const char* count_member = "probe_count";
};

inline constexpr ProgressUnit kTexels{"texels", "texels_done", "texel_count"};
/// Of the cubes of reflection probes.
inline constexpr ProgressUnit kTexelRows{"rows of texels", "rows_done", "row_count"};

/// The fraction of probes or texels that have reached the target errors, in [0, 1].
[[nodiscard]] float share_at_target(const BakeProgress& progress);

/// The progress of a bake for other programs: a JSON file that is replaced as a whole, so that
/// readers see the old facts or the new ones. A file that cannot be written stops no bake.
class ProgressFile {
  public:
    /// `path` empty: no file is written.
    explicit ProgressFile(std::string path, const ProgressUnit& unit = {});

    /// Pace of this run.
    struct Pace {
        double seconds = 0.0;  ///< since the run began
        double rays_per_second = 0.0;
        std::optional<double> seconds_left;
    };

    /// Writes the progress if the file is half a second old, if the time left is now known, or if
    /// all is done.
    void show(const BakeProgress& progress, const Pace& pace);

    /// Names the newest preview of the bake. Not while `show` runs.
    void set_preview(uint64_t revision) { preview_ = revision; }

    /// After the bake: replaces the number of those at the target errors by that of finished light.
    void set_at_target(size_t count);

    [[nodiscard]] const ProgressUnit& unit() const { return unit_; }

  private:
    void write(const BakeProgress& progress, const Pace& pace) const;

    std::string path_;
    ProgressUnit unit_;
    uint64_t preview_ = 0;  ///< 0: none
    double next_write_seconds_ = 0.0;
    bool has_told_time_left_ = false;
    BakeProgress last_;
    Pace last_pace_;
};

}  // namespace tetralight::cli
