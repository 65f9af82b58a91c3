// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <tetralight/probes/probe_file.h>
#include <tetralight/runtime/tetralight.h>

/// What the C API's handle holds: a file, and the light that took the place of the file's. Or what
/// volumes that joined are together.
struct tetralight_volume {
    explicit tetralight_volume(tetralight::ProbeFile from)
        : file(std::move(from)), source(file->view()), view(source) {}

    explicit tetralight_volume(const tetralight::ProbeVolumeView& joined)
        : source(joined), view(joined) {}

    std::optional<tetralight::ProbeFile> file;
    /// The volume as it is in the file, or as it was relit.
    tetralight::ProbeVolumeView source;
    /// What queries read.
    tetralight::ProbeVolumeView view;
    std::vector<tetralight::IrradianceSh> irradiance;
    std::vector<tetralight::CompactProbe> compact;
    std::vector<tetralight::Layer> layers;
    /// The volume with a new sky or sun, in place of the file's.
    std::unique_ptr<const tetralight::ProbeVolume> relit;
};

namespace tetralight::detail {

/// The volume that queries read.
[[nodiscard]] inline const ProbeVolumeView& view_of(const tetralight_volume& volume) {
    return volume.view;
}

}  // namespace tetralight::detail
