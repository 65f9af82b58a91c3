// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <set>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/imports/import_groups.h>
#include <tetralight/probes/is_finite.h>
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/seed_files.h"
#include "tests/fuzz/targets.h"
#include "tests/support/temp_folder.h"

namespace tetralight::fuzz {
namespace {

/// A file of tests/imports/files.
struct ImportSeed {
    std::string extension;
    std::string text;
};

const std::array<ImportSeed, 3>& import_seeds() {
    const auto seed = [](const std::string& name) {
        return ImportSeed{std::filesystem::path(name).extension().string(),
                          read_text(TETRALIGHT_IMPORT_SEEDS "/" + name)};
    };
    static const std::array<ImportSeed, 3> kSeeds{seed("probes.csv"), seed("level.tscn"),
                                                  seed("level.unity")};
    return kSeeds;
}

struct ImportVerdict {
    std::string problem;
    bool is_refused = false;
};

ImportVerdict judge_import(const std::string& path) {
    const auto imported = import_groups(path);
    if (!imported) {
        const std::string message = error_text(imported.error());
        const bool is_named = message.starts_with(path + ":");
        return {is_named ? "" : str_cat("the error does not name the file: ", message), true};
    }
    std::set<std::string> names;
    for (const ProbeGroup& group : imported->groups) {
        if (group.name.empty() || !names.insert(group.name).second)
            return {str_cat("group \"", group.name, "\" has no name of its own")};
        for (const glm::dvec3& position : group.positions)
            if (!is_finite(position)) return {str_cat("group \"", group.name, "\" is not finite")};
    }
    return {};
}

}  // namespace

std::string fuzz_imports(uint64_t seed) {
    static const TempFolder folder;
    Mutator mutator(seed);
    const ImportSeed& sound = import_seeds()[mutator.below(import_seeds().size())];
    std::string text = sound.text;
    for (size_t change = mutator.below(4); change > 0; --change) {
        if (mutator.below(4) == 0)
            mutator.change_file(text);
        else
            mutator.change_text(text);
    }
    return judge_import(folder.write("a" + sound.extension, text)).problem;
}

std::string replay_import(const std::string& path) {
    const ImportVerdict verdict = judge_import(path);
    const bool must_be_refused =
        std::filesystem::path(path).filename().string().starts_with("refused_");
    return must_be_refused && !verdict.is_refused ? "is not refused" : verdict.problem;
}

}  // namespace tetralight::fuzz
