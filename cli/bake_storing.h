// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tetralight/cli/amounts.h>
#include <tetralight/cli/common.h>
#include <tetralight/pipeline/bake_range.h>
#include <tetralight/pipeline/bake_volume.h>

namespace tetralight::cli {

/// What a bake bakes, and where light that is known already is kept: `resume`, `chunks`, `store`,
/// `store_limit`, `progress_file`, of `bake` also `probes` and `reuse`, and of `lightmap` `texels`
/// and `cache`.
/// The places of `reflect` are its cubes.
class BakeStoring {
  public:
    /// That of `probes` or `texels`; nothing: all of them.
    std::optional<PlaceRange> range;
    std::string progress_file;

    /// Throws a `UsageError` if settings do not go together.
    explicit BakeStoring(const Values& values);

    /// Returns an error if `progress_file` cannot be written, or is another file of the bake.
    [[nodiscard]] Status check_progress_file(std::vector<std::string> inputs) const;

    /// Opens the stores before the bake: that of `chunks` or `store`, else `OUTPUT.store`. Returns
    /// invalid_argument if other files lie there.
    [[nodiscard]] Status open();

    /// Takes light from the volume of `reuse`, if there is one; warns if nothing can be reused.
    Status reuse(PreparedBake& prepared, const CommonOptions& common) const;

    /// `range` of so many probes or texels. Returns invalid_argument if it is not within them.
    [[nodiscard]] Result<PlaceRange> range_of(size_t count) const;

    /// Where light is loaded from and saved to.
    [[nodiscard]] BakeStorage storage();

    /// The error of a bake that a signal cancelled; the message says what is kept.
    [[nodiscard]] Error interrupted();

    /// Bakes what is not known yet. Returns cancelled after a signal; the message says what is
    /// kept.
    [[nodiscard]] Result<RangeBake> bake(const Scene& scene, const PreparedBake& prepared,
                                         const BakeCallback& show, const RangePreview& preview);

    /// Warns of damaged entries, of entries that were not used, and of saves that failed.
    void warn(const StoredBake& baked, const CommonOptions& common) const;

    /// After the output is written: removes the store beside it, unless it holds work of another
    /// bake, and prunes that of `store`.
    void finish(const StoredBake& baked);

  private:
    [[nodiscard]] std::string path_beside() const;
    const char* range_setting_ = "";  ///< "texels" or "probes"; empty: bakes have no ranges
    std::string range_option_;        ///< as messages name it
    std::string output_;
    bool is_resumed_ = false;
    std::string chunk_folder_;
    std::string cache_folder_;
    std::string store_folder_;
    double store_limit_ = 0.0;  ///< gigabytes; 0: none
    std::string reuse_path_;

    std::optional<BakeStore> shared_;  ///< of `chunks` or `store`
    std::optional<BakeStore> cache_;   ///< of `cache`
    std::optional<BakeStore> beside_;  ///< beside the output
    bool has_old_entries_ = false;     ///< `beside_` had some when it was opened
};

}  // namespace tetralight::cli
