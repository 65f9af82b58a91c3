// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/pipeline/bake_volume.h>

namespace tetralight {

/// Whether the metadata of a volume records a setting.
enum class Recorded : uint8_t {
    Always,
    WhenChanged,  ///< unless it has its default
    Never,        ///< it shows in the volume itself, or changes no light
};

/// The settings of samples and light that `bake` and `lightmap` have after their first three.
template <class Settings, class Use>
void for_each_refinement_member(Settings& bake, const Use& use) {
    use("target_error", bake.target_error, Recorded::WhenChanged);
    use("target_layers", bake.target_layer_error, Recorded::WhenChanged);
    use("max_samples", bake.max_sample_count, Recorded::WhenChanged);
    use("time_budget", bake.time_budget_seconds, Recorded::WhenChanged);
    use("clamp", bake.clamp, Recorded::WhenChanged);
    use("albedo_boost", bake.surfaces.albedo_boost, Recorded::WhenChanged);
    use("max_albedo", bake.surfaces.max_albedo, Recorded::WhenChanged);
}

/// Calls `use(name, member, recorded)` for each member of `settings` that a setting of
/// `tetralight bake` (settings/bake_table.cpp) sets, with the name of that setting, in the order of
/// the metadata. The one place that knows which member a setting sets.
template <class Settings, class Use>
void for_each_bake_member(Settings& settings, Use use) {
    auto& [merge, bake, health, dering, lighting] = settings;
    use("samples", bake.sample_count, Recorded::Always);
    use("bounces", bake.bounces, Recorded::Always);
    use("seed", bake.seed, Recorded::Always);
    use("min_validity", health.min_validity, Recorded::Always);
    use("virtual_offset", health.virtual_offset, Recorded::Always);
    use("invalid_probes", health.invalid, Recorded::Always);
    for_each_refinement_member(bake, use);
    use("mixed_lighting", lighting.mixed_lighting, Recorded::WhenChanged);
    use("layers", lighting.layers, Recorded::Never);
    use("dering", dering.is_for_all_groups, Recorded::Never);
    use("dering_window", dering.window, Recorded::Never);
    use("weld", merge.weld_tolerance, Recorded::Never);
    use("threads", bake.thread_count, Recorded::Never);
}

}  // namespace tetralight
