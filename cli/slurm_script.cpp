// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/slurm_script.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {
namespace {

/// Slurm reads them up to the first command of a script.
constexpr const char* kDirectives = R"(#SBATCH --job-name=tetralight
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@60
)";

/// Programs run in the background, so that traps run at once: `wait` returns, and `run` waits
/// again.
constexpr const char* kFunctions = R"(child= worst=0 is_interrupted=no is_ending=no is_cancelled=no
# A minute before the time limit, the shell alone gets this signal. SIGTERM makes the program save its work.
trap 'is_interrupted=yes is_ending=yes; [ -z "$child" ] || kill -TERM "$child"' USR1
# Slurm cancels the job or needs the node: the program gets the same signal.
trap 'is_interrupted=yes is_ending=yes is_cancelled=yes' TERM

run() {
    "$program" "$@" --threads "${SLURM_CPUS_ON_NODE:-0}" &
    child=$! code=127 is_interrupted=yes
    while [ "$is_interrupted" = yes ]; do
        is_interrupted=no
        wait "$child"
        status=$?
        [ "$status" -eq 127 ] || code=$status
    done
    child=
    [ "$code" -eq 0 ] || worst=$code
}

# 75: the same may succeed later. Above 128: a signal ended the program.
finish() {
    if [ "$worst" -eq 75 ] || [ "$worst" -gt 128 ]; then
        if [ "$is_cancelled" = no ] && [ "${SLURM_RESTART_COUNT:-0}" -lt "$restarts" ]; then
            scontrol requeue "$1"
        fi
    fi
    exit "$worst"
}
)";

constexpr const char* kTaskBegin = R"(#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Written by `tetralight submit`. An element of an array runs tasks of a phase, in the folder of the job.
# PROGRAM RESTARTS FIRST END TASKS: the phase has the tasks from FIRST to END - 1, an element has TASKS of them.
)";

constexpr const char* kTaskArguments = R"(program=$1 restarts=$2 first=$3 end=$4 tasks=$5
)";

constexpr const char* kTaskEnd = R"(
task=$((first + SLURM_ARRAY_TASK_ID * tasks))
stop=$((task + tasks))
[ "$stop" -le "$end" ] || stop=$end
while [ "$task" -lt "$stop" ] && [ "$is_ending" = no ]; do
    run task . "$task"
    task=$((task + 1))
done
# What was not begun is begun by the next start.
[ "$task" -eq "$stop" ] || worst=75
finish "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
)";

constexpr const char* kCollectBegin = R"(#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Written by `tetralight submit`. Joins the results of all tasks, in the folder of the job.
# PROGRAM RESTARTS
)";

constexpr const char* kCollectArguments = R"(program=$1 restarts=$2
)";

constexpr const char* kCollectEnd = R"(
run collect .
finish "$SLURM_JOB_ID"
)";

/// In patterns of file names.
std::string with_double_percents(const std::string& path) {
    std::string text;
    for (const char c : path) text += c == '%' ? std::string("%%") : std::string(1, c);
    return text;
}

/// What all jobs have. `log`: the pattern of its name.
CommandWords sbatch(const Submission& submission, const std::string& log) {
    CommandWords words{"sbatch", "--parsable", "--chdir=" + submission.job,
                       str_cat("--output=", with_double_percents(submission.job), "/logs/", log)};
    if (submission.thread_count > 0)
        words.push_back(str_cat("--cpus-per-task=", submission.thread_count));
    return words;
}

/// `kind`: "afterok", or "afterany" for what runs after failures, too.
void add_dependency(CommandWords& words, const char* kind, const std::string& after) {
    if (after.empty()) return;
    words.push_back(str_cat("--dependency=", kind, ":", after));
    words.push_back("--kill-on-invalid-dep=yes");
}

void add_script(CommandWords& words, const Submission& submission, const char* script) {
    words.insert(words.end(), submission.options.begin(), submission.options.end());
    words.push_back(script);
    words.push_back(submission.program);
    words.push_back(str_cat(submission.restart_count));
}

}  // namespace

std::vector<JobFile> slurm_scripts() {
    return {{"slurm/task.sbatch",
             str_cat(kTaskBegin, kDirectives, kTaskArguments, kFunctions, kTaskEnd)},
            {"slurm/collect.sbatch",
             str_cat(kCollectBegin, kDirectives, kCollectArguments, kFunctions, kCollectEnd)}};
}

size_t tasks_per_element(const PhaseWork& phase) {
    const size_t count = phase.range.end - phase.range.begin;
    return (count + kMostArrayElements - 1) / kMostArrayElements;
}

std::string array_elements(const PhaseWork& phase) {
    const size_t each = tasks_per_element(phase);
    std::vector<PlanPhase> runs;
    for (const size_t task : phase.tasks) {
        const size_t element = (task - phase.range.begin) / each;
        if (runs.empty() || element > runs.back().end) {
            runs.push_back({element, element + 1});
        } else {
            runs.back().end = element + 1;
        }
    }
    std::string text;
    for (const PlanPhase& run : runs) {
        text += str_cat(text.empty() ? "" : ",", run.begin);
        if (run.end > run.begin + 1) text += str_cat("-", run.end - 1);
    }
    return text;
}

CommandWords send_phase(const Submission& submission, const PhaseWork& phase,
                        const std::string& after) {
    CommandWords words = sbatch(submission, str_cat("phase-", phase.phase, "-%A_%a.log"));
    std::string array = "--array=" + array_elements(phase);
    if (submission.at_once > 0) array += str_cat("%", submission.at_once);
    words.push_back(array);
    add_dependency(words, "afterok", after);
    add_script(words, submission, "slurm/task.sbatch");
    for (const size_t number : {phase.range.begin, phase.range.end, tasks_per_element(phase)})
        words.push_back(str_cat(number));
    return words;
}

CommandWords send_collect(const Submission& submission, const std::string& after) {
    CommandWords words = sbatch(submission, "collect-%j.log");
    // It joins what is whole, and reports what is not.
    add_dependency(words, "afterany", after);
    add_script(words, submission, "slurm/collect.sbatch");
    return words;
}

}  // namespace tetralight::cli
