// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/dering.h>

namespace tetralight {

struct DeringSettings {
    DeringWindow window = DeringWindow::Mildest;
    /// True: the ringing of all groups is removed, not only of those with `ProbeGroup::dering`.
    bool is_for_all_groups = false;

    bool operator==(const DeringSettings&) const = default;
};

/// "mildest", "hann", "lanczos".
[[nodiscard]] const char* name_of(DeringWindow window);

/// One a probe: true if the ringing of the probe is removed. For a probe of several groups one
/// group with `dering` is enough.
[[nodiscard]] std::vector<bool> dering_asked_for(const MergedProbes& merged,
                                                 const DeringSettings& settings);

/// The `dering` section of a volume, one a probe: 0 = none, else 1 + the window.
[[nodiscard]] std::vector<uint8_t> dering_marks(const MergedProbes& merged,
                                                const DeringSettings& settings);

/// Removes the ringing of all probes of `dering_asked_for`. Returns their number.
/// Precondition: one irradiance a probe.
size_t dering_probes(const MergedProbes& merged, const DeringSettings& settings,
                     std::span<IrradianceSh> irradiance);

}  // namespace tetralight
