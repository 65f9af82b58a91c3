// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_options.h>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>
#include <tetralight/cli/amounts.h>
#include <tetralight/cli/choice.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/validators.h>
#include <tetralight/probes/is_finite.h>

namespace tetralight::cli {
namespace {

constexpr double kLongest = 1e9;

/// The names that `merge` takes.
CLI::Validator name_check() {
    const auto check = [](const std::string& name) -> std::string {
        const auto status = check_characters(name);
        return status ? "" : error_text(status.error());
    };
    return {check, ""};
}

CLI::Validator at_least_one() {
    const auto check = [](const std::string& count) -> std::string {
        return count.find_first_not_of('0') == std::string::npos ? "there is no grid of 0 probes"
                                                                 : "";
    };
    return {check, ""};
}

CLI::Validator position_check() {
    const auto check = [](const std::string& position) -> std::string {
        const auto parsed = parse_vec3(position);
        if (!parsed) return "\"" + position + "\" is not of the form x,y,z";
        return is_finite(*parsed) ? "" : "\"" + position + "\" is not finite";
    };
    return {check, ""};
}

}  // namespace

void GridOptions::add_to(CLI::App& command) {
    add_choice(command, "--mode", settings.mode,
               {{"regular", PlacementMode::Regular},
                {"layers", PlacementMode::Layers},
                {"surface", PlacementMode::Surface},
                {"adaptive", PlacementMode::Adaptive}},
               "regular = a lattice; layers = at heights above every floor; surface = on both "
               "sides of walls; adaptive = where light changes");
    spacing_option_ =
        add_vec3_or_number(command, "--spacing", settings.spacing,
                           "Metres between probes; --mode adaptive begins with it, or with "
                           "an eighth of the longest side");
    spacing_option_->check(numbers_in(1e-6, kLongest).description(""));
    add_bounds(command);
    add_rules(command);
    add_reach(command);
    add_adaptive(command);
    command.add_option("--name", settings.name, "Name of the probe groups")
        ->check(not_empty("name"))
        ->check(name_check())
        ->capture_default_str();
    command
        .add_option("--region-size", settings.region_size,
                    "Split the groups by cubes of this size, metres (0 = not split)")
        ->check(numbers_in(0.0, kLongest))
        ->capture_default_str();
    command
        .add_option("--max-probes", settings.max_probes,
                    "Refuse grids with more candidates than this; --mode adaptive stays below it "
                    "(default: 10 million, 5000 when adaptive)")
        ->check(whole_numbers(UINT64_MAX, "2^64 - 1"))
        ->check(at_least_one());
}

void GridOptions::add_bounds(CLI::App& command) {
    low_option_ = add_vec3(command, "--min", bounds_.min, "Lower corner of the box to fill");
    auto* high = add_vec3(command, "--max", bounds_.max, "Upper corner of the box");
    low_option_->needs(high);
    high->needs(low_option_);
    command
        .add_option("--bounds-of", settings.bounds_of,
                    "Fill the box around the node of this name; may be given several times")
        ->allow_extra_args(false)
        ->check(not_empty("name"))
        ->excludes(low_option_);
}

void GridOptions::add_rules(CLI::App& command) {
    heights_option_ = command
                          .add_option("--heights", settings.heights,
                                      "With --mode layers: metres above the floor, with commas")
                          ->delimiter(',')
                          ->check(numbers_in(1e-6, kLongest))
                          ->capture_default_str();
    clearance_option_ =
        command
            .add_option("--clearance", clearance_,
                        "Metres that probes keep from surfaces (default: a tenth of the spacing, "
                        "0.25 at most)")
            ->check(numbers_in(0.0, kLongest));
}

void GridOptions::add_reach(CLI::App& command) {
    command
        .add_option("--from", seeds_,
                    "Fill the space that this position lies in; may be given several times "
                    "(default: the largest space)")
        ->allow_extra_args(false)
        ->check(position_check())
        ->type_name("X,Y,Z");
    add_choice(command, "--unreachable", settings.unreachable,
               {{"drop", UnreachableSpaces::Drop}, {"keep", UnreachableSpaces::Keep}},
               "What becomes of probes in other spaces");
}

void GridOptions::add_adaptive(CLI::App& command) {
    AdaptiveSettings& adaptive = settings.adaptive;
    auto* error = add_share(command, "--target-error", adaptive.target_error,
                            "With --mode adaptive: done when interpolated light is this near to "
                            "the light that is there (root mean square, of the mean irradiance)");
    error->default_str("5%");
    auto* time = add_time(command, "--time-budget", adaptive.time_budget_seconds,
                          "With --mode adaptive: keep what there is after this time; not "
                          "reproducible");
    auto* bounces = command
                        .add_option("-b,--bounces", adaptive.bake.bounces,
                                    "With --mode adaptive: reflections that light may take")
                        ->check(CLI::Range(0u, 1000u))
                        ->capture_default_str();
    auto* seed = add_seed(command, adaptive.bake.seed, "Seed of the random numbers");
    adaptive_options_ = {error, time, bounces, seed};
}

void GridOptions::check_usage() const {
    constexpr const char* kAxes[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
        if (bounds_.min[i] <= bounds_.max[i]) continue;
        throw CLI::ValidationError("--max", str_cat(bounds_.max[i], " is less than --min ",
                                                    bounds_.min[i], " along ", kAxes[i]));
    }
    const bool is_adaptive = settings.mode == PlacementMode::Adaptive;
    if (spacing_option_->count() == 0 && !is_adaptive) throw CLI::RequiredError("--spacing");
    for (const CLI::Option* option : adaptive_options_) {
        if (option->count() == 0 || is_adaptive) continue;
        throw CLI::ValidationError(option->get_name(), "is for --mode adaptive");
    }
    if (heights_option_->count() > 0 && settings.mode != PlacementMode::Layers) {
        throw CLI::ValidationError("--heights", "is for --mode layers");
    }
}

void GridOptions::finish() {
    if (low_option_->count() > 0) settings.bounds = bounds_;
    if (spacing_option_->count() > 0) settings.adaptive.start_spacing = settings.spacing;
    if (clearance_option_->count() > 0) settings.clearance = clearance_;
    for (const std::string& seed : seeds_) settings.from.push_back(*parse_vec3(seed));
}

}  // namespace tetralight::cli
