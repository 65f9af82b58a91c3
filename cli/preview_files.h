// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/values.h>
#include <tetralight/lightmap/lightmaps.h>

namespace tetralight::cli {

/// The files of `preview`: pages of a bake of lightmaps as PNG, OpenEXR or `.lightmaps`, which are
/// replaced while it runs.
class PreviewFiles {
  public:
    /// Throws a `UsageError` if a file has another extension.
    explicit PreviewFiles(const Values& values);

    [[nodiscard]] bool is_empty() const { return paths_.empty(); }

    /// Returns an error if a file cannot be written, or is one of the `others`, which need not
    /// exist. `page_count` 0: not known yet.
    [[nodiscard]] Status check(const std::vector<std::string>& others, uint32_t page_count) const;

    /// Replaces all files. The first failure is kept; after it nothing is written.
    void write(const LightmapsView& lightmaps);

    /// How often files were written.
    [[nodiscard]] uint64_t revision() const { return revision_; }

    /// Warns of the failure, if there was one.
    void warn(const CommonOptions& common) const;

  private:
    std::vector<std::string> paths_;
    uint64_t revision_ = 0;
    Status status_ = Ok{};
};

}  // namespace tetralight::cli
