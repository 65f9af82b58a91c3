// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// A volume as it was baked, with all layers at weight 1: a copy if they have other weights now.
class BakedSum {
  public:
    /// Keeps the view. Returns the errors of `recombine`.
    [[nodiscard]] static Result<BakedSum> make(const ProbeVolumeView& volume);

    [[nodiscard]] ProbeVolumeView view() const { return copy_ ? copy_->view() : view_; }

  private:
    ProbeVolumeView view_;
    std::optional<ProbeVolume> copy_;
};

}  // namespace tetralight
