// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_settings.h>

#include <tetralight/pipeline/bake_members.h>

namespace tetralight::cli {
namespace {

/// Samples are as many as were asked for, or as many as the default error takes.
BakeSettings with_default_rounds(const BakeSettings& settings, bool has_layers,
                                 const Values& values) {
    const bool has_rounds = settings.target_error > 0.0 || settings.target_layer_error > 0.0 ||
                            settings.time_budget_seconds > 0.0;
    if (settings.max_sample_count > 0 && !has_rounds) {
        refuse(values, "max_samples",
               "needs " + values.shown("target_error") + " or " + values.shown("time_budget"));
    }
    if (has_rounds || values.is_given("samples")) return settings;
    BakeSettings with_target = with_default_target(settings);
    if (has_layers) with_target.target_layer_error = kDefaultLayerError;
    return with_target;
}

}  // namespace

BakeVolumeSettings bake_settings(const Values& values) {
    BakeVolumeSettings settings;
    for_each_bake_member(settings, [&](const char* name, auto& member, Recorded) {
        read_if_any(values, name, member);
    });
    settings.bake = with_default_rounds(settings.bake, !settings.lighting.layers.empty(), values);
    return settings;
}

}  // namespace tetralight::cli
