// SPDX-License-Identifier: Apache-2.0
// tetralight_fuzz NAME SECONDS [FIRST_SEED]: runs cases of one target until the time is over, and
// prints one JSON line. The first case that goes wrong ends it, with the seed of the case on
// stderr; `tetralight_fuzz NAME 0 SEED` runs that case alone.
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <iostream>
#include <string_view>

#include "tests/fuzz/targets.h"

namespace tetralight::fuzz {
namespace {

volatile uint64_t g_seed = 0;

/// Of a crash, says which case it was.
void print_seed(int signal) {
    char text[64] = "crashed at seed ";
    char* end = std::to_chars(text + std::strlen(text), std::end(text) - 1, g_seed).ptr;
    *end++ = '\n';
    if (::write(STDERR_FILENO, text, static_cast<size_t>(end - text)) < 0) std::_Exit(1);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

int run(const Target& target, double seconds, uint64_t first_seed) {
    for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) {
        std::signal(signal, print_seed);
    }
    const auto begin = std::chrono::steady_clock::now();
    uint64_t seed = first_seed;
    std::chrono::duration<double> elapsed{0.0};
    do {
        g_seed = seed;
        const std::string problem = target.run(seed);
        if (!problem.empty()) {
            std::cerr << target.name << ": seed " << seed << ": " << problem << '\n';
            return 1;
        }
        ++seed;
        elapsed = std::chrono::steady_clock::now() - begin;
    } while (elapsed.count() < seconds);
    std::cout << "{\"name\":\"fuzz." << target.name << "\",\"cases\":" << seed - first_seed
              << ",\"seconds\":" << elapsed.count() << ",\"first_seed\":" << first_seed
              << ",\"failures\":0}\n";
    return 0;
}

template <class T>
bool read(const char* text, T& number) {
    const char* end = text + std::strlen(text);
    return std::from_chars(text, end, number).ptr == end;
}

int main(int argc, char** argv) {
    double seconds = 0.0;
    uint64_t seed = 1;
    if (argc >= 3 && argc <= 4 && read(argv[2], seconds) && (argc == 3 || read(argv[3], seed))) {
        for (const Target& target : targets()) {
            if (target.name == argv[1]) return run(target, seconds, seed);
        }
    }
    std::cerr << "usage: tetralight_fuzz NAME SECONDS [FIRST_SEED]; names:";
    for (const Target& target : targets()) std::cerr << ' ' << target.name;
    std::cerr << '\n';
    return 2;
}

}  // namespace
}  // namespace tetralight::fuzz

int main(int argc, char** argv) {
    return tetralight::fuzz::main(argc, argv);
}
