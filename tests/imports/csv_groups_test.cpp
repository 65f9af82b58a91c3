// SPDX-License-Identifier: Apache-2.0
#include <tetralight/imports/csv_groups.h>

#include <gtest/gtest.h>

#include <tetralight/base/str_cat.h>
#include "tests/imports/import_case.h"

namespace tetralight {
namespace {

using Positions = std::vector<glm::dvec3>;

ImportedGroups read_csv(std::string_view text) {
    return sound_import("hall.csv", text);
}

std::string csv_error(std::string_view text) {
    return import_error("hall.csv", text);
}

TEST(CsvGroups, WithoutHeaderAreXYZInAGroupOfTheNameOfTheFile) {
    const auto read = read_csv("0,1.5,0\n-2.5e-1,+3,4\n");
    ASSERT_EQ(read.groups.size(), 1u);
    EXPECT_EQ(read.groups[0].name, "hall");
    EXPECT_EQ(read.groups[0].positions, (Positions{{0, 1.5, 0}, {-0.25, 3, 4}}));
    EXPECT_EQ(read.groups[0].world_from_group, glm::dmat4(1.0));
    EXPECT_TRUE(read.warnings.empty());
}

TEST(CsvGroups, AFourthColumnIsTheGroup) {
    const auto read = read_csv("1,2,3,b\n4,5,6,a\n7,8,9,b\n");
    ASSERT_EQ(read.groups.size(), 2u);
    EXPECT_EQ(read.groups[0].name, "b");
    EXPECT_EQ(read.groups[0].positions, (Positions{{1, 2, 3}, {7, 8, 9}}));
    EXPECT_EQ(read.groups[1].name, "a");
}

TEST(CsvGroups, AHeaderNamesColumnsInAnyOrderAndCase) {
    const auto read = read_csv("Group,Z,y,X\nhall,3,2,1\n");
    ASSERT_EQ(read.groups.size(), 1u);
    EXPECT_EQ(read.groups[0].positions, (Positions{{1, 2, 3}}));
}

TEST(CsvGroups, OtherColumnsAreSkippedWithAWarning) {
    const auto read = read_csv("x,nx,y,z,grup\n1,9,2,3,a\n");
    EXPECT_EQ(read.groups.at(0).positions, (Positions{{1, 2, 3}}));
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_EQ(from_name(read.warnings[0], "hall.csv"),
              "hall.csv: columns other than x, y, z and group are not read (\"nx\", \"grup\")");
}

TEST(CsvGroups, TakeSemicolonsTabsMarksOfUtf8AndLinesOfWindows) {
    const Positions expected = {{1, 2, 3}, {4, 5, 6}};
    for (const char* text : {"1;2;3\r\n4;5;6\r\n", "1\t2\t3\n4\t5\t6",
                             "\xef\xbb\xbf"
                             "1,2,3\n4,5,6\r",
                             "\n 1 , 2 ,3\n \n\n4, \"5\" ,6\n\n"}) {
        EXPECT_EQ(read_csv(text).groups.at(0).positions, expected) << text;
    }
}

TEST(CsvGroups, NamesInQuotesMayHaveSeparatorsQuotesAndLines) {
    const auto read =
        read_csv("x,y,z,group\n1,2,3,\"hall, \"\"A\"\"\"\n4,5,6,\"two\nlines\"\n7,8,9,ä\n");
    ASSERT_EQ(read.groups.size(), 3u);
    EXPECT_EQ(read.groups[0].name, "hall, \"A\"");
    EXPECT_EQ(read.groups[1].name, "two\nlines");
    EXPECT_EQ(read.groups[2].name, "ä");
}

TEST(CsvGroups, ErrorsNameLineColumnAndValue) {
    EXPECT_EQ(csv_error("1,2,3\n\n4,five,6\n"), "hall.csv:3: y is not a number (\"five\")");
    EXPECT_EQ(csv_error("1,2,3\n1,2,nan\n"), "hall.csv:2: z is not finite (\"nan\")");
    EXPECT_EQ(csv_error("inf,2,3\n"), "hall.csv:1: x is not finite (\"inf\")");
    EXPECT_EQ(csv_error("1,2,1e999\n"),
              "hall.csv:1: z is not a number that doubles can hold (\"1e999\")");
    EXPECT_EQ(csv_error("1,2,3\n1,,3\n"), "hall.csv:2: y is not a number (\"\")");
    EXPECT_EQ(csv_error("1,2,0x10\n"), "hall.csv:1: z is not a number (\"0x10\")");
    EXPECT_EQ(csv_error("1;2;3,5\n"), "hall.csv:1: z is not a number (\"3,5\")");
    EXPECT_EQ(csv_error("x,y,z,group\n1,2,3,\n"), "hall.csv:2: the name of the group is empty");
    EXPECT_EQ(csv_error("1,2,3,\"a\nb\"\n1,2,x,c\n"), "hall.csv:3: z is not a number (\"x\")");
}

TEST(CsvGroups, ErrorsNameTheLineOfAWrongNumberOfColumns) {
    EXPECT_EQ(csv_error("1,2,3\n1,2\n"), "hall.csv:2: has 2 fields, the first line has 3");
    EXPECT_EQ(csv_error("1\n").substr(0, 44), "hall.csv:1: has 1 column, not three (x, y, z");
    EXPECT_EQ(csv_error("x,y\n"), "hall.csv:1: no column is named z");
    EXPECT_EQ(csv_error("x,y,z,X\n"), "hall.csv:1: two columns are named x");
    EXPECT_EQ(csv_error(std::string(2000, ',')), "hall.csv:1: there are more than 1024 columns");
}

TEST(CsvGroups, ErrorsNameWrongQuotes) {
    EXPECT_EQ(csv_error("1,2,3,a\n1,2,3,\"a\n1,2,3\n"),
              "hall.csv:2: the quotes that begin here do not end");
    EXPECT_EQ(csv_error("1,2,3,\"a\"b\n"),
              "hall.csv:1: column 4: text follows closing quotes (\"b\")");
}

TEST(CsvGroups, RefuseOtherEncodingsAndFilesWithoutPositions) {
    EXPECT_EQ(csv_error("1,2,3,a\n1,2,3,\xe4\n"), "hall.csv:2: is not UTF-8");
    for (const char* text : {"", "\n\n", "x,y,z\n"})
        EXPECT_EQ(csv_error(text), "hall.csv: has no positions") << text;
    const auto none = import_text("hall.csv", "x,y,z\n");
    EXPECT_EQ(none.error().code, ErrorCode::NotFound);
    EXPECT_EQ(import_groups("/nowhere/hall.csv").error().code, ErrorCode::NotFound);
}

TEST(CsvGroups, RefuseLongNamesOfGroups) {
    const std::string name(4096, 'a');
    EXPECT_EQ(read_csv("1,2,3," + name).groups.at(0).name, name);
    EXPECT_EQ(csv_error("1,2,3," + name + "b"), "hall.csv:1: the name of the group, \"" +
                                                    name.substr(0, 60) +
                                                    "...\", is longer than 4096 bytes");
}

TEST(CsvGroups, ReadManyPositions) {
    constexpr size_t kCount = 200'000;
    std::string text;
    for (size_t i = 0; i < kCount; ++i)
        text += str_cat(i, ",", static_cast<double>(i) * 0.5, ",-1,g", i % 3, "\n");
    const auto read = read_csv(text);
    ASSERT_EQ(read.groups.size(), 3u);
    for (size_t i = 0; i < kCount; i += 997) {
        EXPECT_EQ(read.groups[i % 3].positions.at(i / 3),
                  glm::dvec3(static_cast<double>(i), static_cast<double>(i) * 0.5, -1));
    }
}

}  // namespace
}  // namespace tetralight
