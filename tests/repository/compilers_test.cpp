// SPDX-License-Identifier: Apache-2.0
// The ship set uses what single compilers offer in one header.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

namespace fs = std::filesystem;

/// The folders of the ship set; of those below them, some belong to offline modules.
const std::vector<std::string> kShipSet = {"base",     "probes",     "lppv",
                                           "lightmap", "reflection", "runtime"};

bool is_shipped(const fs::path& file) {
    for (const char* offline :
         {"base/hash/", "base/json/", "base/process/", "lppv/vdb/", "probes/programs/"}) {
        if (file.generic_string().starts_with(offline)) return false;
    }
    return true;
}

/// The first word of a text that only some compilers know, or an empty text.
std::string word_of_a_compiler(const std::string& text) {
    static const std::regex word(
        "__builtin\\w*|__attribute__|__extension__|__u?int128\\w*|__SIZEOF_\\w+|__GNUC__|__clang__|"
        "__restrict\\w*|__declspec|__forceinline|_MSC_VER|\\[\\[(?:gnu|clang|msvc)::|"
        "\\b(?:__)?asm\\b|\\b\\w*intrin\\.h|#pragma (?!once\\b)");
    std::smatch found;
    return std::regex_search(text, found, word) ? found.str() : std::string();
}

TEST(Compilers, OneHeaderUsesTheirExtensions) {
    size_t count = 0;
    for (const std::string& folder : kShipSet) {
        for (const fs::path& file : source_files(folder)) {
            if (!is_shipped(file) || file == "base/compiler.h") continue;
            if (file == "runtime/tetralight.h") continue;  // exports its functions
            ++count;
            const std::string word =
                word_of_a_compiler(without_comments_and_strings(read_text(file)));
            EXPECT_TRUE(word.empty()) << file << " uses " << word;
        }
    }
    EXPECT_GT(count, 250u);
}

TEST(Compilers, TheirExtensionsAreFound) {
    for (const char* text :
         {"__builtin_expect(x, 1)", "struct __attribute__((packed)) A", "unsigned __int128 x",
          "#ifdef __GNUC__", "[[gnu::packed]]", "asm volatile", "float* __restrict__ a",
          "#include <immintrin.h>", "#pragma GCC unroll 4", "__declspec(align(16))"}) {
        EXPECT_NE(word_of_a_compiler(text), "") << text;
    }
    EXPECT_EQ(word_of_a_compiler("#pragma once\nusing Int128 = PortableInt128; int basmati;"), "");
}

}  // namespace
}  // namespace tetralight
