// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <vector>

#include <tetralight/bake/scene/probe_groups_json.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/make_probe_volume.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/seed_files.h"
#include "tests/fuzz/targets.h"
#include "tests/support/temp_folder.h"

namespace tetralight::fuzz {
namespace {

/// The files of tests/fuzz/groups, in the order of their names.
const std::vector<std::string>& sound_texts() {
    static const std::vector<std::string> texts = seed_files(TETRALIGHT_FUZZ_SEEDS "/groups");
    return texts;
}

/// What is wrong with how a text is taken, and whether it is refused.
struct Verdict {
    std::string problem;
    bool is_refused = false;
};

Verdict judge(const std::string& text) {
    static const TempFolder folder;
    const std::string path = folder.write("a.json", text);
    const auto groups = read_probe_groups(path);
    if (!groups) {
        const std::string message = error_text(groups.error());
        const bool is_named = message.starts_with(path);
        return {is_named ? "" : str_cat("the error does not name the file: ", message), true};
    }
    const auto merged = merge(*groups);
    if (!merged) return {"", true};
    const ProbeVolume volume = make_probe_volume(*merged);
    if (const auto status = verify(volume.view()); !status) return {error_text(status.error())};
    const auto problems = validate(volume.view()).problems();
    return {problems.empty() ? "" : problems[0]};
}

}  // namespace

std::string fuzz_probe_groups(uint64_t seed) {
    Mutator mutator(seed);
    std::string text = sound_texts()[mutator.below(sound_texts().size())];
    for (size_t change = mutator.below(4); change > 0; --change) mutator.change_text(text);
    return judge(text).problem;
}

std::string replay_probe_groups(const std::string& path) {
    const Verdict verdict = judge(read_text(path));
    const bool must_be_refused =
        std::filesystem::path(path).filename().string().starts_with("refused_");
    return must_be_refused && !verdict.is_refused ? "is not refused" : verdict.problem;
}

}  // namespace tetralight::fuzz
