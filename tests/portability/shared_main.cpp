// SPDX-License-Identifier: Apache-2.0
// Holds the shared library against the conformance vectors, as a program that has its header alone:
//
//     portability_shared WORK_FOLDER VECTORS_FOLDER NAME...
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "tests/portability/check_answers.h"

namespace tetralight::portability {
namespace {

std::vector<uint32_t> read_words(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<uint32_t> words;
    uint32_t word = 0;
    while (file.read(reinterpret_cast<char*>(&word), sizeof word)) words.push_back(word);
    return words;
}

CheckResult check_volume(const std::string& path) {
    const auto open = [&](tetralight_error* error) {
        tetralight_volume* volume = nullptr;
        tetralight_open((path + ".probes").c_str(), &volume, error);
        return volume;
    };
    return check_answers(open, read_words(path + ".cases"));
}

int run(int count, char** arguments) {
    if (count < 4) return 2;
    uint32_t answers = 0;
    for (int i = 3; i < count; ++i) {
        const auto result = check_volume(std::string(arguments[2]) + "/" + arguments[i]);
        answers += result.answer_count;
        if (result.passed() && result.answer_count > 0) continue;
        std::printf("%s: wrong answers; %s\n", arguments[i], result.failure.c_str());
        return 1;
    }
    std::printf("%u answers of the shared library: right\n", answers);
    return 0;
}

}  // namespace
}  // namespace tetralight::portability

int main(int count, char** arguments) {
    return tetralight::portability::run(count, arguments);
}
