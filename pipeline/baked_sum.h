// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <tetralight/base/result.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// A volume as it was baked, with all layers at weight 1 and its irradiance in floats: a copy if
/// its layers have other weights now, or if its light is stored in halves alone.
class BakedSum {
  public:
    /// Keeps the view. Returns the errors of `recombine`, and corrupt if the halves are not those
    /// of all probes.
    [[nodiscard]] static Result<BakedSum> make(const ProbeVolumeView& volume);

    [[nodiscard]] ProbeVolumeView view() const { return copy_ ? copy_->view() : view_; }

  private:
    ProbeVolumeView view_;
    std::optional<ProbeVolume> copy_;
};

}  // namespace tetralight
