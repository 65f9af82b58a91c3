// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/bake_probes.h>
#include <tetralight/bake/bake_statistics.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/dering_probes.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/override_probes.h>
#include <tetralight/pipeline/prepare_probes.h>
#include <tetralight/pipeline/reused_probes.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_group.h>
#include <tetralight/probes/probe_volume.h>

// The offline chain in one function:
//
//     groups → merge → prepare_probes → bake_probes → dilate, dering ┐
//                             └→ make_probe_volume ──────────────────┴→ ProbeVolume
//
// and in its three steps, for bakes that are put aside, or shared by several machines:
//
//     prepare_bake → bake_accumulators → finish_bake

namespace tetralight {

struct BakeVolumeSettings {
    MergeSettings merge;
    BakeSettings bake;
    HealthSettings health;
    DeringSettings dering;
    LightingSettings lighting{};

    bool operator==(const BakeVolumeSettings&) const = default;
};

/// What a bake did, for the user.
struct BakeReport {
    size_t welded_count = 0;
    /// Groups whose probes were moved exactly onto a lattice, and the longest move, metres.
    std::vector<std::string> lattice_group_names;
    double largest_snap = 0.0;
    /// Probes that lie in geometry: those that look from a place outside of it, those that are not
    /// in the volume, and those that have the light of others.
    size_t moved_count = 0;
    size_t left_out_count = 0;
    size_t dilated_count = 0;
    /// Probes that took the light of an earlier bake.
    size_t reused_count = 0;
    /// Of all runs, when the bake was put aside in between.
    uint64_t ray_count = 0;
    BakeStatistics statistics;
    double merge_seconds = 0.0;
    double prepare_seconds = 0.0;
    double tetrahedralize_seconds = 0.0;
    double bake_seconds = 0.0;
    /// Groups with probes in geometry or in the dark, one line each.
    std::vector<std::string> warnings;
};

struct BakedVolume {
    ProbeVolume volume;
    BakeReport report;
};

/// A bake before its light: the same for every part of it.
struct PreparedBake {
    /// Whole but for the light of its probes; ambient light, lights and metadata are there.
    ProbeVolume volume;
    MergedProbes merged;
    /// Where the light of each probe is gathered, world space.
    std::vector<glm::dvec3> capture_positions;
    /// One a probe: it looks from inside geometry.
    std::vector<bool> is_invalid;
    /// What the scene's adjustment volumes say, one a probe; empty: they say nothing.
    std::vector<ProbeOverride> overrides;
    /// With the plan of `settings.bake` made for the scene.
    BakeVolumeSettings settings;
    /// Hash of all that the light depends on, and of the volume: what has another key is no part of
    /// the same bake.
    uint64_t key = 0;
    /// None, unless `reuse_probes` found some.
    ReusedProbes reused{};
    BakeReport report;
};

[[nodiscard]] Result<PreparedBake> prepare_bake(const Scene& scene,
                                                std::span<const ProbeGroup> groups,
                                                const BakeVolumeSettings& settings);

/// Puts the light of all probes into the volume. A function of the volume, `merged`, `is_invalid`,
/// the settings, the accumulators and the rows of what light was split into (`LightGroupRows`), and
/// what is reused, alone. Precondition: one accumulator for each probe, and one row of
/// `split_layout(volume)`; empty ones where light is reused.
[[nodiscard]] BakedVolume finish_bake(PreparedBake prepared,
                                      std::span<const ProbeAccumulator> accumulators,
                                      std::span<const double> split_rows = {});

/// Bakes a scene's light at the probes of all `groups` and joins them in one volume. The scene's
/// own groups count only if they are among `groups`. No group at all gives a volume that answers
/// with its ambient light. Same input, same bytes.
[[nodiscard]] Result<BakedVolume> bake_volume(const Scene& scene,
                                              std::span<const ProbeGroup> groups,
                                              const BakeVolumeSettings& settings,
                                              const BakeCallback& callback = {});

}  // namespace tetralight
