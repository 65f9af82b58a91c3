// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/make_file.h>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {
namespace {

constexpr const char* kBegin = R"(# SPDX-License-Identifier: Apache-2.0
# Written by `tetralight submit --to make`: tasks that were not done, and the joining of all results.
#     make -k -j 4 -C JOB THREADS=2
# runs four tasks at once with two threads each. TETRALIGHT names the command if PATH does not find it.
TETRALIGHT ?= tetralight
THREADS ?= 1
OPTIONS ?=
export TETRALIGHT

)";

/// A shell that is replaced by the command passes it SIGTERM: the task saves its work.
constexpr const char* kTaskRecipe =
    "\t@exec \"$$TETRALIGHT\" task . $* --threads $(THREADS) $(OPTIONS)\n";
constexpr const char* kCollectRecipe =
    "\t@exec \"$$TETRALIGHT\" collect . --threads $(THREADS) $(OPTIONS)\n";

/// The tasks of a phase, all after those of the phase before it.
std::string phase_rules(const PhaseWork& phase, const std::string& before) {
    const std::string name = str_cat("PHASE_", phase.phase);
    std::string text = name + " =";
    for (const size_t task : phase.tasks) text += str_cat(" task-", task);
    text += str_cat("\n.PHONY: $(", name, ")\n$(", name, "): task-%:");
    if (!before.empty()) text += str_cat(" | $(", before, ")");
    return text + "\n" + kTaskRecipe + "\n";
}

}  // namespace

JobFile make_file(const Submission& submission) {
    std::string phases, before;
    for (const PhaseWork& phase : submission.phases) {
        phases += phase_rules(phase, before);
        before = str_cat("PHASE_", phase.phase);
    }
    std::string text = str_cat(kBegin, ".PHONY: collect\n.DEFAULT_GOAL := collect\n\n", phases);
    text += before.empty() ? "collect:\n" : str_cat("collect: $(", before, ")\n");
    return {"Makefile", text + kCollectRecipe};
}

}  // namespace tetralight::cli
