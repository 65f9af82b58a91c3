// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_settings.h>

namespace tetralight::cli {
namespace {

/// How many samples: as many as were asked for, or as many as the default error takes.
BakeSettings with_samples(BakeSettings settings, const Values& values) {
    if (values.is_given("samples")) settings.sample_count = values.integer32("samples");
    settings.target_error = values.number("target_error");
    settings.max_sample_count = values.integer("max_samples");
    settings.time_budget_seconds = values.number("time_budget");
    const bool has_rounds = settings.target_error > 0.0 || settings.time_budget_seconds > 0.0;
    if (settings.max_sample_count > 0 && !has_rounds) {
        refuse(values, "max_samples",
               "needs " + values.shown("target_error") + " or " + values.shown("time_budget"));
    }
    return has_rounds || values.is_given("samples") ? settings : with_default_target(settings);
}

}  // namespace

BakeVolumeSettings bake_settings(const Values& values) {
    BakeVolumeSettings settings;
    settings.bake = with_samples(settings.bake, values);
    settings.bake.bounces = values.integer32("bounces");
    settings.bake.clamp = values.number32("clamp");
    settings.bake.surfaces.albedo_boost = values.number32("albedo_boost");
    settings.bake.surfaces.max_albedo = values.number32("max_albedo");
    settings.bake.seed = values.integer("seed");
    settings.bake.thread_count = values.integer32("threads");
    settings.merge.weld_tolerance = values.number("weld");
    settings.health.min_validity = values.number32("min_validity");
    settings.health.virtual_offset = values.number("virtual_offset");
    settings.health.invalid = choice<InvalidProbes>(values, "invalid_probes");
    settings.dering.is_for_all_groups = values.flag("dering");
    settings.dering.window = choice<DeringWindow>(values, "dering_window");
    settings.lighting.mixed_lighting = choice<MixedLighting>(values, "mixed_lighting");
    settings.lighting.layers = values.texts("layers");
    return settings;
}

}  // namespace tetralight::cli
