// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/detail/record_relit.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

using detail::record_relit;

TEST(RecordRelit, AddsAMember) {
    EXPECT_EQ(record_relit(R"({"a":1})", "sky"), R"({"a":1,"relit":"sky"})");
    EXPECT_EQ(record_relit("{}", "sky"), R"({"relit":"sky"})");
    EXPECT_EQ(record_relit(" { } \n", "sky"), " { \"relit\":\"sky\"} \n");
    EXPECT_EQ(record_relit("", "sky"), R"({"relit":"sky"})");
}

TEST(RecordRelit, AddsEachCallOnceToAnEarlierRecord) {
    const std::string first = record_relit(R"({"relit":"--sky 2","b":[1,2]})", "sky");
    EXPECT_EQ(first, R"({"relit":"--sky 2 sky","b":[1,2]})");
    EXPECT_EQ(record_relit(first, "sky"), first);
    EXPECT_EQ(record_relit(first, "sun"), R"({"relit":"--sky 2 sky sun","b":[1,2]})");
    EXPECT_EQ(record_relit(R"({"relit":"skyline"})", "sky"), R"({"relit":"skyline sky"})");
    EXPECT_EQ(record_relit(R"({"relit" : "" })", "sky"), R"({"relit" : "sky"})");
    EXPECT_EQ(record_relit(R"({"relit":{"x":["]"]}})", "sky"), R"({"relit":"sky"})");
}

TEST(RecordRelit, KnowsStringsAndNestedMembers) {
    for (const std::string members :
         {R"("a":"}","b":{"relit":"c"})", R"("\"relit\"":1)", R"("a":"\\","b":"\"relit\":{")",
          R"("a":["relit",{"relit":[]}])", R"("relit ":1,"Relit":null)"}) {
        EXPECT_EQ(record_relit("{" + members + "}", "sky"), "{" + members + R"(,"relit":"sky"})");
        EXPECT_EQ(record_relit("{" + members + R"(,"relit":"a \" } b"})", "sky"),
                  "{" + members + R"(,"relit":"a \" } b sky"})");
    }
}

/// Files that were opened lazily can hold any bytes.
TEST(RecordRelit, ReplacesWhatIsNotAnObject) {
    for (const char* text :
         {"[]", "text", "{", "{\"", "{\"a", "{\"a\\", "{\"a\"", "{\"a\":", "{\"a\":1", "{\"a\":,}",
          "{\"a\":1}}", "{a:1}", "{\"a\":[}", "{\"a\":\"}", "{,}", "{\"a\":1 \"b\":2}{"}) {
        EXPECT_EQ(record_relit(text, "sky"), R"({"relit":"sky"})") << text;
    }
}

}  // namespace
}  // namespace tetralight
