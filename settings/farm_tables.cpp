// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/shared_settings.h>

// The commands that cut bakes into tasks (docs/farm.md).

namespace tetralight::settings {
namespace {

constexpr Setting kJob =
    input_file("job", "Folder of the job, which `tetralight plan` made and machines share");

constexpr Setting kOrder = input_file(
    "order", "What to bake: an order (.json) with scenes and settings, or one scene (.glb, .gltf)");

constexpr Setting output_folder(std::string_view help) {
    Setting setting = output_file("", help);
    setting.value_name = "FOLDER";
    return setting;
}

constexpr Setting kPlanFiles[] = {kOrder, output_folder("Folder of the job to make")};

constexpr Setting kCuts[] = {
    {.name = "tasks",
     .type = Type::Integer,
     .help = "Tasks of the probes of each scene, and as many of its lightmaps",
     .unit = "tasks",
     .range = {1, 100000},
     .without = "as many as --task-seconds asks",
     .excludes = "task_seconds",
     .access = Access::Command},
    {.name = "task_seconds",
     .type = Type::Seconds,
     .help = "How long a task should take on a machine like this one",
     .unit = "seconds",
     .range = {0, 1e7, true},
     .default_text = "300",
     .access = Access::Command},
    {.name = "core_hour_price",
     .type = Type::Number,
     .help = "Price of one processor for an hour: the plan says what the bake will cost",
     .unit = "currency",
     .range = {0, 1e6},
     .without = "no price is given",
     .access = Access::Command}};

constexpr Setting task_number() {
    Setting setting = input_file("task", "Number of the task, from 0");
    setting.type = Type::Integer;
    setting.unit = "number";
    setting.range = {0, 1e9};
    setting.access = Access::Command;
    return setting;
}

constexpr Setting kTaskFiles[] = {kJob, task_number()};

constexpr Setting kProgress[] = {
    {.name = "progress",
     .type = Type::Choice,
     .help = "Lines about the progress: plain = \"Progress: 40%\" on stderr, as most schedulers "
             "read it; openjd = \"openjd_progress: 40\" on stdout (Open Job Description)",
     .choices = "plain openjd",
     .default_text = "plain",
     .access = Access::Command}};

constexpr Setting kCollectFiles[] = {kJob,
                                     {.name = "output",
                                      .type = Type::Path,
                                      .help = "Folder for what was baked, and for report.json",
                                      .without = "what `submit` was given, or \"baked\" in the "
                                                 "folder of the job",
                                      .value_name = "FOLDER",
                                      .short_name = 'o',
                                      .access = Access::Command}};

constexpr Setting kSubmitFiles[] = {kJob,
                                    {.name = "output",
                                     .type = Type::Path,
                                     .help = "Folder for what was baked, and for report.json",
                                     .without = "\"baked\" in the folder of the job",
                                     .value_name = "FOLDER",
                                     .short_name = 'o',
                                     .access = Access::Command}};

constexpr Setting kScheduler[] = {
    {.name = "to",
     .type = Type::Choice,
     .help = "slurm = send arrays of jobs by sbatch, and return; make = run the tasks by GNU make "
             "on this machine",
     .choices = "slurm make",
     .is_required = true,
     .access = Access::Command},
    {.name = "at_once",
     .type = Type::Integer,
     .help = "Tasks that run at once",
     .unit = "tasks",
     .range = {1, 100000},
     .without = "as many as Slurm has room for; 1 with make",
     .access = Access::Command},
    {.name = "restarts",
     .type = Type::Integer,
     .help = "How often Slurm starts a task again that was interrupted, killed, or may succeed "
             "later",
     .unit = "times",
     .range = {0, 1000},
     .default_text = "10",
     .access = Access::Command},
    {.name = "program",
     .type = Type::Path,
     .help = "Where the machines that run tasks have the `tetralight` command",
     .without = "where this one has it",
     .access = Access::Command},
    {.name = "option",
     .type = Type::Text,
     .help = "An option for sbatch or make, passed on as it is: --option=--partition=long",
     .without = "no other options",
     .value_name = "OPTION",
     .is_list = true,
     .access = Access::Command},
    {.name = "dry_run",
     .type = Type::Flag,
     .help = "Print the files and commands; write and send nothing",
     .access = Access::Command}};

constexpr Setting kAllFiles[] = {
    kOrder, output_folder("Folder for what is baked; \"job\" in it keeps what is known for the "
                          "next time")};

constexpr Setting kLimitSettings[] = {
    {.name = "error",
     .type = Type::Fraction,
     .help = "Standard error that 99 % of probes, and half of texels, have to stay below",
     .without = "any"},
    {.name = "dead_probes",
     .type = Type::Fraction,
     .help = "Share of probes that may be inside geometry",
     .without = "any"},
    {.name = "leak",
     .type = Type::Fraction,
     .help = "Light through walls, as a fraction of the mean light (`check-leaks`)",
     .without = "not measured"},
    {.name = "seconds",
     .type = Type::Seconds,
     .help = "Seconds that all tasks of the scene may take together",
     .without = "any"}};
constexpr Group kLimitGroups[] = {{"Limits", kLimitSettings}};

constexpr Group kPlanGroups[] = {
    {"Files", kPlanFiles}, {"Tasks", kCuts}, {"Common options", kCommonSettings}};
constexpr Group kTaskGroups[] = {
    {"Files", kTaskFiles}, {"Progress", kProgress}, {"Common options", kCommonSettings}};
constexpr Group kCollectGroups[] = {{"Files", kCollectFiles}, {"Common options", kCommonSettings}};
constexpr Group kSubmitGroups[] = {
    {"Files", kSubmitFiles}, {"Scheduler", kScheduler}, {"Common options", kCommonSettings}};
constexpr Group kAllGroups[] = {
    {"Files", kAllFiles}, {"Progress", kProgress}, {"Common options", kCommonSettings}};

}  // namespace

const Table kBakeAll{.command = "bake-all",
                     .summary =
                         "Bake probes, lightmaps and reflection probes, and what changed "
                         "since the last time",
                     .examples =
                         "tetralight bake-all hall.glb -o baked\n"
                         "tetralight bake-all levels.json -o baked",
                     .groups = kAllGroups};

const Table kPlan{.command = "plan",
                  .summary = "Cut the bakes of many scenes into tasks for many machines",
                  .examples =
                      "tetralight plan levels.json -o /shared/job\n"
                      "tetralight plan hall.glb --tasks 64 -o /shared/job",
                  .groups = kPlanGroups};

const Table kTask{.command = "task",
                  .summary = "Run one task of a job; exit code 75 means: try it again",
                  .examples = "tetralight task /shared/job 17",
                  .groups = kTaskGroups};

const Table kCollect{.command = "collect",
                     .summary = "Join the results of all tasks of a job",
                     .examples = "tetralight collect /shared/job -o baked",
                     .groups = kCollectGroups};

const Table kLimits{.command = "limits",
                    .summary = "What a scene of an order has to keep",
                    .examples = "",
                    .groups = kLimitGroups};

const Table kSubmit{.command = "submit",
                    .summary = "Have a scheduler run the tasks of a job and join their results",
                    .examples =
                        "tetralight submit /shared/job --to slurm --at-once 64 --threads 8\n"
                        "tetralight submit job --to make --at-once 4 -o baked",
                    .groups = kSubmitGroups};

}  // namespace tetralight::settings
