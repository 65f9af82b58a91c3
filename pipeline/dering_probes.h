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
    /// Whether groups that did not ask for it have their ringing removed too.
    bool is_for_all_groups = false;

    bool operator==(const DeringSettings&) const = default;
};

/// "mildest", "hann", "lanczos".
[[nodiscard]] const char* name_of(DeringWindow window);

/// One a probe: whether its group asks for less ringing. A probe of several groups counts as asked
/// for when one of them asks.
[[nodiscard]] std::vector<bool> dering_asked_for(const MergedProbes& merged,
                                                 const DeringSettings& settings);

/// What volumes record of it, one a probe: 0, or 1 + the window.
[[nodiscard]] std::vector<uint8_t> dering_marks(const MergedProbes& merged,
                                                const DeringSettings& settings);

/// Removes ringing from the probes of all groups that ask for it, and returns how many these are.
/// Precondition: one irradiance a probe.
size_t dering_probes(const MergedProbes& merged, const DeringSettings& settings,
                     std::span<IrradianceSh> irradiance);

}  // namespace tetralight
