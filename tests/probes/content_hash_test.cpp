// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/content_hash.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

template <class... Values>
uint64_t hash(const Values&... values) {
    ContentHash result;
    (result.add(values), ...);
    return result.value();
}

using Numbers = std::vector<uint32_t>;

TEST(ContentHash, EqualContentHasEqualHash) {
    EXPECT_EQ(hash(1u, Numbers{2, 3}, 4.0), hash(1u, Numbers{2, 3}, 4.0));
}

TEST(ContentHash, EveryValueAndTheirOrderCount) {
    EXPECT_NE(hash(1u, 2u), hash(2u, 1u));
    EXPECT_NE(hash(1u), hash(2u));
    EXPECT_NE(hash(0u), hash());
    EXPECT_NE(hash(0u, 0u), hash(0u));
}

TEST(ContentHash, WhereAnArrayEndsCounts) {
    EXPECT_NE(hash(Numbers{1, 2}, Numbers{3}), hash(Numbers{1}, Numbers{2, 3}));
    EXPECT_NE(hash(Numbers{}, Numbers{1}), hash(Numbers{1}, Numbers{}));
}

}  // namespace
}  // namespace tetralight
