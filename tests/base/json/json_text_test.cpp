// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/base/json/json_text.h>

#include <gtest/gtest.h>

#include <string>

namespace tetralight {
namespace {

std::string nested(int depth) {
    std::string json = "{\"a\":";
    for (int i = 1; i < depth; ++i) json += '[';
    for (int i = 1; i < depth; ++i) json += ']';
    return json + "}";
}

TEST(JsonText, TakesObjects) {
    for (const char* json :
         {"{}", " { } \n", R"({"a":1,"b":[true,false,null],"c":{"d":"e"}})",
          R"({"":-0.5e+3,"a":0,"b":1E5,"c":2e-1,"d":[],"e":[1 , 2]})",
          R"({"a":"\"\\\/\b\f\n\r\t\u00e4[[[[","\u0000":1})", "{\"\xc3\xa4\":1}"}) {
        const auto status = check_json_object(json);
        EXPECT_TRUE(status) << json << ": " << error_text(status.error());
    }
}

TEST(JsonText, RefusesWhatIsNoObject) {
    for (const char* json : {"",
                             "[",
                             "[]",
                             "1",
                             "null",
                             "{",
                             "}",
                             "{\"a\"}",
                             "{\"a\":}",
                             "{\"a\":1,}",
                             "{,}",
                             "{a:1}",
                             "{'a':1}",
                             "{\"a\":01}",
                             "{\"a\":.5}",
                             "{\"a\":1.}",
                             "{\"a\":1e}",
                             "{\"a\":+1}",
                             "{\"a\":-}",
                             "{\"a\":nan}",
                             "{\"a\":[1,]}",
                             "{\"a\":[1}",
                             "{\"a\":\"\\x\"}",
                             "{\"a\":\"\\u12g4\"}",
                             "{\"a\":\"\n\"}",
                             "{\"a\":\"b}",
                             "{\"a\":\"\\",
                             "{}{}",
                             "{} x",
                             "{\"a\" 1}",
                             "{\"a\":1 \"b\":2}",
                             "{\"\xff\":1}"}) {
        EXPECT_FALSE(check_json_object(json)) << json;
    }
    const auto status = check_json_object("{\"a\":tru}");
    ASSERT_FALSE(status);
    EXPECT_TRUE(error_text(status.error()).starts_with("is not a JSON object ("));
}

TEST(JsonText, LimitsHowDeepObjectsNest) {
    EXPECT_TRUE(check_json_object(nested(64)));
    const auto status = check_json_object(nested(65));
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()), "JSON is nested deeper than 64");
}

std::string with_members(int count) {
    std::string json = "{";
    for (int i = 0; i < count; ++i) json += "\"k" + std::to_string(i) + "\":[{\"a:\":1}],";
    json.back() = '}';
    return json;
}

TEST(JsonText, LimitsTheMembersOfAnObject) {
    EXPECT_TRUE(check_json_object(with_members(4096)));
    const auto status = check_json_object(with_members(4097));
    ASSERT_FALSE(status);
    EXPECT_EQ(error_text(status.error()), "a JSON object has more than 4096 members");
    EXPECT_TRUE(check_json_shape("[" + with_members(4000) + "," + with_members(4000) + "]"));
    EXPECT_TRUE(check_json_shape("]]]]:::"));  // the parser finds what is no JSON
}

TEST(JsonText, CountsNothingBehindABracketThatClosesNone) {
    for (const std::string& text : {"]" + std::string(100, '['), std::string(5000, ']') + "{:[:"}) {
        EXPECT_TRUE(check_json_shape(text));
        EXPECT_FALSE(check_json_object(text));
    }
}

TEST(JsonText, FindsAKeyThatAnObjectHasTwice) {
    EXPECT_EQ(find_duplicate_key(R"({"a": 1, "b": {"a": 2}, "c": [{"a": 3}, {"a": 4}]})"),
              std::nullopt);
    EXPECT_EQ(find_duplicate_key(R"({"a": 1, "b": {"c": 2, "d": 3, "c": 4}})"), "c");
    EXPECT_EQ(find_duplicate_key(R"([{"a": 1, "\u0061": 2}])"), "a");
    EXPECT_EQ(find_duplicate_key("3"), std::nullopt);
}

TEST(JsonText, BracketsInStringsDoNotNest) {
    EXPECT_TRUE(check_json_shape("\"" + std::string(100, '[') + "\""));
    EXPECT_TRUE(check_json_shape("\"\\\"" + std::string(100, '[') + "\""));
    EXPECT_FALSE(check_json_shape("\"\\\\\"" + std::string(100, '[')));
    EXPECT_FALSE(check_json_shape(std::string(300000, '{')));
}

}  // namespace
}  // namespace tetralight
