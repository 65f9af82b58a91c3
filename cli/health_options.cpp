// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/health_options.h>

#include <tetralight/cli/choice.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {
void add_health_options(CLI::App& command, HealthSettings& settings) {
    command
        .add_option("--min-validity", settings.min_validity,
                    "Least share of directions without back faces; a probe with less lies in "
                    "geometry")
        ->check(numbers_in(0.0, 1.0))
        ->default_str("0.75");
    command
        .add_option("--virtual-offset", settings.virtual_offset,
                    "How far a probe in geometry may look for a place outside to gather its light "
                    "from, as a share of the distance to its group's nearest other probe (0 = not "
                    "at all)")
        ->check(numbers_in(0.0, 10.0))
        ->capture_default_str();
    add_choice(command, "--invalid-probes", settings.invalid,
               {{name_of(InvalidProbes::LeaveOut), InvalidProbes::LeaveOut},
                {name_of(InvalidProbes::Dilate), InvalidProbes::Dilate},
                {name_of(InvalidProbes::Keep), InvalidProbes::Keep}},
               "What becomes of probes in geometry that find none: leave-out = they are not in the "
               "volume; dilate = they take the light of those around them; keep = they stay as "
               "dark as it is there");
}

void add_dering_options(CLI::App& command, DeringSettings& settings) {
    command.add_flag("--dering", settings.is_for_all_groups,
                     "Remove ringing (negative irradiance) from the probes of all groups, not only "
                     "of those that ask for it");
    add_choice(command, "--dering-window", settings.window,
               {{name_of(DeringWindow::Mildest), DeringWindow::Mildest},
                {name_of(DeringWindow::Hann), DeringWindow::Hann},
                {name_of(DeringWindow::Lanczos), DeringWindow::Lanczos}},
               "How: mildest = each probe no more than it takes to be nowhere negative; hann, "
               "lanczos = one window for all");
}

}  // namespace tetralight::cli
