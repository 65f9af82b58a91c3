// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_settings.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight::cli {
namespace {

std::optional<WorldBox> box_in(const Values& values) {
    constexpr const char* kAxes[] = {"x", "y", "z"};
    if (!values.is_given("min")) return std::nullopt;
    const WorldBox box{vec3(values, "min"), vec3(values, "max")};
    const glm::dvec3 min = vec3(values, "min"), max = vec3(values, "max");
    for (int i = 0; i < 3; ++i) {
        if (min[i] <= max[i]) continue;
        refuse(values, "max",
               str_cat(max[i], " is less than ", values.shown("min"), " ", min[i], " along ",
                       kAxes[i]));
    }
    return box;
}

void check_mode(const Values& values, PlacementMode mode) {
    const bool is_adaptive = mode == PlacementMode::Adaptive;
    if (!values.is_given("spacing") && !is_adaptive) require(values, "spacing");
    for (const char* name : {"target_error", "error", "time_budget", "bounces", "seed"}) {
        if (is_adaptive || !values.is_given(name)) continue;
        refuse(values, name, str_cat("is for ", values.shown("mode"), " adaptive"));
    }
    if (values.is_given("heights") && mode != PlacementMode::Layers) {
        refuse(values, "heights", str_cat("is for ", values.shown("mode"), " layers"));
    }
}

AdaptiveSettings adaptive_settings(const Values& values) {
    AdaptiveSettings settings;
    if (values.is_given("spacing")) settings.start_spacing = vec3(values, "spacing");
    settings.target_error = values.number("target_error");
    settings.error_kind = choice<ErrorKind>(values, "error");
    settings.time_budget_seconds = values.number("time_budget");
    settings.bake.bounces = values.integer32("bounces");
    settings.bake.seed = values.integer("seed");
    return settings;
}

std::vector<glm::dvec3> seeds_in(const Values& values) {
    std::vector<glm::dvec3> seeds;
    if (const auto* all = values.find("from")) {
        for (const auto& seed : *all) {
            const auto v = seed.get<std::array<double, 3>>();
            seeds.emplace_back(v[0], v[1], v[2]);
        }
    }
    return seeds;
}

}  // namespace

ProbeGridSettings grid_settings(const Values& values) {
    ProbeGridSettings settings;
    settings.mode = choice<PlacementMode>(values, "mode");
    check_mode(values, settings.mode);
    if (values.is_given("spacing")) settings.spacing = vec3(values, "spacing");
    settings.bounds = box_in(values);
    settings.bounds_of = values.texts("bounds_of");
    settings.heights = values.numbers("heights");
    if (values.is_given("clearance")) settings.clearance = values.number("clearance");
    if (values.is_given("agent_radius")) settings.agent_radius = values.number("agent_radius");
    settings.from = seeds_in(values);
    settings.dark = values.flag("keep_dark") ? DarkSpaces::Keep : DarkSpaces::Drop;
    settings.unreachable = choice<UnreachableSpaces>(values, "unreachable");
    settings.region_size = values.number("region_size");
    settings.name = values.text("name");
    if (auto status = check_characters(settings.name); !status) {
        refuse_because(values, "name", status.error());
    }
    settings.agent_height = values.number("agent_height");
    if (values.is_given("max_probes")) settings.max_probes = values.integer("max_probes");
    if (values.is_given("reflections")) {
        settings.reflection_spacing = values.number("reflection_spacing");
    }
    settings.adaptive = adaptive_settings(values);
    settings.thread_count = values.integer32("threads");
    return settings;
}

}  // namespace tetralight::cli
