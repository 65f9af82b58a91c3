// SPDX-License-Identifier: Apache-2.0
// What `query` reads.
#include <cmath>
#include <limits>

#include <tetralight/base/str_cat.h>
#include "tests/cli/query_fixture.h"

namespace tetralight::test {
namespace {

class QueryInput : public QueryFixture {
  protected:
    /// The whole message about an input that is malformed.
    [[nodiscard]] std::string message_of(const std::string& name, const std::string& input) const {
        write(name, input);
        const std::string message = fail({"query", "v.probes", name});
        return message.substr(0, message.size() - 1);
    }
};

TEST_F(QueryInput, MeansTheSameInEveryFormat) {
    const auto positions = random_positions(1000);
    std::string lines, array, objects, json_lines;
    for (const glm::vec3& p : positions) {
        lines += str_cat(p.x, " ", p.y, " ", p.z, "\n");
        const std::string triple = str_cat("[", p.x, ", ", p.y, ",", p.z, "]");
        array += (array.empty() ? "[" : ",\n ") + triple;
        objects += (objects.empty() ? "[" : ",") + (R"({"position": )" + triple + "}");
        json_lines += triple + "\n";
    }
    const std::string expected =
        succeed({"query", "v.probes", "--from", "raw", "--to", "raw"}, raw(positions)).out;
    ASSERT_EQ(raw_records(expected).size(), positions.size());
    write("p.txt", lines);
    write("array.json", array + "]");
    write("objects.JSON", objects + "]\n");
    write("p.jsonl", json_lines);
    for (const char* extension : {"p.f32", "p.raw", "p.bin"}) write(extension, raw(positions));
    for (const char* name :
         {"p.txt", "array.json", "objects.JSON", "p.jsonl", "p.f32", "p.raw", "p.bin"}) {
        const std::string out = succeed({"query", "v.probes", name, "--to", "raw"}).out;
        EXPECT_TRUE(out == expected) << name;
    }
}

TEST_F(QueryInput, IsWhatTheOptionSaysWhateverTheName) {
    write("p.f32", "[[1, 1, 1]]");
    EXPECT_EQ(succeed({"query", "v.probes", "p.f32", "--from", "json"}).out,
              succeed({"query", "v.probes"}, "1 1 1").out);
}

TEST_F(QueryInput, MayBeTheAnswersOfAnotherQuery) {
    const std::string first = succeed({"query", "v.probes", "--json"}, "1 1 1\n0.1 7 -3\n").out;
    EXPECT_EQ(succeed({"query", "v.probes", "--json", "--from", "jsonl"}, first).out, first);
}

TEST_F(QueryInput, MayHaveKeysThatNobodyAskedFor) {
    const std::string object =
        R"({"name": "a", "parts": [[1], {"position": [null, {}], "x": -2.5}], )"
        R"("position": [1, 2, 3], "flags": {"a": [true]}, "none": null})";
    const std::string expected = succeed({"query", "v.probes"}, "1 2 3\n1 2 3\n").out;
    EXPECT_EQ(
        succeed({"query", "v.probes", "--from", "json"}, "[" + object + "," + object + "]").out,
        expected);
    EXPECT_EQ(succeed({"query", "v.probes", "--from", "jsonl"}, object + "\n\n" + object).out,
              expected);
}

TEST_F(QueryInput, MayHoldNoPosition) {
    for (const auto& [format, input] :
         {std::pair{"text", ""}, {"json", "[]"}, {"jsonl", ""}, {"jsonl", "\n"}, {"raw", ""}}) {
        EXPECT_EQ(succeed({"query", "v.probes", "--from", format}, input).out, "") << format;
    }
}

TEST_F(QueryInput, OfTextHasBlanksOrOneCommaBetweenNumbers) {
    const std::string expected = succeed({"query", "v.probes"}, "1 2 3").out;
    for (const char* line : {"1,2,3", "1, 2, 3", " 1\t2 ,3 ", "1 2 3\r\n", "+1 +2 +3.0",
                             "\xef\xbb\xbf"
                             "1 2 3"}) {
        EXPECT_EQ(succeed({"query", "v.probes"}, line).out, expected) << line;
    }
    for (const char* line : {"0,,1,0", ",,0 1 0,,", ",0,1,0", "0,1,0,", "0, ,1,0", "0 1", "0 1 0 0",
                             "+-1 0 0", "++1 0 0", "+ 1 0 0", "1-2 3", "1 2 x", "x,y,z 1",
                             "0 \xef\xbb\xbf"
                             "1 0"}) {
        EXPECT_EQ(message_of("p.txt", std::string(line) + "\n"),
                  str_cat("tetralight: p.txt:1: \"", line, "\" is not x y z"));
    }
}

TEST_F(QueryInput, MayBeAnAnswerInCsv) {
    const std::string first =
        succeed({"query", "v.probes", "--to", "csv"}, "1 1 1\n0.1 7 -3\n").out;
    EXPECT_EQ(succeed({"query", "v.probes", "--to", "csv"}, first).out, first);
    EXPECT_EQ(succeed({"query", "v.probes", "--to", "csv"}, "x,y,z\r\n1,1,1\n0.1,7,-3").out, first);
    for (const auto& [input, line] :
         {std::pair<std::string, std::string>("x,y,z,name\n1,2\n1,2,3,a\n", "2: \"1,2\""),
          {"#\nx,y,z\n", "2: \"x,y,z\""},
          {"x,y,zone\n", "1: \"x,y,zone\""}}) {
        EXPECT_EQ(message_of("p.csv", input), "tetralight: p.csv:" + line + " is not x y z");
    }
}

TEST_F(QueryInput, OfAnObjectIsReadToItsEndBeforeItIsAnswered) {
    for (const char* tail : {R"(, "position": [1, 1, 1]})", R"(, "x": nothing})", ""}) {
        const std::string object = R"({"position": [1, 1, 1])" + std::string(tail);
        for (const auto& [format, input] :
             {std::pair<std::string, std::string>("jsonl", object), {"json", "[" + object}}) {
            const CommandResult result = run({"query", "v.probes", "--from", format}, input);
            EXPECT_EQ(result.exit_code, 1) << input;
            EXPECT_EQ(result.out, "") << input;
        }
    }
}

/// Slightly above the middle between 1 and the next float, by less than a double can say: rounded
/// to double first it would be the middle, and then 1.
TEST_F(QueryInput, IsRoundedOnce) {
    const std::string digits = "1.00000005960464477539062500001";
    const double next = 1.0000001;  // the shortest digits of the float after 1
    ASSERT_EQ(static_cast<float>(next), std::nextafter(1.0f, 2.0f));
    EXPECT_EQ(answers(digits + " 0 0")[0]["position"][0], next);
    EXPECT_EQ(answers("[" + digits + ",0,0]", {"--from", "jsonl"})[0]["position"][0], next);
    EXPECT_EQ(answers("[[" + digits + ",0,0]]", {"--from", "json"})[0]["position"][0], next);
}

TEST_F(QueryInput, IsRefusedByLineAndValueWhenJsonLinesAreMalformed) {
    constexpr std::pair<const char*, const char*> kMalformed[] = {
        {"[1, 2]", "has 2 numbers, not three"},
        {"[]", "has 0 numbers, not three"},
        {"[1, 2, 3, 4]", "has more than three numbers"},
        {R"([1, "two", 3])", R"(y is not a number ("two"))"},
        {"[1, 2, null]", "z is not a number (null)"},
        {"[[1, 2, 3]]", "x is not a number (an array)"},
        {"[1, 1e39, 3]", "y is 1e39, beyond what a float holds (3.4e38)"},
        {"[1, 2, -1e999]", "z is -1e999, beyond what a float holds (3.4e38)"},
        {"7", R"(is neither [x, y, z] nor {"position": [x, y, z]} (7))"},
        {R"({"pos": [1, 2, 3]})", R"(has no "position")"},
        {R"({"position": 1.5})", R"("position" is not [x, y, z] (1.5))"},
        {R"({"position": {"x": 1}})", R"("position" is not [x, y, z] (an object))"},
        {R"({"position": [1, 2, 3], "position": [1, 2, 3]})", R"(key "position" is given twice)"},
    };
    for (const auto& [line, reason] : kMalformed) {
        EXPECT_EQ(message_of("p.jsonl", std::string("\n") + line + "\n"),
                  str_cat("tetralight: p.jsonl:2: ", reason));
    }
    EXPECT_EQ(message_of("p.jsonl", "[1, 2,, 3]\n")
                  .find("tetralight: p.jsonl:1: parse error at "
                        "column 7: "),
              0u);
    EXPECT_TRUE(contains(message_of("p.jsonl", "[1,2,3] 4\n"), "p.jsonl:1: parse error"));
}

TEST_F(QueryInput, IsRefusedByPositionAndValueWhenJsonIsMalformed) {
    constexpr std::pair<const char*, const char*> kMalformed[] = {
        {"[[1, 2]]", "position 0: has 2 numbers, not three"},
        {"[1, 2, 3]", "position 0: is neither [x, y, z] nor {\"position\": [x, y, z]} (1)"},
        {"[[0, 1e39, 0]]", "position 0: y is 1e39, beyond what a float holds (3.4e38)"},
        {"[{}]", R"(position 0: has no "position")"},
        {R"({"position": [1, 2, 3]})", "is not an array of positions (an object)"},
        {"null", "is not an array of positions (null)"},
    };
    for (const auto& [input, reason] : kMalformed) {
        EXPECT_EQ(message_of("p.json", input), str_cat("tetralight: p.json: ", reason));
    }
    EXPECT_TRUE(contains(message_of("p.json", ""), "p.json: parse error at line 1, column 1"));
    const CommandResult cut = run({"query", "v.probes", "--from", "json"}, "[[1, 2, 3],\n[1, 2,");
    EXPECT_EQ(cut.err.find("tetralight: stdin: position 1: parse error at line 2, column 7: "), 0u)
        << cut.err;
}

TEST_F(QueryInput, IsRefusedByByteAndRecordWhenARawRecordIsCut) {
    EXPECT_EQ(message_of("p.f32", std::string(11, '\0')),
              "tetralight: p.f32: ends at byte 11, 11 bytes into record 0; records are 12 bytes, "
              "x y z as float32");
    const CommandResult cut =
        run({"query", "v.probes", "--from", "raw"}, std::string(12 * 50000 + 1, '\0'));
    EXPECT_EQ(cut.exit_code, 1);
    EXPECT_TRUE(contains(cut.err, "stdin: ends at byte 600001, 1 byte into record 50000;"));
}

TEST_F(QueryInput, MayHaveLongLinesButNotEndlessOnes) {
    const std::string comment = "1 1 1 #" + std::string(200'000, 'x') + "\n";
    EXPECT_EQ(
        raw_records(succeed({"query", "v.probes", "--to", "raw"}, comment + comment).out).size(),
        2u);
    EXPECT_EQ(message_of("p.txt", "\n" + std::string(300'000, '#')),
              "tetralight: p.txt:2: the line is longer than 262144 bytes");
}

TEST_F(QueryInput, IsAnsweredUpToWhatIsMalformed) {
    const std::string expected = succeed({"query", "v.probes"}, "1 1 1\n2 2 2\n").out;
    const Arguments query{"query", "v.probes", "--from"};
    for (const auto& [format, input] : {std::pair{"text", "1 1 1\n2 2 2\nx\n"},
                                        {"jsonl", "[1,1,1]\n[2,2,2]\nx\n"},
                                        {"json", "[[1,1,1],[2,2,2],x"}}) {
        const CommandResult result = run({"query", "v.probes", "--from", format}, input);
        EXPECT_EQ(result.exit_code, 1) << format;
        EXPECT_EQ(result.out, expected) << format;
    }
}

TEST_F(QueryInput, IsCountedWhereItIsNotFinite) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const std::vector<glm::vec3> positions{{kNan, 0, 0}, {1, 1, 1}, {0, 0, -kInfinity}};
    const Arguments query{"query", "v.probes", "--from", "raw", "-o", "answers"};
    const CommandResult result = succeed(query, raw(positions));
    EXPECT_EQ(result.err, "warning: stdin: 2 positions are not finite and got the ambient light\n");
    Arguments quiet = query;
    quiet.emplace_back("--quiet");
    EXPECT_EQ(succeed(quiet, raw(positions)).err, "");
    Arguments json = query;
    json.emplace_back("--json");
    EXPECT_EQ(Json::parse(succeed(json, raw(positions)).out)["not_finite"], 2);
}

}  // namespace
}  // namespace tetralight::test
