// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/detail/yaml_reader.h>

#include <gtest/gtest.h>

#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

std::string skip_error(std::string_view text, size_t& line) {
    YamlReader yaml(text, 10);
    const auto status = yaml.skip();
    line = yaml.line();
    return status ? "(no error)" : error_text(status.error());
}

TEST(YamlReader, ReadsMappingsSequencesAndScalars) {
    YamlReader yaml("a: 1\nb:\n- {x: 2, y: 'three'}\n- [4]\nc:\nd: \"\\u00e4\"\n", 1);
    std::vector<std::string> seen;
    const auto status = yaml.mapping([&](const std::string& key) -> Status {
        seen.push_back(key);
        if (key != "b") {
            const auto text = yaml.scalar();
            if (text) seen.push_back(*text);
            return text ? Status(Ok{}) : text.error();
        }
        return yaml.sequence([&](size_t index) -> Status {
            seen.push_back(str_cat(index));
            return yaml.skip();
        });
    });
    EXPECT_TRUE(status) << error_text(status.error());
    EXPECT_EQ(seen, (std::vector<std::string>{"a", "1", "b", "0", "1", "c", "", "d", "\xc3\xa4"}));
}

TEST(YamlReader, CountsLinesFromTheFirst) {
    YamlReader yaml("a:\n  b: 1\n", 10);
    ASSERT_TRUE(yaml.next());
    EXPECT_EQ((*yaml.next()).text, "a");
    EXPECT_EQ(yaml.line(), 10u);
    ASSERT_TRUE(yaml.next());
    EXPECT_EQ((*yaml.next()).text, "b");
    EXPECT_EQ(yaml.line(), 11u);
}

TEST(YamlReader, ErrorsOfSyntaxHaveALine) {
    size_t line = 0;
    EXPECT_EQ(skip_error("a: 1\nb: [1, 2\n", line).find("is not YAML: "), 0u);
    EXPECT_GE(line, 11u);
    EXPECT_EQ(skip_error("a: \x01\n", line).find("is not YAML: "), 0u);
    EXPECT_EQ(skip_error("a: &x 1\nb: *x\n", line), "has an alias of YAML, which is not read");
    EXPECT_EQ(line, 11u);
    EXPECT_EQ(skip_error("", line), "is not a value (nothing)");
}

TEST(YamlReader, RefusesDeepNesting) {
    size_t line = 0;
    EXPECT_EQ(skip_error(std::string(64, '[') + std::string(64, ']'), line), "(no error)");
    EXPECT_EQ(skip_error(std::string(1'000'000, '['), line), "has more than 64 levels");
}

TEST(YamlReader, ErrorsNameOtherTypes) {
    EXPECT_EQ(error_text(YamlReader("[1]", 1).scalar().error()), "is not a single value (a list)");
    const auto nothing = [](const auto&) -> Status { return Ok{}; };
    EXPECT_EQ(error_text(YamlReader("a: 1", 1).sequence(nothing).error()),
              "is not a list (a mapping)");
    EXPECT_EQ(error_text(YamlReader("abc", 1).mapping(nothing).error()),
              "is not a mapping (\"abc\")");
}

}  // namespace
}  // namespace tetralight::detail
