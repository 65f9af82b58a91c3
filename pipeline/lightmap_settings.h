// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_members.h>

namespace tetralight {

/// Calls `use(name, member, recorded)` for each member of `settings` that a setting of `tetralight
/// lightmap` (settings/lightmap_table.cpp) sets, as `for_each_bake_member` does it for `bake`.
template <class Settings, class Use>
void for_each_lightmap_setting(Settings& settings, Use use) {
    auto& [layout, texels, bake, is_exact, is_unfiltered, has_normal_maps, lighting,
           ambient_occlusion_distance, only] = settings;
    use("texels_per_meter", layout.texels_per_meter, Recorded::Always);
    use("page_size", layout.page_size, Recorded::Always);
    use("uvs", layout.uvs, Recorded::WhenChanged);
    use("max_angle", layout.unwrap.max_angle_degrees, Recorded::WhenChanged);
    use("places", texels.grid, Recorded::Always);
    use("min_validity", texels.min_validity, Recorded::Always);
    use("samples", bake.sample_count, Recorded::Always);
    use("bounces", bake.bounces, Recorded::Always);
    use("seed", bake.seed, Recorded::Always);
    for_each_refinement_member(bake, use);
    use("exact", is_exact, Recorded::WhenChanged);
    use("no_filter", is_unfiltered, Recorded::WhenChanged);
    use("mixed_lighting", lighting.mixed_lighting, Recorded::WhenChanged);
    use("normal_maps", has_normal_maps, Recorded::WhenChanged);
    use("layers", lighting.layers, Recorded::Never);
    use("ambient_occlusion", ambient_occlusion_distance, Recorded::WhenChanged);
    use("only", only, Recorded::Never);
    use("threads", bake.thread_count, Recorded::Never);
}

}  // namespace tetralight
