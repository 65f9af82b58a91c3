// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tetralight/cli/amounts.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/pipeline/resumable_bake.h>

namespace tetralight::cli {

/// Which probes `bake` bakes, and where light that is known already is kept: `probes`, `resume`,
/// `chunks`, `reuse`, `progress_file`.
struct BakeStoring {
    std::string output;
    std::optional<IndexRange> probes;
    bool is_resumed = false;
    std::string chunk_folder;
    std::string reuse_path;
    std::string progress_file;

    /// Throws a `UsageError` if settings do not go together.
    explicit BakeStoring(const Values& values);

    /// Checks before the bake that an interrupted one can be kept, and would replace nothing else.
    [[nodiscard]] Status check(const std::vector<std::string>& inputs,
                               const CommonOptions& common) const;

    /// Takes light from the volume of `reuse`, if there is one; warns if nothing can be reused.
    Status reuse(PreparedBake& prepared, const CommonOptions& common) const;

    /// Bakes what is not known yet. Returns cancelled after a signal; the message says what is
    /// kept.
    [[nodiscard]] Result<RangeBake> bake(const Scene& scene, const PreparedBake& prepared,
                                         const BakeCallback& show) const;

    /// Removes what an interrupted bake kept.
    void remove_kept(const RangeBake& baked) const;

  private:
    [[nodiscard]] std::string kept_path() const;
};

}  // namespace tetralight::cli
