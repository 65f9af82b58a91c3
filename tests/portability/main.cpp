// SPDX-License-Identifier: Apache-2.0
// Runs on each platform of docs/portability.md:
//
//     portability_test WORK_FOLDER VECTORS_FOLDER NAME...
//
// Checks files in an empty folder, and the cells and answers of volumes VECTORS_FOLDER/NAME.probes.
// Prints what is wrong and a last line; exit code 1 if anything is wrong.
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <tetralight/base/file.h>
#include <tetralight/probes/probe_file.h>
#include "tests/portability/check_answers.h"
#include "tests/portability/check_cells.h"
#include "tests/portability/check_files.h"
#include "tests/portability/check_sizes.h"

namespace tetralight::portability {
namespace {

std::vector<uint32_t> read_words(const std::string& path) {
    const auto bytes = read_file(path);
    if (!bytes) return {};
    std::vector<uint32_t> words(bytes->size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes->data(), words.size() * sizeof(uint32_t));
    return words;
}

OpenVolume by_path(const std::string& path) {
    return [path](tetralight_error* error) {
        tetralight_volume* volume = nullptr;
        tetralight_open(path.c_str(), &volume, error);
        return volume;
    };
}

OpenVolume from_memory(const std::string& path) {
    return [path](tetralight_error* error) {
        tetralight_volume* volume = nullptr;
        const auto bytes = read_file(path);
        if (bytes) tetralight_open_memory(bytes->data(), bytes->size(), &volume, error);
        return volume;
    };
}

struct Totals {
    uint32_t volumes = 0, answers = 0, wrong = 0;
};

void check_volume(const std::string& path, Totals& totals) {
    const std::vector<uint32_t> words = read_words(path + ".cases");
    const std::string file = path + ".probes";
    for (const OpenVolume& open : {by_path(file), from_memory(file)}) {
        const auto result = check_answers(open, words);
        totals.answers += result.answer_count;
        if (result.passed() && result.answer_count > 0) continue;
        ++totals.wrong;
        std::printf("%s: %u answers, which differ by up to %g times the tolerance; %s\n",
                    path.c_str(), result.answer_count, result.worst, result.failure.c_str());
    }
    const auto volume = open_probe_file(file);
    if (!volume || !cells_are_the_same(volume->view())) {
        ++totals.wrong;
        std::printf("%s: its positions are joined by other cells\n", path.c_str());
    }
    const auto bytes = read_file(file);
    const std::string accepted = bytes ? check_sizes(*bytes) : "the file cannot be read";
    if (!accepted.empty()) {
        ++totals.wrong;
        std::printf("%s: %s\n", path.c_str(), accepted.c_str());
    }
    ++totals.volumes;
}

int run(int count, char** arguments) {
    if (count < 4) return 2;
    Totals totals;
    for (const std::string& wrong : check_files(arguments[1])) {
        ++totals.wrong;
        std::printf("files: %s\n", wrong.c_str());
    }
    for (int i = 3; i < count; ++i) {
        check_volume(std::string(arguments[2]) + "/" + arguments[i], totals);
    }
    if (totals.wrong > 0) {
        std::printf("%u checks failed\n", totals.wrong);
    } else {
        std::printf(
            "files, cells, sizes, %u answers of %u volumes by path and from memory: right\n",
            totals.answers, totals.volumes);
    }
    return totals.wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace tetralight::portability

int main(int count, char** arguments) {
    return tetralight::portability::run(count, arguments);
}
