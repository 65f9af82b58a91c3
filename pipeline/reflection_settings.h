// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/pipeline/bake_members.h>
#include <tetralight/pipeline/bake_reflections.h>

namespace tetralight {

/// Calls `use(name, member, recorded)` for each member of `settings` that a setting of `tetralight
/// reflect` (settings/reflect_table.cpp) sets, as `for_each_bake_member` does it for `bake`.
template <class Settings, class Use>
void for_each_reflection_setting(Settings& settings, Use use) {
    use("cube_size", settings.cube_size, Recorded::Always);
    use("samples", settings.bake.sample_count, Recorded::Always);
    use("bounces", settings.bake.bounces, Recorded::Always);
    use("seed", settings.bake.seed, Recorded::Always);
    use("layers", settings.layers, Recorded::Never);
    use("min_validity", settings.min_validity, Recorded::WhenChanged);
    use("clamp", settings.bake.clamp, Recorded::WhenChanged);
    use("albedo_boost", settings.bake.surfaces.albedo_boost, Recorded::WhenChanged);
    use("max_albedo", settings.bake.surfaces.max_albedo, Recorded::WhenChanged);
    use("threads", settings.bake.thread_count, Recorded::Never);
}

}  // namespace tetralight
