// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/part_list.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using detail::PartList;

/// `count` rows of one element each.
PartList kinds(uint32_t first, uint32_t count) {
    PartList parts;
    for (uint32_t i = first; i < first + count; ++i)
        parts.add_left_out(str_cat("kind ", i), "is not read", false, str_cat("element ", i));
    return parts;
}

uint64_t total(const PartList& parts) {
    uint64_t sum = 0;
    for (const ScenePart& part : parts.parts()) sum += part.count;
    return sum;
}

TEST(PartList, ElementsOfOneKindShareARow) {
    PartList parts = kinds(0, 1);
    for (int i = 0; i < 20; ++i) parts.add_left_out("kind 0", "is not read", false, "other");
    parts.add_left_out("kind 0", "for another reason", false, "other");
    ASSERT_EQ(parts.parts().size(), 2u);
    EXPECT_EQ(parts.parts()[0].count, 21u);
    EXPECT_EQ(parts.parts()[0].elements.size(), ScenePart::kMaxElements);
    EXPECT_EQ(parts.parts()[0].elements[0], "element 0");
}

TEST(PartList, AppendedRowsAreAddedToThoseOfTheirKind) {
    PartList parts = kinds(0, 3);
    parts.append(kinds(1, 3).parts());
    ASSERT_EQ(parts.parts().size(), 4u);
    EXPECT_EQ(parts.parts()[1].count, 2u);
    EXPECT_EQ(parts.parts()[1].elements, (std::vector<std::string>{"element 1", "element 1"}));
    EXPECT_EQ(parts.parts()[3].count, 1u);
    parts.add_left_out("kind 3", "is not read", false, "more");
    EXPECT_EQ(parts.parts()[3].count, 2u);
}

TEST(PartList, ManyKindsShareTheLastRow) {
    constexpr uint32_t kMost = PartList::kMaxRows;
    PartList parts = kinds(0, kMost);
    EXPECT_EQ(parts.parts().size(), kMost);
    parts.append(kinds(kMost - 1, 5).parts());
    ASSERT_EQ(parts.parts().size(), kMost + 1);
    EXPECT_EQ(parts.parts().back().name, "other parts");
    EXPECT_EQ(parts.parts().back().count, 4u);
    EXPECT_EQ(parts.parts()[kMost - 1].count, 2u);
    parts.add_left_out("one more kind", "is not read", false, "element");
    EXPECT_EQ(parts.parts().back().count, 5u);
    EXPECT_EQ(total(parts), kMost + 6u);
}

}  // namespace
}  // namespace tetralight
