// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/detail/file_system.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <limits>

namespace tetralight::detail {
namespace {

TEST(FileSystem, RefusesFilesThatExceedTheAddressSpace) {
    const uint64_t most = std::numeric_limits<size_t>::max() / 2;
    EXPECT_EQ(*size_in_memory("a.probes", most), most);
    const auto size = size_in_memory("a.probes", most + 1);
    ASSERT_FALSE(size);
    EXPECT_EQ(size.error().code, ErrorCode::Unsupported);
    EXPECT_EQ(size.error().value, "a.probes");
}

TEST(FileSystem, NamesWhatIsNotARegularFile) {
    EXPECT_EQ(error_text(not_a_regular_file("a", true)), "a: is a folder");
    EXPECT_EQ(error_text(not_a_regular_file("a", false)), "a: is not a regular file");
    EXPECT_EQ(not_a_regular_file("a", true).code, ErrorCode::InvalidArgument);
}

TEST(FileSystem, KnowsWhatIsWrittenInPlace) {
    const auto device = open_new_file("/dev/null");
    ASSERT_TRUE(device);
    EXPECT_FALSE((*device)->is_replacement());
    const auto output = open_new_file("-");
    ASSERT_TRUE(output);
    EXPECT_FALSE((*output)->is_replacement());
    EXPECT_EQ(output_name("-"), "stdout");
}

}  // namespace
}  // namespace tetralight::detail
