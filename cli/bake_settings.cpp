// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_settings.h>

#include <tetralight/bake/round_plan.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_members.h>

namespace tetralight::cli {

bool takes_default_target(const BakeSettings& settings, const Values& values) {
    const bool has_rounds = settings.target_error > 0.0 || settings.target_layer_error > 0.0 ||
                            settings.time_budget_seconds > 0.0;
    const bool has_samples =
        values.is_given("samples") && settings.max_sample_count >= settings.sample_count;
    if (settings.max_sample_count > 0 && !has_rounds && !has_samples) {
        refuse(values, "max_samples",
               str_cat("needs ", values.shown("samples"), " of no more, ",
                       values.shown("target_error"), " or ", values.shown("time_budget")));
    }
    const uint64_t first = RoundPlan::first_round_samples(settings);
    if (settings.max_sample_count > 0 && settings.max_sample_count < first) {
        refuse(values, "max_samples",
               str_cat(settings.max_sample_count, " is less than the ", first,
                       " samples of the first round"));
    }
    return !has_rounds && !values.is_given("samples");
}

BakeVolumeSettings bake_settings(const Values& values) {
    BakeVolumeSettings settings;
    for_each_bake_member(settings, [&](const char* name, auto& member, Recorded) {
        read_if_any(values, name, member);
    });
    if (!takes_default_target(settings.bake, values)) return settings;
    settings.bake = with_default_target(settings.bake);
    if (!settings.lighting.layers.empty()) settings.bake.target_layer_error = kDefaultLayerError;
    return settings;
}

}  // namespace tetralight::cli
