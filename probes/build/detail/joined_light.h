// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/probe_volume.h>

namespace tetralight::detail {

/// A volume that has joined others.
struct LitPart {
    ProbeVolumeView view;
    std::optional<KnownWalls> walls;  ///< none if it knows none
};

/// Where a probe of a joined volume has its light from.
struct LightSource {
    const LitPart* part = nullptr;  ///< nullptr: there is no such probe
    uint32_t index = 0;             ///< of the probe in it
};

/// Makes the arrays of light as long as `sources`, and sets the light of some probes.
///
/// An array is there if one of the parts has it; probes of others then have what an empty array
/// means. Layers stay with the parts: probes have their sum.
void set_light(std::span<const LitPart* const> parts, std::span<const LightSource> sources,
               std::span<const uint32_t> changed, ProbeVolume& volume);

/// The walls between the probes of the cells of a joined volume. An edge has the code that the part
/// knows from which both of its probes have their light; edges between parts are unknown.
class JoinedWalls {
  public:
    /// Of all cells.
    void set_all(std::span<const LightSource> sources, ProbeVolume& volume);

    /// Of some cells, when others are as they were. Those from `end` on are copies of the first
    /// hull cell.
    void set(std::span<const uint32_t> cells, uint32_t end, std::span<const LightSource> sources,
             ProbeVolume& volume);

  private:
    void store(ProbeVolume& volume) const;

    std::vector<CellVisibility> visibility_;  // by cell
    std::vector<uint32_t> stored_;            // bits: whether a cell has one
};

}  // namespace tetralight::detail
