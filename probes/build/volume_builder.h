// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight {

/// Builds the volume of a set of probe groups again and again while groups come and go, as in an
/// editor: it keeps the tetrahedra of the last build and changes them where probes differ.
///
///     VolumeBuilder builder;
///     for (const ProbeGroup& group : groups) require(builder.add_group(group));
///     ProbeVolume volume = *builder.build();
///     require(builder.remove_group("hall"));
///     ProbeVolume next = *builder.build();
///     copy_light(volume.view(), next);
///
/// A volume depends on the groups alone, not on the way to them: it is
/// `make_probe_volume(*merge(groups, settings))`, byte for byte.
class VolumeBuilder {
  public:
    explicit VolumeBuilder(const MergeSettings& settings = {});
    ~VolumeBuilder();
    VolumeBuilder(VolumeBuilder&&) noexcept;
    VolumeBuilder& operator=(VolumeBuilder&&) noexcept;

    /// Returns the errors of `merge`; the builder is unchanged then.
    Status add_group(ProbeGroup group);

    /// Returns not_found if there is no group of this name; the builder is unchanged then.
    Status remove_group(std::string_view name);

    [[nodiscard]] const std::vector<ProbeGroup>& groups() const { return groups_; }

    /// A volume without light over the current groups. Returns out_of_resources if there is no
    /// memory for their tetrahedra; the groups are as before then.
    [[nodiscard]] Result<ProbeVolume> build();

  private:
    struct Kept;

    MergeSettings settings_;
    std::vector<ProbeGroup> groups_;
    std::unique_ptr<Kept> kept_;
};

}  // namespace tetralight
