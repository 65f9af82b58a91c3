// SPDX-License-Identifier: Apache-2.0
// Runs on each platform of docs/portability.md:
//
//     portability_test WORK_FOLDER VECTORS_FOLDER NAME...
//
// Checks files in an empty folder and the answers of volumes VECTORS_FOLDER/NAME.probes. Prints one
// line; exit code 1 if anything is wrong.
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <tetralight/base/file.h>
#include "tests/portability/check_answers.h"
#include "tests/portability/check_files.h"

namespace tetralight::portability {
namespace {

std::vector<uint32_t> read_words(const std::string& path) {
    const auto bytes = read_file(path);
    if (!bytes) return {};
    std::vector<uint32_t> words(bytes->size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes->data(), words.size() * sizeof(uint32_t));
    return words;
}

tetralight_volume* open_by_path(const std::string& path, tetralight_error* error) {
    tetralight_volume* volume = nullptr;
    tetralight_open(path.c_str(), &volume, error);
    return volume;
}

struct Totals {
    uint32_t volumes = 0, answers = 0, wrong = 0;
};

void check_volume(const std::string& path, Totals& totals) {
    const auto result = check_answers(
        [&](tetralight_error* error) { return open_by_path(path + ".probes", error); },
        read_words(path + ".cases"));
    ++totals.volumes;
    totals.answers += result.answer_count;
    if (result.passed()) return;
    ++totals.wrong;
    std::printf("%s: %s (differs by %g of the tolerance)\n", path.c_str(), result.failure.c_str(),
                result.worst);
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
    std::printf("%u answers of %u volumes, files: %s\n", totals.answers, totals.volumes,
                totals.wrong == 0 ? "all right" : "WRONG");
    return totals.wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace tetralight::portability

int main(int count, char** arguments) {
    return tetralight::portability::run(count, arguments);
}
