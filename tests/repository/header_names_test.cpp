// SPDX-License-Identifier: Apache-2.0
#include "tests/repository/header_names.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>

#include "tests/repository/source_files.h"

namespace tetralight {
namespace {

using Names = std::vector<std::string>;

TEST(HeaderNames, FindsTypesFunctionsAndConstants) {
    EXPECT_EQ(names_defined_in(R"(
        #define MACRO(x) struct x {};
        namespace a::b {
        struct Point { float x = 0.0f; void move(); };
        enum class Kind : int { One, Two };
        template <class T> class Pair final : public Base<T> {};
        using Callback = std::function<void(int)>;
        inline constexpr float kHalf = 0.5f;
        constexpr std::array<int, 2> kTwo{1, 2};
        [[nodiscard]] inline std::vector<int> make(int count) { return {count}; }
        template <class T> concept Small = sizeof(T) < 8;
        })"),
              (Names{"a::b::Point", "a::b::Kind", "a::b::Pair", "a::b::Callback", "a::b::kHalf",
                     "a::b::kTwo", "a::b::make(int)", "a::b::Small"}));
}

TEST(HeaderNames, LeavesOutDeclarationsMembersAndOperators) {
    EXPECT_EQ(names_defined_in(R"(
        namespace a {
        class Later;  // struct Comment {};
        float declared(const char* text = "struct Text {");
        inline bool operator==(Later x, Later y) { return true; }
        extern "C" { void in_c(void); }
        using other::Name;
        }
        static_assert(sizeof(int) == 4);
        int global() { return 0; })"),
              Names{"global()"});
}

TEST(HeaderNames, TellsOverloadsByTheTypesOfTheirParameters) {
    EXPECT_EQ(names_defined_in("float f(int n, const a::Box& box = {}) {}"),
              names_defined_in("inline float f(int m, const a::Box& other) { return 1; }"));
    EXPECT_NE(names_defined_in("void f(int n) {}"), names_defined_in("void f(float n) {}"));
}

TEST(HeaderNames, NoNameIsDefinedInTwoHeaders) {
    std::map<std::string, std::set<std::string>> headers_of;
    for (const std::string& folder : source_folders()) {
        for (const std::filesystem::path& file : source_files(folder)) {
            if (file.extension() != ".h") continue;
            for (const std::string& name : names_defined_in(read_text(file))) {
                headers_of[name].insert(file.generic_string());
            }
        }
    }
    EXPECT_GT(headers_of.size(), 500u);
    for (const auto& [name, headers] : headers_of) {
        EXPECT_EQ(headers.size(), 1u)
            << name << " is defined in " << *headers.begin() << " and " << *headers.rbegin();
    }
}

}  // namespace
}  // namespace tetralight
