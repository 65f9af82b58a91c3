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
#include <tetralight/pipeline/bake_visibility.h>
#include <tetralight/pipeline/dering_probes.h>
#include <tetralight/pipeline/lighting_plan.h>
#include <tetralight/pipeline/override_probes.h>
#include <tetralight/pipeline/prepare_probes.h>
#include <tetralight/pipeline/reused_light.h>
#include <tetralight/pipeline/unseen_places.h>
#include <tetralight/probes/build/merge.h>
#include <tetralight/probes/probe_group.h>
#include <tetralight/probes/probe_volume.h>

// The offline chain in one function:
//
//     groups → merge → prepare_probes → bake_probes → dilate, dering ┐
//                             └→ make_probe_volume → bake_visibility ┴→ ProbeVolume
//
// and in its three steps, for bakes that are interrupted and resumed, or split between machines:
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

/// Counts, times and warnings of a bake, for people.
struct BakeReport {
    size_t welded_count = 0;
    /// Groups whose probes were snapped to a lattice, and the largest distance of a snap, metres.
    std::vector<std::string> lattice_group_names;
    double largest_snap = 0.0;
    /// Probes inside geometry: those with a virtual offset, those left out of the volume, and those
    /// dilated, which have the light of other probes.
    size_t virtual_offset_count = 0;
    size_t left_out_count = 0;
    size_t dilated_count = 0;
    /// Probes with the light of an earlier bake (`reuse_probes`).
    size_t reused_count = 0;
    /// Of all runs of the bake.
    uint64_t ray_count = 0;
    VisibilityReport visibility;
    /// Free space that sees none of its cell's probes.
    UnseenPlaces unseen;
    BakeStatistics statistics;
    double merge_seconds = 0.0;
    double prepare_seconds = 0.0;
    double tetrahedralize_seconds = 0.0;
    double unseen_seconds = 0.0;
    double bake_seconds = 0.0;
    /// One line for each group with probes inside geometry or without light.
    std::vector<std::string> warnings;
};

struct BakedVolume {
    ProbeVolume volume;
    BakeReport report;
};

/// A bake before its light is sampled: the same for each part of the bake.
struct PreparedBake {
    /// Complete but for the light of its probes: it has ambient light, lights and metadata.
    ProbeVolume volume;
    MergedProbes merged;
    /// One a probe, world space: its position plus its virtual offset. Light is sampled there.
    std::vector<glm::dvec3> capture_positions;
    /// One a probe: true if its capture position is inside geometry.
    std::vector<bool> is_invalid;
    /// One a probe, from the scene's adjustment volumes; empty if they change no probe.
    std::vector<ProbeOverride> overrides;
    /// `settings.bake.plan` is the plan for this scene.
    BakeVolumeSettings settings;
    /// Hash of the volume and of all that its light depends on (`bake_key`). Parts of one bake have
    /// the same key.
    uint64_t key = 0;
    /// Empty, or set by `reuse_probes`.
    ReusedLight reused{};
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
/// own groups count only if they are among `groups`. Without groups the volume answers with its
/// ambient light. The same input gives the same bytes.
[[nodiscard]] Result<BakedVolume> bake_volume(const Scene& scene,
                                              std::span<const ProbeGroup> groups,
                                              const BakeVolumeSettings& settings,
                                              const BakeCallback& callback = {});

}  // namespace tetralight
